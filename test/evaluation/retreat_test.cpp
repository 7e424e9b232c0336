#include "evaluation/retreat.h"

#include <gtest/gtest.h>

#include "evaluation/motions.h"
#include "evaluation/square_at.h"

namespace sweep_guard_evaluation {
namespace {

using Eigen::Vector3d;
using sweep_guard_core::Twist;

// A tool along x, held 2 mm above a square across z.
class RetreatTest : public testing::Test {
 protected:
  explicit RetreatTest(double overhang = 0.0)
      : scene_(sweep_guard_core::Tool::cylinder(0.005, 0.1), squareAt({overhang, 0.0, 0.0}, Vector3d::UnitZ(), 0.15)) {
    Eigen::Isometry3d X_WT = straightMotion(0.0, milliseconds(20), milliseconds(0))[0].X_WT;
    X_WT.translation().z() = 0.0073;
    ClosedLoop loop(scene_, {}, {Time(seconds(10)), {}, SimulatedRobot(X_WT, {})}, 0.002);
    DelayedGuardOptions guard;
    guard.motion.dead_time = RobotDelays{}.dead_time;
    guard.motion.time_constant = RobotDelays{}.lag;
    loop.addGuard(guard);
    for (int i = 0; i < 50; ++i) last_ = loop.run({{0.0, 0.0, -0.1}, Vector3d::Zero()});
    held_.emplace(HeldTool{loop, std::vector<Twist>(50, Twist{{0.0, 0.0, -0.05}, {0.0, 0.01, 0.0}})});
  }

  LoopScene scene_;
  LoopCycle last_;
  std::optional<HeldTool> held_;
};

TEST_F(RetreatTest, TheToolIsHeldBefore) {
  EXPECT_LT(last_.output_W.v_W.norm(), 1e-3);
  EXPECT_FALSE(last_.contact);
}

TEST_F(RetreatTest, OpensEveryGapOnlyIfNoPointCloses) {
  const Eigen::Isometry3d X_MT = held_->loop.X_MT();
  EXPECT_TRUE(opensEveryGap(scene_, X_MT, {{0.1, 0.0, 0.01}, Vector3d::Zero()}));
  EXPECT_FALSE(opensEveryGap(scene_, X_MT, {{0.1, 0.0, -0.01}, Vector3d::Zero()}));
  // about the tip: the rear end, 0.1 m behind, goes up or down
  EXPECT_TRUE(opensEveryGap(scene_, X_MT, {{0.0, 0.0, 0.1}, {0.0, 1.0, 0.0}}));
  EXPECT_FALSE(opensEveryGap(scene_, X_MT, {{0.0, 0.0, 0.05}, {0.0, -1.0, 0.0}}));
}

TEST_F(RetreatTest, KeepsItsSpeedInEveryDirectionAndAsItCame) {
  Random random(1);
  const std::vector<Retreat> retreats = retreatFrom(*held_, {}, 20, random);
  ASSERT_EQ(retreats.size(), 42U);
  for (const Retreat& retreat : retreats) {
    EXPECT_GE(retreat.speed_kept, 0.99) << static_cast<int>(retreat.kind);
    EXPECT_FALSE(retreat.contact);
  }
  EXPECT_NEAR(retreats[0].time_until_free.value(), 0.19, 0.011);
}

}  // namespace
}  // namespace sweep_guard_evaluation
