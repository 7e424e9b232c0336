#include "ros/output/tool_balls.h"

#include <gtest/gtest.h>

namespace sweep_guard_ros {
namespace {

// A hand with one finger; the tool frame is 0.1 m beyond the hand, turned by half a turn about z.
const std::string kHand = R"(<robot name="hand">
  <link name="hand"><collision><origin xyz="0.01 0 0"/><geometry><sphere radius="0.02"/></geometry></collision></link>
  <link name="finger"><collision><origin xyz="0 0.03 0"/><geometry><sphere radius="0.01"/></geometry></collision></link>
  <link name="tip"/>
  <joint name="slide" type="prismatic">
    <parent link="hand"/><child link="finger"/><origin xyz="0 0 0.05"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="0.04" effort="1" velocity="1"/>
  </joint>
  <joint name="mount" type="fixed">
    <parent link="hand"/><child link="tip"/><origin xyz="0 0 0.1" rpy="0 0 3.14159265358979"/>
  </joint>
</robot>)";

Parameters handOf(bool articulated) {
  ToolModelOptions options;
  options.frame = "tip";
  options.links = {"hand", "finger"};
  const ToolModel model = loadToolModel(kHand, options);
  Parameters parameters{};
  parameters.tool_frame = "tip";
  parameters.articulated = articulated;
  parameters.robot = model.robot;
  parameters.bodies =
      articulated
          ? std::shared_ptr<const std::vector<sweep_guard_core::Tool>>(model.robot, &model.robot->robot.tools)
          : std::make_shared<const std::vector<sweep_guard_core::Tool>>(1, sweep_guard_core::Tool(model.pieces));
  return parameters;
}

const sweep_guard::ToolPiece& pieceOf(const sweep_guard::ToolBalls& balls, const std::string& link) {
  for (const sweep_guard::ToolPiece& piece : balls.pieces) {
    if (piece.link == link) return piece;
  }
  throw std::runtime_error("no piece of " + link);
}

void expectBall(const sweep_guard::ToolPiece& piece, const Eigen::Vector3d& center, double radius) {
  ASSERT_EQ(piece.balls.size(), 1U);
  const geometry_msgs::Point& at = piece.balls[0].center;
  EXPECT_LT((Eigen::Vector3d(at.x, at.y, at.z) - center).norm(), 1e-9) << at;
  EXPECT_NEAR(piece.balls[0].radius, radius, 1e-12);
}

TEST(ToolBallsTest, ALinkThatMovesHasItsOwnFrameAndTheRootThatOfTheTool) {
  const sweep_guard::ToolBalls balls = toolBallsMsg(handOf(/*articulated=*/true));
  EXPECT_EQ(balls.header.frame_id, "tip");
  ASSERT_EQ(balls.pieces.size(), 2U);
  EXPECT_EQ(pieceOf(balls, "hand").frame, "");
  expectBall(pieceOf(balls, "hand"), {-0.01, 0.0, -0.1}, 0.02);
  EXPECT_EQ(pieceOf(balls, "finger").frame, "finger");
  expectBall(pieceOf(balls, "finger"), {0.0, 0.03, 0.0}, 0.01);
}

TEST(ToolBallsTest, ARigidToolHasAllItsBallsInTheToolFrame) {
  const sweep_guard::ToolBalls balls = toolBallsMsg(handOf(/*articulated=*/false));
  ASSERT_EQ(balls.pieces.size(), 2U);
  for (const sweep_guard::ToolPiece& piece : balls.pieces) EXPECT_EQ(piece.frame, "");
  expectBall(pieceOf(balls, "finger"), {0.0, -0.03, -0.05}, 0.01);
}

}  // namespace
}  // namespace sweep_guard_ros
