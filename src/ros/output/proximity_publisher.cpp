#include "ros/output/proximity_publisher.h"

#include <sweep_guard/Proximity.h>
#include <sweep_guard/ToolBalls.h>

#include <boost/make_shared.hpp>
#include <random>

#include "common/stage_clock.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::InStage;
using sweep_guard_core::Stage;

constexpr std::uint32_t kPlanesQueued = 100;  // 0.1 s at 1 kHz: older planes serve nobody

sweep_guard::SeparatingPlane planeMsg(const sweep_guard_core::ProximityPlane& found,
                                      const sweep_guard_core::Tool& tool) {
  const sweep_guard_core::SeparatingPlane& plane = found.plane;
  sweep_guard::SeparatingPlane message;
  message.tool_link = tool.pieces()[plane.piece].link;
  message.piece = static_cast<std::uint32_t>(plane.piece);
  message.mesh_id = found.workpiece->id;
  message.triangle = found.triangle;
  message.point = vectorMsg<geometry_msgs::Point>(plane.point_W);
  message.normal = vectorMsg<geometry_msgs::Vector3>(plane.normal_W);
  message.gap = plane.gap;
  message.speed = plane.surface_speed;
  return message;
}

sweep_guard::ToolPiece pieceMsg(const sweep_guard_core::ConvexPiece& piece) {
  sweep_guard::ToolPiece message;
  message.link = piece.link;
  for (const sweep_guard_core::ToolBall& ball : sweep_guard_core::enclosingBalls(piece.shape_T)) {
    message.balls.emplace_back();
    message.balls.back().center = vectorMsg<geometry_msgs::Point>(ball.center_T);
    message.balls.back().radius = ball.radius;
  }
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
  setTool(*parameters.initial().tool);
}

void ProximityPublisher::setTool(const sweep_guard_core::Tool& tool) {
  const auto message = boost::make_shared<sweep_guard::ToolBalls>();
  message->header.stamp = ros::Time::now();
  message->header.frame_id = parameters_.initial().tool_frame;
  message->tool = parameters_.initial().tool_frame;
  message->revision = ++tool_revision_;
  for (const sweep_guard_core::ConvexPiece& piece : tool.pieces()) message->pieces.push_back(pieceMsg(piece));
  tool_publisher_.publish(message);
}

void ProximityPublisher::swept(const sweep_guard_core::PoseWithFrames& pose,
                               const sweep_guard_core::Workpieces& workpieces,
                               const sweep_guard_core::SweepReport& report, const sweep_guard_core::Guard& guard) {
  const auto parameters = parameters_.get();
  const bool wanted = planes_publisher_.getNumSubscribers() > 0 && parameters->proximity_reach > 0.0;
  if (!wanted || parameters->articulated) return reset();
  const sweep_guard_core::Tool& tool = guard.tool();
  const InStage computing(Stage::kProximity);
  finder_.find({tool, pose, workpieces, parameters->proximity_reach, &report, guard.intentions().get(),
                &parameters->guard.allowed},
               proximity_);
  const InStage publishing(Stage::kPublish);
  const auto message = boost::make_shared<sweep_guard::Proximity>();
  message->header.stamp = toMsg(pose.stamp);
  message->header.frame_id = parameters->fixed_frame;
  message->tool = parameters->tool_frame;
  message->tool_pose = toMsg(pose.X_WT);
  message->tool_revision = tool_revision_;
  message->valid_until = toMsg(pose.stamp + parameters->limits.pose_timeout);
  message->valid = known_surfaces_.complete(report, proximity_.unplaced);
  message->planes.reserve(proximity_.planes.size());
  for (const auto& plane : proximity_.planes) message->planes.push_back(planeMsg(plane, tool));
  message->uncovered_distance = proximity_.uncovered.distance;
  message->uncovered_speed = proximity_.uncovered.speed;
  planes_publisher_.publish(message);
}

}  // namespace sweep_guard_ros
