#include "ros/output/scene_publisher.h"

#include <chrono>
#include <utility>

#include "ros/output/view_messages.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {

ScenePublisher::ScenePublisher(ros::NodeHandle private_node, const LiveParameters& parameters,
                               const sweep_guard_core::WarningMonitor& monitor,
                               const sweep_guard_core::WorkpieceStore& workpieces)
    : parameters_(parameters),
      monitor_(monitor),
      workpieces_(workpieces),
      markers_(parameters.initial().fixed_frame),
      marker_publisher_(private_node.advertise<visualization_msgs::MarkerArray>("markers", 1)),
      view_publisher_(private_node.advertise<sweep_guard::View>("view", 1)),
      tool_publisher_(private_node.advertise<sweep_guard::ToolShape>("tool", 1, /*latch=*/true)) {
  setTool(*parameters.initial().bodies);
}

void ScenePublisher::passed(const sweep_guard_core::PoseWithFrames& pose) {
  const sweep_guard_core::Lock lock(mutex_);
  scene_.trail.add(pose.stamp, pose.X_WT.translation());
}

void ScenePublisher::swept(const sweep_guard_core::PoseWithFrames& pose,
                           std::shared_ptr<const sweep_guard_core::SweepReport> report) {
  const sweep_guard_core::Lock lock(mutex_);
  scene_.X_WT = pose.X_WT;
  if (parameters_.initial().articulated) scene_.body_poses.assign(pose.bodies.begin(), pose.bodies.end());
  scene_.trail.add(pose.stamp, pose.X_WT.translation());
  if (report->unintendedContact()) scene_.contact = report;
  scene_.newest = std::move(report);
}

void ScenePublisher::predicted(const sweep_guard_core::PoseWithFrames& from,
                               std::shared_ptr<const sweep_guard_core::Prediction> prediction) {
  const sweep_guard_core::Lock lock(mutex_);
  scene_.prediction_from_W = from.X_WT.translation();
  scene_.prediction = std::move(prediction);
}

void ScenePublisher::clear() {
  const sweep_guard_core::Lock lock(mutex_);
  scene_ = {};
}

void ScenePublisher::setTool(const std::vector<sweep_guard_core::Tool>& bodies) {
  sweep_guard::ToolShape shape = toMsg(bodies);
  shape.header.frame_id = parameters_.initial().tool_frame;
  tool_publisher_.publish(shape);
}

void ScenePublisher::publishMarkers() {
  if (marker_publisher_.getNumSubscribers() == 0) return;
  MarkerScene scene = currentScene();
  if (scene.namespaces.count("workpieces") != 0) scene.workpieces = workpieces_.snapshot();
  marker_publisher_.publish(markers_.draw(scene, std::chrono::steady_clock::now()));
}

void ScenePublisher::publishView() const {
  if (view_publisher_.getNumSubscribers() == 0) return;
  sweep_guard::View view = toMsg(currentScene());
  view.header.frame_id = parameters_.initial().fixed_frame;
  view.tool = parameters_.initial().tool_frame;
  view_publisher_.publish(view);
}

MarkerScene ScenePublisher::currentScene() const {
  MarkerScene scene;
  {
    const sweep_guard_core::Lock lock(mutex_);
    scene = scene_;
  }
  const auto parameters = parameters_.get();
  scene.tool = parameters->tool;
  scene.bodies = parameters->bodies;
  scene.namespaces = parameters->marker_namespaces;
  monitor_.warning(now(), scene.warning);
  if (!isOfWarning(scene, parameters->limits)) scene.contact.reset();
  return scene;
}

}  // namespace sweep_guard_ros
