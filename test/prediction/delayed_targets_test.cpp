#include "prediction/delayed_targets.h"

#include <gtest/gtest.h>

#include <vector>

namespace sweep_guard_core {
namespace {

// Goes at 0.1 m/s along x and turns at 4 rad/s about z.
StampedPose poseAt(double seconds) {
  StampedPose pose;
  pose.stamp = Time(fromSeconds(seconds));
  pose.X_WT =
      Eigen::Translation3d(0.1 * seconds, 0.0, 0.0) * Eigen::AngleAxisd(4.0 * seconds, Eigen::Vector3d::UnitZ());
  return pose;
}

struct Told {
  double known;
  size_t i;
  Vector6d moved;
};

std::vector<Told> tell(DelayedTargets<double>& hindsight, double seconds) {
  std::vector<Told> told;
  hindsight.add(poseAt(seconds), seconds, [&](double known, size_t i, const Vector6d& moved) {
    told.push_back({known, i, moved});
  });
  return told;
}

// Poses do not come when a horizon ends: the way until then is interpolated.
TEST(HindsightTest, TellsForEveryPoseAndHorizonHowFarTheToolWent) {
  DelayedTargets<double> hindsight;
  std::vector<Told> told;
  constexpr double kPeriod = 0.037;
  constexpr int kPoses = 100;
  for (int pose = 0; pose < kPoses; ++pose) {
    const auto news = tell(hindsight, 50.0 + kPeriod * pose);
    told.insert(told.end(), news.begin(), news.end());
  }
  size_t expected = 0;
  for (const double ahead : kLearnedHorizons) expected += kPoses - static_cast<size_t>(std::ceil(ahead / kPeriod));
  EXPECT_EQ(told.size(), expected);
  for (const Told& one : told) {
    const Vector6d truth = displacement(poseAt(one.known).X_WT, poseAt(one.known + kLearnedHorizons[one.i]).X_WT);
    EXPECT_LT((one.moved - truth).norm(), 1e-9) << kLearnedHorizons[one.i] << " s after " << one.known << " s";
  }
}

TEST(HindsightTest, TellsNothingAcrossAnInterruption) {
  DelayedTargets<double> hindsight;
  for (int i = 0; i < 10; ++i) tell(hindsight, 50.0 + 0.001 * i);
  hindsight.clear();
  EXPECT_TRUE(tell(hindsight, 60.0).empty());
  const auto told = tell(hindsight, 62.0);
  EXPECT_EQ(told.size(), kLearnedHorizons.size());
  for (const Told& one : told) EXPECT_EQ(one.known, 60.0);
}

TEST(HindsightTest, ForgetsANewestPoseThatWasWrong) {
  DelayedTargets<double> hindsight;
  tell(hindsight, 50.0);
  StampedPose right = poseAt(50.0);
  right.X_WT.translation().x() += 1.0;
  hindsight.correctNewest(right, 7.0);
  const auto told = tell(hindsight, 52.0);
  ASSERT_EQ(told.size(), kLearnedHorizons.size());
  EXPECT_EQ(told[7].known, 7.0);
  EXPECT_NEAR(told[7].moved[0], 0.5 * (poseAt(52.0).X_WT.translation().x() - right.X_WT.translation().x()), 1e-12);
}

}  // namespace
}  // namespace sweep_guard_core
