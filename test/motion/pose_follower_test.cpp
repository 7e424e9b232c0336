#include "sweep_guard/motion/pose_follower.h"

#include <gtest/gtest.h>

#include <limits>

#include "motion/random_scenes.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using std::chrono::milliseconds;

constexpr Duration kPeriod = milliseconds(10);

Isometry3d pose(const Vector3d& position, double about_z = 0.0) {
  Isometry3d X_WT = Isometry3d::Identity();
  X_WT.translation() = position;
  X_WT.linear() = Eigen::AngleAxisd(about_z, Vector3d::UnitZ()).toRotationMatrix();
  return X_WT;
}

double angleBetween(const Isometry3d& a, const Isometry3d& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

PoseFollower follower(bool incremental) { return PoseFollower({0.25, 1.0}, incremental); }

TEST(PoseFollowerTest, SendsACommandWithinReachBitForBit) {
  PoseFollower follower = sweep_guard_core::follower(/*incremental=*/false);
  follower.begin(pose({0.1, 0.2, 0.3}));
  const Isometry3d command_WT = pose({0.1013, 0.2, 0.2999}, 0.009);
  const Isometry3d sent_WT = follower.moveOn(follower.towards(command_WT, kPeriod));
  EXPECT_EQ(sent_WT.matrix(), command_WT.matrix());
  EXPECT_TRUE(follower.reached());
}

TEST(PoseFollowerTest, CatchesUpAtTheLargestSpeedAndTurnRate) {
  PoseFollower follower = sweep_guard_core::follower(/*incremental=*/false);
  follower.begin(pose(Vector3d::Zero()));
  const Isometry3d command_WT = pose({0.01, 0.0, 0.0}, 0.1);
  for (int i = 1; i <= 12; ++i) {
    const Isometry3d sent_WT = follower.moveOn(follower.towards(command_WT, kPeriod));
    EXPECT_NEAR(sent_WT.translation().x(), std::min(0.01, 0.0025 * i), 1e-12) << i;
    EXPECT_NEAR(angleBetween(pose(Vector3d::Zero()), sent_WT), std::min(0.1, 0.01 * i), 1e-9) << i;
  }
  EXPECT_EQ(follower.sent().matrix(), command_WT.matrix());
}

TEST(PoseFollowerTest, ZeroSendsThePoseOfBefore) {
  for (const bool incremental : {false, true}) {
    PoseFollower follower = sweep_guard_core::follower(incremental);
    follower.begin(pose({0.1, 0.0, 0.0}, 0.5));
    follower.towards(pose({0.2, 0.0, 0.0}), kPeriod);
    follower.moveOn({});
    follower.towards(pose({0.3, 0.0, 0.0}), kPeriod);
    follower.moveOn({});
    EXPECT_TRUE(follower.sent().isApprox(pose({0.1, 0.0, 0.0}, 0.5), 1e-15));
    EXPECT_FALSE(follower.reached());
  }
}

TEST(PoseFollowerTest, CatchesUpWithWhatWasHeldBackIfAbsolute) {
  PoseFollower follower = sweep_guard_core::follower(/*incremental=*/false);
  follower.begin(pose(Vector3d::Zero()));
  follower.towards(pose({0.002, 0.0, 0.0}), kPeriod);
  follower.moveOn({});
  follower.moveOn(follower.towards(pose({0.002, 0.0, 0.0}), kPeriod));
  EXPECT_DOUBLE_EQ(follower.sent().translation().x(), 0.002);
}

TEST(PoseFollowerTest, LosesWhatWasHeldBackIfIncremental) {
  PoseFollower follower = sweep_guard_core::follower(/*incremental=*/true);
  follower.begin(pose({1.0, 0.0, 0.0}));
  follower.moveOn(follower.towards(pose({5.0, 0.0, 0.0}), kPeriod));
  EXPECT_DOUBLE_EQ(follower.sent().translation().x(), 1.0);
  follower.towards(pose({5.002, 0.0, 0.0}), kPeriod);
  follower.moveOn({});
  follower.moveOn(follower.towards(pose({5.001, 0.0, 0.0}), kPeriod));
  EXPECT_NEAR(follower.sent().translation().x(), 0.999, 1e-12);
}

TEST(PoseFollowerTest, RebasingIsAClutch) {
  PoseFollower follower = sweep_guard_core::follower(/*incremental=*/true);
  follower.begin(pose({1.0, 0.0, 0.0}, 0.2));
  follower.moveOn(follower.towards(pose({5.0, 0.0, 0.0}), kPeriod));
  follower.rebase();
  const Twist first = follower.towards(pose({-3.0, 2.0, 0.0}, 1.0), kPeriod);
  EXPECT_EQ(first.v_W, Vector3d::Zero());
  EXPECT_EQ(first.w_W, Vector3d::Zero());
  follower.moveOn(first);
  follower.moveOn(follower.towards(pose({-3.0, 2.001, 0.0}, 1.005), kPeriod));
  EXPECT_TRUE(follower.sent().isApprox(pose({1.0, 0.001, 0.0}, 0.205), 1e-12));
}

TEST(PoseFollowerTest, TheFirstCommandOfAClutchMovesNothing) {
  PoseFollower follower = sweep_guard_core::follower(/*incremental=*/true);
  follower.begin(pose(Vector3d::Zero()));
  EXPECT_EQ(follower.towards(pose({1.0, 0.0, 0.0}), kPeriod).v_W, Vector3d::Zero());
}

TEST(PoseFollowerTest, ThePoseSentNeverJumps) {
  RandomScenes random(5);
  for (std::uint64_t i = 0; i < caseCount(1000); ++i) {
    PoseFollower follower = sweep_guard_core::follower(/*incremental=*/!random.chance(0.5));
    follower.begin(pose(random.direction(), random.uniform(-3.0, 3.0)));
    for (int step = 0; step < 10; ++step) {
      const Isometry3d before_WT = follower.sent();
      if (random.chance(0.1)) follower.rebase();
      const double share = random.chance(0.3) ? 1.0 : random.uniform(0.0, 1.0);
      Twist twist_W = follower.towards(pose(random.direction(), random.uniform(-3.0, 3.0)), kPeriod);
      twist_W = {share * twist_W.v_W, share * twist_W.w_W};
      const Isometry3d sent_WT = follower.moveOn(twist_W);
      EXPECT_LE((sent_WT.translation() - before_WT.translation()).norm(), 0.0025 * (1.0 + 1e-9));
      EXPECT_LE(angleBetween(before_WT, sent_WT), 0.01 * (1.0 + 1e-6));
      EXPECT_TRUE((sent_WT.linear() * sent_WT.linear().transpose()).isIdentity(1e-12));
    }
  }
}

TEST(PoseFollowerTest, RefusesLimitsThatAreNotPositive) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -1.0, nan}) {
    EXPECT_THROW(PoseFollower({bad, 1.0}, /*incremental=*/false), InvalidInput);
    EXPECT_THROW(PoseFollower({1.0, bad}, /*incremental=*/false), InvalidInput);
  }
}

}  // namespace
}  // namespace sweep_guard_core
