#include "sweep_guard/ros/scene_output.h"

#include <utility>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {

SceneOutput::SceneOutput(ros::NodeHandle private_node, const LiveParameters& parameters,
                         const sweep_guard::Ledger& ledger)
    : parameters_(parameters),
      ledger_(ledger),
      markers_(parameters.initial().fixed_frame),
      marker_publisher_(private_node.advertise<visualization_msgs::MarkerArray>("markers", 1)),
      view_(private_node, parameters.initial().fixed_frame, parameters.initial().tool_frame,
            *parameters.initial().tool) {}

void SceneOutput::passed(const sweep_guard::ToolPose& pose) {
  const std::lock_guard lock(mutex_);
  scene_.trail.add(pose.stamp, pose.X_WT.translation());
}

void SceneOutput::swept(const sweep_guard::ToolPose& pose, std::shared_ptr<const sweep_guard::SweepReport> report) {
  const std::lock_guard lock(mutex_);
  scene_.X_WT = pose.X_WT;
  scene_.trail.add(pose.stamp, pose.X_WT.translation());
  if (report->contact()) scene_.contact = report;
  scene_.newest = std::move(report);
}

void SceneOutput::lookedAhead(const sweep_guard::ToolPose& from, std::shared_ptr<const sweep_guard::Outlook> outlook) {
  const std::lock_guard lock(mutex_);
  scene_.outlook_from_W = from.X_WT.translation();
  scene_.outlook = std::move(outlook);
}

void SceneOutput::clear() {
  const std::lock_guard lock(mutex_);
  scene_ = {};
}

void SceneOutput::publishMarkers() {
  if (marker_publisher_.getNumSubscribers() > 0) marker_publisher_.publish(markers_.draw(sceneNow()));
}

void SceneOutput::publishView() const {
  if (view_.wanted()) view_.publish(sceneNow());
}

MarkerScene SceneOutput::sceneNow() const {
  MarkerScene scene;
  {
    const std::lock_guard lock(mutex_);
    scene = scene_;
  }
  const auto parameters = parameters_.get();
  scene.tool = parameters->tool;
  scene.namespaces = parameters->marker_namespaces;
  scene.verdict = ledger_.verdict(now());
  return scene;
}

}  // namespace sweep_guard_ros
