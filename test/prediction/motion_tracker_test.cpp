#include "prediction/motion_tracker.h"

#include <gtest/gtest.h>

namespace sweep_guard_core {
namespace {

using Step = PoseTracker::Step;

StampedPose poseAt(double seconds, const Eigen::Vector3d& p_W, double turn = 0.0) {
  StampedPose pose;
  pose.stamp = Time(fromSeconds(100.0 + seconds));
  pose.X_WT = Eigen::Translation3d(p_W) * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ());
  return pose;
}

class MotionTrackerTest : public testing::Test {
 protected:
  Step addAt(double seconds, double x = 0.0) { return track_.add(poseAt(seconds, {x, 0.0, 0.0})); }

  PoseTracker track_{{/*max_speed=*/2.0, /*max_turn_rate=*/10.0}};
};

TEST_F(MotionTrackerTest, BeginsWithTheFirstPoseAndContinues) {
  EXPECT_EQ(addAt(0.0), Step::kBegins);
  EXPECT_EQ(addAt(0.1, 0.1), Step::kContinues);
  EXPECT_EQ(track_.samples(), 2);
  EXPECT_NEAR(track_.coordinates()[0], 0.1, 1e-15);
  EXPECT_EQ(track_.period(), std::chrono::milliseconds(100));
}

TEST_F(MotionTrackerTest, AGapInterruptsTheMotion) {
  addAt(0.00);
  addAt(0.01);
  EXPECT_EQ(addAt(0.26), Step::kContinues);
  addAt(0.27);
  EXPECT_EQ(addAt(0.5201), Step::kBegins);
  EXPECT_EQ(track_.samples(), 1);
}

TEST_F(MotionTrackerTest, SlowPosesAreNoGap) {
  addAt(0.0);
  addAt(0.4);
  for (int i = 2; i < 10; ++i) EXPECT_EQ(addAt(0.4 * i), Step::kContinues);
  EXPECT_EQ(addAt(3.6 + 1.01), Step::kBegins);
}

TEST_F(MotionTrackerTest, ALongGapDoesNotExcuseTheNext) {
  addAt(0.0);
  EXPECT_EQ(addAt(12.0), Step::kBegins);
  EXPECT_EQ(addAt(14.0), Step::kBegins);
  addAt(14.01);
  EXPECT_EQ(addAt(14.9), Step::kBegins);
}

TEST_F(MotionTrackerTest, AJumpInterruptsTheMotion) {
  addAt(0.0);
  EXPECT_EQ(addAt(0.1, 0.199), Step::kContinues);
  EXPECT_EQ(addAt(0.2, 0.400), Step::kBegins);
  track_.add(poseAt(0.3, {0.4, 0.0, 0.0}, 0.99));
  EXPECT_EQ(track_.step(), Step::kContinues);
  track_.add(poseAt(0.4, {0.4, 0.0, 0.0}, 2.0));
  EXPECT_EQ(track_.step(), Step::kBegins);
}

// Recorders that cut their stamps make two poses 10 ms apart look simultaneous.
TEST_F(MotionTrackerTest, APoseThatIsNotLaterCorrectsTheOneBefore) {
  addAt(0.0);
  addAt(0.1, 0.1);
  EXPECT_EQ(addAt(0.1, 0.11), Step::kCorrects);
  EXPECT_EQ(track_.samples(), 2);
  EXPECT_NEAR(track_.coordinates()[0], 0.11, 1e-15);
  EXPECT_EQ(track_.newest().X_WT.translation().x(), 0.11);
}

TEST_F(MotionTrackerTest, ACorrectionThatIsAJumpInterruptsTheMotion) {
  addAt(0.0);
  addAt(0.1, 0.1);
  EXPECT_EQ(addAt(0.1, 9.0), Step::kBegins);
}

// Poses closer than half a millisecond say nothing of a speed, and a flood of them would fill the memory.
TEST_F(MotionTrackerTest, PosesHardlyLaterCorrectTheOneBefore) {
  addAt(0.0);
  EXPECT_EQ(addAt(0.000499), Step::kCorrects);
  EXPECT_EQ(addAt(0.0005), Step::kContinues);
}

// Of regular poses two are enough, in spite of jitter, once their period is known.
TEST_F(MotionTrackerTest, OfRegularPosesTheNewestTwoTellAVelocity) {
  for (const double period : {0.001, 0.008, 0.01, 0.033, 0.2}) {
    PoseTracker track{{/*max_speed=*/2.0, /*max_turn_rate=*/10.0}};
    double seconds = 0.0;
    for (int i = 0; i < 1000; ++i) {
      const double jitter = (i % 3 - 1) * 0.2 * period;
      seconds += period;
      track.add(poseAt(seconds + jitter, Eigen::Vector3d::Zero()));
      if (seconds > 0.8) {
        ASSERT_GE(track.period(), track.leastSpan()) << period << ", pose " << i;
      }
    }
    EXPECT_EQ(track.trustIn(fromSeconds(0.6 * period)), 1.0);
  }
}

TEST_F(MotionTrackerTest, OfBurstsOnlyTwentyMillisecondsTellAVelocity) {
  for (const int poses : {2, 5, 12}) {
    for (int burst = 0; burst < 4; ++burst) {
      for (int i = 0; i < poses; ++i) addAt(0.05 * burst + 0.001 * i);
    }
    EXPECT_LE(track_.leastSpan(), std::chrono::milliseconds(20)) << poses;
    EXPECT_GE(track_.leastSpan(), std::chrono::milliseconds(18)) << poses;
    EXPECT_NEAR(track_.trustIn(std::chrono::milliseconds(4)), 0.2, 0.03);
    track_.interrupt();
  }
}

TEST_F(MotionTrackerTest, TurnsAddUpBeyondAFullTurn) {
  for (int i = 0; i <= 100; ++i) track_.add(poseAt(0.1 * i, {0.0, 0.0, 0.0}, 0.5 * i));
  EXPECT_EQ(track_.samples(), 101);
  EXPECT_NEAR(track_.coordinates()[5], 50.0, 1e-12);
}

TEST_F(MotionTrackerTest, BeginsAnewWhenInterrupted) {
  addAt(10.0);
  addAt(10.1);
  track_.interrupt();
  EXPECT_EQ(addAt(5.0), Step::kBegins);
  EXPECT_EQ(addAt(5.1), Step::kContinues);
}

}  // namespace
}  // namespace sweep_guard_core
