#include "prediction/delayed_targets.h"

#include <gtest/gtest.h>

#include <vector>

namespace sweep_guard_core {
namespace {

// Goes at 0.1 m/s along x and turns at 4 rad/s about z.
StampedPose screwAt(double seconds) {
  StampedPose pose;
  pose.stamp = Time(fromSeconds(seconds));
  pose.X_WT =
      Eigen::Translation3d(0.1 * seconds, 0.0, 0.0) * Eigen::AngleAxisd(4.0 * seconds, Eigen::Vector3d::UnitZ());
  return pose;
}

struct Target {
  double known;
  size_t i;
  Vector6d moved;
};

std::vector<Target> addPose(DelayedTargets<PoseSpace, double>& targets, double seconds) {
  std::vector<Target> given;
  targets.add(screwAt(seconds), seconds, [&](double known, size_t i, const Vector6d& moved) {
    given.push_back({known, i, moved});
  });
  return given;
}

// Poses do not come when a horizon ends: the displacement until then is interpolated.
TEST(DelayedTargetsTest, GivesTheDisplacementForEveryPoseAndHorizon) {
  DelayedTargets<PoseSpace, double> targets;
  std::vector<Target> given;
  constexpr double kPeriod = 0.037;
  constexpr int kPoses = 100;
  for (int pose = 0; pose < kPoses; ++pose) {
    const auto added = addPose(targets, 50.0 + kPeriod * pose);
    given.insert(given.end(), added.begin(), added.end());
  }
  size_t expected = 0;
  for (const double ahead : kLearnedHorizons) expected += kPoses - static_cast<size_t>(std::ceil(ahead / kPeriod));
  EXPECT_EQ(given.size(), expected);
  for (const Target& one : given) {
    const Vector6d truth = displacement(screwAt(one.known).X_WT, screwAt(one.known + kLearnedHorizons[one.i]).X_WT);
    EXPECT_LT((one.moved - truth).norm(), 1e-9) << kLearnedHorizons[one.i] << " s after " << one.known << " s";
  }
}

TEST(DelayedTargetsTest, GivesNothingAcrossAnInterruption) {
  DelayedTargets<PoseSpace, double> targets;
  for (int i = 0; i < 10; ++i) addPose(targets, 50.0 + 0.001 * i);
  targets.clear();
  EXPECT_TRUE(addPose(targets, 60.0).empty());
  const auto given = addPose(targets, 62.0);
  EXPECT_EQ(given.size(), kLearnedHorizons.size());
  for (const Target& one : given) EXPECT_EQ(one.known, 60.0);
}

TEST(DelayedTargetsTest, UsesTheCorrectedNewestPose) {
  DelayedTargets<PoseSpace, double> targets;
  addPose(targets, 50.0);
  StampedPose right = screwAt(50.0);
  right.X_WT.translation().x() += 1.0;
  targets.correctNewest(right, 7.0);
  const auto given = addPose(targets, 52.0);
  ASSERT_EQ(given.size(), kLearnedHorizons.size());
  EXPECT_EQ(given[7].known, 7.0);
  EXPECT_NEAR(given[7].moved[0], 0.5 * (screwAt(52.0).X_WT.translation().x() - right.X_WT.translation().x()), 1e-12);
}

}  // namespace
}  // namespace sweep_guard_core
