#include "ros/output/proximity_publisher.h"

#include <sweep_guard/Proximity.h>

#include <boost/make_shared.hpp>
#include <random>

#include "common/stage_clock.h"
#include "ros/output/tool_balls.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::InStage;
using sweep_guard_core::Stage;

constexpr std::uint32_t kPlanesQueued = 100;  // 0.1 s at 1 kHz: older planes serve nobody

const std::string& linkOf(const sweep_guard_core::BodyTools& bodies, size_t piece) {
  auto body = bodies.begin();
  for (; piece >= (*body)->pieces().size(); ++body) piece -= (*body)->pieces().size();
  return (*body)->pieces()[piece].link;
}

sweep_guard::SeparatingPlane planeMsg(const sweep_guard_core::ProximityPlane& found,
                                      const sweep_guard_core::BodyTools& bodies) {
  const sweep_guard_core::SeparatingPlane& plane = found.plane;
  sweep_guard::SeparatingPlane message;
  message.tool_link = linkOf(bodies, plane.piece);
  message.piece = static_cast<std::uint32_t>(plane.piece);
  message.mesh_id = found.workpiece->id;
  message.triangle = found.triangle;
  message.point = vectorMsg<geometry_msgs::Point>(plane.point_W);
  message.normal = vectorMsg<geometry_msgs::Vector3>(plane.normal_W);
  message.gap = plane.gap;
  message.speed = plane.surface_speed;
  return message;
}

}  // namespace

ProximityPublisher::ProximityPublisher(ros::NodeHandle private_node, const LiveParameters& parameters,
                                       const sweep_guard_core::WarningMonitor& monitor)
    : parameters_(parameters),
      known_surfaces_(monitor),
      planes_publisher_(private_node.advertise<sweep_guard::Proximity>("proximity", kPlanesQueued)),
      tool_publisher_(private_node.advertise<sweep_guard::ToolBalls>("tool_balls", 1, /*latch=*/true)),
      tool_revision_(std::random_device()()) {
  setTool(parameters.initial());
}

void ProximityPublisher::setTool(const Parameters& parameters) {
  const auto message = boost::make_shared<sweep_guard::ToolBalls>(toolBallsMsg(parameters));
  message->header.stamp = ros::Time::now();
  message->revision = ++tool_revision_;
  tool_publisher_.publish(message);
}

void ProximityPublisher::swept(const sweep_guard_core::PoseWithFrames& pose,
                               const sweep_guard_core::Workpieces& workpieces,
                               const sweep_guard_core::SweepReport& report, const sweep_guard_core::Guard& guard) {
  const auto parameters = parameters_.get();
  const bool wanted = planes_publisher_.getNumSubscribers() > 0 && parameters->proximity_reach > 0.0;
  if (!wanted) return reset();
  sweep_guard_core::BodyTools bodies;
  for (size_t i = 0; i < pose.bodies.size(); ++i) bodies.push_back(&guard.tool(i));
  const InStage computing(Stage::kProximity);
  finder_.find({bodies, pose, workpieces, parameters->proximity_reach, &report, guard.intentions().get(),
                &parameters->guard.allowed},
               proximity_);
  const InStage publishing(Stage::kPublish);
  const auto message = boost::make_shared<sweep_guard::Proximity>();
  message->header.stamp = toMsg(pose.stamp);
  message->header.frame_id = parameters->fixed_frame;
  message->tool = parameters->tool_frame;
  message->tool_pose = toMsg(pose.X_WT);
  if (parameters->articulated) {
    for (const auto& variable : parameters->robot->robot.tree.variables()) message->joints.push_back(variable.name);
    message->positions = pose.state.positions;
  }
  message->tool_revision = tool_revision_;
  message->valid_until = toMsg(pose.stamp + parameters->limits.pose_timeout);
  message->valid = known_surfaces_.complete(report, proximity_.unplaced);
  message->planes.reserve(proximity_.planes.size());
  for (const auto& plane : proximity_.planes) message->planes.push_back(planeMsg(plane, bodies));
  message->uncovered_distance = proximity_.uncovered.distance;
  message->uncovered_speed = proximity_.uncovered.speed;
  planes_publisher_.publish(message);
}

}  // namespace sweep_guard_ros
