#include "simulation/pose_stream.h"

#include <gtest/gtest.h>

#include <vector>

namespace sweep_guard_simulation {
namespace {

using std::chrono::milliseconds;
using sweep_guard_core::StampedPose;
using sweep_guard_core::Time;

TEST(PoseStreamTest, GuidedPosesComeAtAnEvenRateAlsoWhileTheTipRests) {
  std::vector<double> steps;
  const PoseStream stream = guided(GuidedTip(Eigen::Isometry3d::Identity(), {}), /*rate=*/250.0,
                                   [&steps](GuidedTip&, double dt) { steps.push_back(dt); });
  for (int i = 0; i < 5; ++i) EXPECT_EQ(stream()->stamp, Time(i * milliseconds(4)));
  EXPECT_EQ(steps, std::vector<double>(4, 0.004));
}

TEST(PoseStreamTest, GuidedPosesBeginWhereTheTipIsAndFollowTheGuide) {
  Twist desired;
  desired.v_W.x() = 0.01;
  const PoseStream stream = guided(GuidedTip(Eigen::Isometry3d(Eigen::Translation3d(1, 2, 3)), {}), /*rate=*/100.0,
                                   [desired](GuidedTip& tip, double dt) { tip.moveAt(desired, dt); });
  EXPECT_EQ(stream()->X_WT.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(stream()->X_WT.translation().isApprox(Eigen::Vector3d(1.0001, 2, 3), 1e-9));
}

TEST(PoseStreamTest, DrillingEndsAfterOneRoundUnlessItLoops) {
  const Drilling drilling({{0, 0, 0}}, {});
  const auto count = [](const PoseStream& stream, int most) {
    int poses = 0;
    while (poses < most && stream()) ++poses;
    return poses;
  };
  const int round = static_cast<int>(drilling.duration() * 100.0) + 1;
  EXPECT_EQ(count(sampled(drilling, 100.0, /*loop=*/false), 10 * round), round);
  EXPECT_EQ(count(sampled(drilling, 100.0, /*loop=*/true), 10 * round), 10 * round);
}

}  // namespace
}  // namespace sweep_guard_simulation
