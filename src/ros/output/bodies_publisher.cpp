#include "ros/output/bodies_publisher.h"

#include <boost/make_shared.hpp>

#include "common/stage_clock.h"
#include "ros/output/run_id.h"
#include "sweep_guard/geometry/link_surface.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

constexpr std::uint32_t kBodiesQueued = 100;
constexpr auto kMinPeriod = std::chrono::milliseconds(5);

sweep_guard::LinkSurface surfaceMsg(const sweep_guard_core::LinkSurface& surface, size_t body,
                                    const std::string& tool) {
  sweep_guard::LinkSurface msg;
  msg.link = surface.link.empty() ? tool : surface.link;
  msg.body = static_cast<std::uint32_t>(body);
  for (const Eigen::Vector3d& p : surface.vertices_B) msg.mesh.vertices.push_back(vectorMsg<geometry_msgs::Point>(p));
  for (const auto& [a, b, c] : surface.triangles) msg.mesh.triangles.emplace_back().vertex_indices = {a, b, c};
  return msg;
}

void add(const sweep_guard_core::PredictedPose& pose, sweep_guard::BodyMotion& motion) {
  motion.predicted.push_back(toMsg(pose, {}));
  motion.predicted_deviation_bounds.push_back(pose.deviation_bound);
}

sweep_guard::BodyMotion predictedMotion(const Eigen::Isometry3d& X_WB, const sweep_guard_core::PredictedPath& path) {
  sweep_guard::BodyMotion motion;
  if (!path.empty()) add({{}, X_WB}, motion);
  for (const sweep_guard_core::PredictedPose& pose : path) add(pose, motion);
  return motion;
}

}  // namespace

boost::shared_ptr<sweep_guard::ToolSurface> surfaceMsg(const Parameters& parameters) {
  auto msg = boost::make_shared<sweep_guard::ToolSurface>();
  msg->header.frame_id = parameters.tool_frame;
  msg->tool = parameters.tool_frame;
  for (size_t body = 0; body < parameters.bodies->size(); ++body) {
    for (const auto& surface : sweep_guard_core::linkSurfaces((*parameters.bodies)[body]))
      msg->links.push_back(surfaceMsg(surface, body, parameters.tool_frame));
  }
  return msg;
}

BodiesPublisher::BodiesPublisher(ros::NodeHandle private_node, const LiveParameters& parameters)
    : parameters_(parameters),
      run_id_(randomRunId()),
      surface_publisher_(private_node.advertise<sweep_guard::ToolSurface>("surface", 1, /*latch=*/true)),
      bodies_publisher_(private_node.advertise<sweep_guard::ToolBodies>("bodies", kBodiesQueued)) {
  setTool(*parameters.initial().bodies, surfaceMsg(parameters.initial()));
}

void BodiesPublisher::setTool(const std::vector<sweep_guard_core::Tool>& bodies,
                              const boost::shared_ptr<sweep_guard::ToolSurface>& surface) {
  reset();
  motions_.clear();
  poses_.assign(bodies.size(), {});
  for (const sweep_guard_core::Tool& body : bodies) motions_.emplace_back(body.boundingRadius());
  surface->header.stamp = ros::Time::now();
  surface->run_id = run_id_;
  surface->revision = ++revision_;
  surface_publisher_.publish(surface);
}

void BodiesPublisher::reset() {
  ++sequence_;
  newest_ = published_ = {};
  for (sweep_guard_core::SparseMotion& motion : motions_) motion.clear();
  predicted_.clear();
  predicted_from_ = {};
}

void BodiesPublisher::moved(const sweep_guard_core::PoseWithFrames& pose) {
  if (bodies_publisher_.getNumSubscribers() == 0) {
    if (newest_ != sweep_guard_core::Time()) reset();
    return;
  }
  for (size_t i = 0; i < motions_.size(); ++i) motions_[i].add(pose.stamp, pose.bodies[i]);
  newest_ = pose.stamp;
  if (newest_ - published_ >= kMinPeriod) publish();
}

void BodiesPublisher::predicted(const sweep_guard_core::PoseWithFrames& from,
                                const sweep_guard_core::Prediction& prediction) {
  if (newest_ == sweep_guard_core::Time()) return;
  predicted_.clear();
  const bool known = !prediction.path.empty();
  predicted_from_ = toMsg(known ? from.stamp : sweep_guard_core::Time());
  for (size_t i = 0; known && i < motions_.size(); ++i) {
    const auto& path = prediction.body_paths.empty() ? prediction.path : prediction.body_paths[i];
    predicted_.push_back(predictedMotion(from.bodies[i].X_WB, path));
  }
  publish();
}

void BodiesPublisher::publish() {
  const sweep_guard_core::InStage stage(sweep_guard_core::Stage::kPublish);
  const auto msg = boost::make_shared<sweep_guard::ToolBodies>();
  msg->header.stamp = toMsg(newest_);
  msg->header.frame_id = parameters_.initial().fixed_frame;
  msg->run_id = run_id_;
  msg->revision = revision_;
  msg->sequence = ++sequence_;
  msg->predicted_from = predicted_from_;
  for (size_t i = 0; i < motions_.size(); ++i) {
    sweep_guard::BodyMotion& body =
        msg->bodies.emplace_back(i < predicted_.size() ? predicted_[i] : sweep_guard::BodyMotion());
    if (newest_ != published_) poses_[i] = motions_[i].take();
    body.pose = toMsg(poses_[i].X_WB);
    body.deviation_bound = poses_[i].deviation_bound;
  }
  published_ = newest_;
  bodies_publisher_.publish(msg);
}

}  // namespace sweep_guard_ros
