#include "sweep_guard/motion/moving_tool.h"

#include <gtest/gtest.h>

#include "motion/random_arms.h"
#include "motion/random_scenes.h"

namespace sweep_guard_core {
namespace {

using Eigen::Vector3d;

constexpr double kTime = 0.3;  // [s]

// Visits every ball of random arms, with its index in MovingTool::balls().
template <typename Visit>
void forEachBall(std::uint64_t arms, std::uint64_t seed, const Visit& visit) {
  Random random(seed);
  for (std::uint64_t i = 0; i < arms; ++i) {
    const ArmCase arm = randomArm(random, 0);
    MovingTool tool(arm.tree);
    tool.place(arm.joints.state, *arm.inputs.tool, arm.command.velocities);
    tool.boundAccelerations(*arm.inputs.tool, arm.command.velocities, kTime);
    size_t index = 0;
    for (size_t piece = 0; piece < arm.inputs.tool->pieces.size(); ++piece) {
      for (size_t ball = 0; ball < arm.inputs.tool->pieces[piece].size(); ++ball)
        visit(arm, tool, piece, ball, index++);
    }
  }
}

TEST(MovingToolTest, VelocitiesAreThoseOfTheCentersAsTheJointsMove) {
  forEachBall(
      caseCount(200), 81, [](const ArmCase& arm, const MovingTool& tool, size_t piece, size_t ball, size_t index) {
        const double step = 1e-5;
        const Vector3d ahead = centerOf(arm, after(arm.joints.state, arm.command.velocities, step), piece, ball);
        const Vector3d behind = centerOf(arm, after(arm.joints.state, arm.command.velocities, -step), piece, ball);
        const Twist& twist_W = tool.pieces()[piece].twist_W;
        const Vector3d from_origin = tool.balls()[index].center_W - tool.pieces()[piece].X_WL.translation();
        const Vector3d velocity_W = twist_W.v_W + twist_W.w_W.cross(from_origin);
        EXPECT_LT((velocity_W - (ahead - behind) / (2.0 * step)).norm(), 1e-7);
        EXPECT_LE(velocity_W.norm(), tool.balls()[index].speed + 1e-12);
        EXPECT_LE(tool.balls()[index].speed, tool.fastest());
      });
}

TEST(MovingToolTest, BoundsTheAccelerationWithinATime) {
  double largest_share = 0.0;
  forEachBall(
      caseCount(200), 82, [&](const ArmCase& arm, const MovingTool& tool, size_t piece, size_t ball, size_t index) {
        for (const double fraction : {0.0, 0.3, 0.7, 1.0}) {
          const auto at = [&](double time) {
            return centerOf(arm, after(arm.joints.state, arm.command.velocities, time), piece, ball);
          };
          const double time = fraction * kTime;
          const double step = 1e-3;
          const double acceleration = (at(time + step) - 2.0 * at(time) + at(time - step)).norm() / (step * step);
          EXPECT_LE(acceleration, 1.001 * tool.balls()[index].acceleration + 1e-6);
          if (acceleration > 0.01)
            largest_share = std::max(largest_share, acceleration / tool.balls()[index].acceleration);
        }
      });
  EXPECT_GT(largest_share, 0.9);
}

TEST(MovingToolTest, BoundsTheDisplacementOfEveryPoint) {
  Random random(83);
  for (std::uint64_t i = 0; i < caseCount(200); ++i) {
    ArmCase arm = randomArm(random, 0);
    MovingTool from(arm.tree);
    MovingTool to = from;
    from.place(arm.joints.state, *arm.inputs.tool, arm.command.velocities);
    to.place(randomStateNear(random, arm.joints.state, 0.5), *arm.inputs.tool, arm.command.velocities);
    const double bound = to.largestDisplacement(from, *arm.inputs.tool);
    for (size_t piece = 0; piece < arm.inputs.tool->pieces.size(); ++piece) {
      const auto& [center_L, radius] = arm.inputs.tool->pieces[piece][0];
      const Vector3d p_L = center_L + radius * random.direction();
      EXPECT_LE((to.pieces()[piece].X_WL * p_L - from.pieces()[piece].X_WL * p_L).norm(), bound + 1e-12);
    }
    EXPECT_EQ(from.largestDisplacement(from, *arm.inputs.tool), 0.0);
  }
}

TEST(MovingToolTest, ALinkThatTheTreeHasNotIsNotFound) {
  Random random(84);
  const KinematicTree tree = randomRobot(random, 2, false);
  const ToolBalls tool{1, {{}, {}, {}, {}}, {"link1", "", "elsewhere"}};
  EXPECT_EQ(linkOf(tool, 0, tree), 1U);
  EXPECT_EQ(linkOf(tool, 1, tree), TreeLink::kRoot);
  EXPECT_FALSE(linkOf(tool, 2, tree));
  EXPECT_EQ(linkOf(tool, 3, tree), TreeLink::kRoot);
}

}  // namespace
}  // namespace sweep_guard_core
