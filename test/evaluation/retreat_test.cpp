#include "evaluation/retreat.h"

#include <gtest/gtest.h>

#include "evaluation/closed_loop_episode.h"
#include "evaluation/motions.h"
#include "evaluation/square_at.h"

namespace sweep_guard_evaluation {
namespace {

using Eigen::Vector3d;
using sweep_guard_core::Twist;

// A tool along x with its tip at the origin, held 2 mm above a square across z.
class HeldAbove {
 public:
  HeldAbove(const SquareObstacle& square, size_t pieces)
      : scene(inPieces(sweep_guard_core::ConvexShape::cylinder(0.005, 0.1), pieces), square),
        loop(scene, {}, {Time(seconds(10)), {}, SimulatedRobot(above(0.0073), {})}, 0.002) {
    DelayedGuardOptions guard;
    guard.motion.dead_time = RobotOptions{}.dead_time;
    guard.motion.time_constant = RobotOptions{}.lag;
    loop.addGuard(guard);
    for (int i = 0; i < 50; ++i) last = loop.run({{0.0, 0.0, -0.1}, Vector3d::Zero()});
  }

  // Of a retreat that opens every gap for 0.1 s and longer.
  double leastShareOf(const Twist& twist_W) const {
    ClosedLoop retreating = loop;
    double least = 1.0;
    for (int i = 0; i < 50 && opensEveryGap(scene, retreating.X_MT(), twist_W); ++i) {
      EXPECT_TRUE(i != 9 || opensEveryGap(scene, retreating.X_MT(), twist_W));
      least = std::min(least, retreating.run(twist_W).output_W.w_W.norm() / twist_W.w_W.norm());
    }
    return least;
  }

  LoopScene scene;
  ClosedLoop loop;
  LoopCycle last;

 private:
  static Eigen::Isometry3d above(double z) {
    Eigen::Isometry3d X_WT = straightMotion(0.0, milliseconds(20), milliseconds(0))[0].X_WT;
    X_WT.translation().z() = z;
    return X_WT;
  }
};

SquareObstacle squareFrom(double x) { return squareAt({x + 0.15, 0.0, 0.0}, Vector3d::UnitZ(), 0.15); }

class RetreatTest : public testing::Test {
 protected:
  HeldAbove held_{squareFrom(-0.15), 1};
  const LoopScene& scene_ = held_.scene;
};

TEST_F(RetreatTest, TheToolIsHeldBefore) {
  EXPECT_LT(held_.last.output_W.v_W.norm(), 1e-3);
  EXPECT_FALSE(held_.last.contact);
}

TEST_F(RetreatTest, OpensEveryGapOnlyIfNoPointCloses) {
  const Eigen::Isometry3d X_MT = held_.loop.X_MT();
  EXPECT_TRUE(opensEveryGap(scene_, X_MT, {{0.1, 0.0, 0.01}, Vector3d::Zero()}));
  EXPECT_FALSE(opensEveryGap(scene_, X_MT, {{0.1, 0.0, -0.01}, Vector3d::Zero()}));
  // about the tip: the rear end, 0.1 m behind, goes up or down
  EXPECT_TRUE(opensEveryGap(scene_, X_MT, {{0.0, 0.0, 0.1}, {0.0, 1.0, 0.0}}));
  EXPECT_FALSE(opensEveryGap(scene_, X_MT, {{0.0, 0.0, 0.05}, {0.0, -1.0, 0.0}}));
}

TEST_F(RetreatTest, KeepsItsSpeedInEveryDirectionAndAsItCame) {
  Random random(1);
  const std::vector<Twist> came_W(50, Twist{{0.0, 0.0, -0.05}, {0.0, 0.01, 0.0}});
  const std::vector<Retreat> retreats = retreatFrom(held_.loop, came_W, {}, 20, random);
  ASSERT_EQ(retreats.size(), 42U);
  for (const Retreat& retreat : retreats) {
    EXPECT_GE(retreat.speed_kept, 0.99) << static_cast<int>(retreat.kind);
    EXPECT_FALSE(retreat.contact);
  }
  EXPECT_NEAR(retreats[0].time_until_free.value(), 0.19, 0.011);
}

// The tip rises, the rear end goes down beside the square: no gap closes, but the plane of the square goes on there.
constexpr double kOverhang = 0.08;
const Twist kTurnAboutTheEdge = {{-0.03, 0.0, 0.05}, {0.0, -1.0, 0.0}};

TEST(RetreatBesideAnEdgeTest, ThePlaneOfAToolInOnePieceGoesOnBeyondTheEdge) {
  const HeldAbove held(squareFrom(kOverhang - 0.1), 1);
  EXPECT_LT(held.leastShareOf(kTurnAboutTheEdge), 0.9);
}

TEST(RetreatBesideAnEdgeTest, APieceBeyondTheEdgeHasAPlaneOfItsOwn) {
  const HeldAbove held(squareFrom(kOverhang - 0.1), 5);
  EXPECT_GE(held.leastShareOf(kTurnAboutTheEdge), 0.99);
}

}  // namespace
}  // namespace sweep_guard_evaluation
