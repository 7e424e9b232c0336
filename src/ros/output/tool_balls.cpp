#include "ros/output/tool_balls.h"

#include "sweep_guard/motion/separating_plane.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

// Where a body is in the frame F that its balls are published in.
struct BallFrame {
  std::string link;
  Eigen::Isometry3d X_FB = Eigen::Isometry3d::Identity();
};

BallFrame ballFrameOf(const Parameters& parameters, size_t body) {
  if (!parameters.articulated) return {};
  const sweep_guard_core::Robot& robot = parameters.robot->robot;
  const size_t link = robot.bodies[body].link;
  if (link == sweep_guard_core::TreeLink::kRoot) return {"", parameters.robot->X_TR};
  return {robot.tree.links()[link].name};
}

sweep_guard::ToolPiece pieceMsg(const sweep_guard_core::ConvexPiece& piece, const BallFrame& frame) {
  sweep_guard::ToolPiece message;
  message.link = piece.link;
  message.frame = frame.link;
  for (const sweep_guard_core::ToolBall& ball : sweep_guard_core::enclosingBalls(piece.shape_T)) {
    message.balls.emplace_back();
    message.balls.back().center = vectorMsg<geometry_msgs::Point>(frame.X_FB * ball.center_T);
    message.balls.back().radius = ball.radius;
  }
  return message;
}

}  // namespace

sweep_guard::ToolBalls toolBallsMsg(const Parameters& parameters) {
  sweep_guard::ToolBalls message;
  message.header.frame_id = message.tool = parameters.tool_frame;
  for (size_t body = 0; body < parameters.bodies->size(); ++body) {
    const BallFrame frame = ballFrameOf(parameters, body);
    for (const auto& piece : (*parameters.bodies)[body].pieces()) message.pieces.push_back(pieceMsg(piece, frame));
  }
  return message;
}

}  // namespace sweep_guard_ros
