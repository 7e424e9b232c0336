#include "evaluation/recorded_motion.h"

#include <gtest/gtest.h>

#include "timeline.h"

namespace sweep_guard_evaluation {
namespace {

using namespace sweep_guard_core::timeline;
using sweep_guard_core::StampedPose;

std::vector<StampedPose> posesAt(const std::vector<int>& stamps_ms) {
  std::vector<StampedPose> poses;
  for (const int ms : stamps_ms) {
    poses.push_back({at(ms), Eigen::Isometry3d::Identity()});
    poses.back().X_WT.translation().x() = static_cast<double>(poses.size());
  }
  return poses;
}

TEST(RecordedMotionTest, GoesStraightAndTurnsEvenlyBetweenItsPoses) {
  std::vector<StampedPose> poses = posesAt({0, 100});
  poses[1].X_WT.linear() = Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Isometry3d between = RecordedMotion(poses).at(at(25));
  EXPECT_NEAR(between.translation().x(), 1.25, 1e-15);
  EXPECT_TRUE(between.linear().isApprox(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ()).toRotationMatrix(), 1e-14));
}

TEST(RecordedMotionTest, IsAtItsPosesUpToTheLast) {
  const RecordedMotion motion(posesAt({0, 100, 200}));
  EXPECT_EQ(motion.at(at(0)).translation().x(), 1.0);
  EXPECT_EQ(motion.at(at(100)).translation().x(), 2.0);
  EXPECT_EQ(motion.at(at(200)).translation().x(), 3.0);
}

TEST(RecordedMotionTest, KeepsTheLastOfPosesThatShareAStamp) {
  const RecordedMotion motion(posesAt({0, 100, 100, 200}));
  EXPECT_EQ(motion.poses().size(), 3U);
  EXPECT_EQ(motion.at(at(100)).translation().x(), 3.0);
}

TEST(RecordedMotionTest, EndsASegmentAtAnIntervalOfMoreThanAQuarterOfASecond) {
  const RecordedMotion motion(posesAt({0, 10, 260, 270, 521, 531}));
  ASSERT_EQ(motion.segments().size(), 2U);
  EXPECT_EQ(motion.segments()[0].end, at(270));
  EXPECT_EQ(motion.segments()[1].begin, at(521));
  EXPECT_TRUE(motion.isContinuous(at(0), at(270)));
  EXPECT_FALSE(motion.isContinuous(at(0), at(271)));
  EXPECT_FALSE(motion.isContinuous(at(300), at(310)));
  EXPECT_FALSE(motion.isContinuous(at(270), at(521)));
  EXPECT_TRUE(motion.isContinuous(at(521), at(531)));
  EXPECT_FALSE(motion.isContinuous(at(-1), at(10)));
}

TEST(RecordedMotionTest, AllowsSlowPosesThreeOfTheirPeriods) {
  EXPECT_EQ(RecordedMotion(posesAt({0, 200, 400, 1000, 1200})).segments().size(), 1U);
  EXPECT_EQ(RecordedMotion(posesAt({0, 200, 400, 1001, 1201})).segments().size(), 2U);
}

}  // namespace
}  // namespace sweep_guard_evaluation
