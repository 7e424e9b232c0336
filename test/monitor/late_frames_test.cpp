#include "monitor/late_frames.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "monitor/warning_monitor_fixture.h"

namespace sweep_guard_core {
namespace {

class LateFramesTest : public testing::Test {
 protected:
  /// Transforms every `period_ms`, each `late_ms` late, so many in all.
  void send(int period_ms, int late_ms, int count) {
    for (int i = 0; i < count; ++i, stamp_ms_ += period_ms) {
      addTransform(inputs_.frames, "tray", at(stamp_ms_).stamp, at(stamp_ms_ + late_ms), milliseconds(100));
      now_ms_ = stamp_ms_ + late_ms;
    }
  }
  bool isLateAt(int ms) const { return lateAge(inputs_.frames.at(0), at(ms), milliseconds(100)).has_value(); }

  WarningInputs inputs_;
  int stamp_ms_ = 1000;
  int now_ms_ = 0;
};

TEST_F(LateFramesTest, AFrameMayBeOlderThanThePoseByItsPeriod) {
  send(/*period_ms=*/33, /*late_ms=*/60, 20);
  EXPECT_FALSE(isLateAt(now_ms_)) << "60 ms";
  EXPECT_FALSE(isLateAt(now_ms_ + 73)) << "133 ms";
  EXPECT_TRUE(isLateAt(now_ms_ + 74));
}

TEST_F(LateFramesTest, OfThePeriodCountsNoMoreThanThePoseTimeout) {
  send(/*period_ms=*/190, /*late_ms=*/0, 20);
  EXPECT_FALSE(isLateAt(now_ms_ + 200));
  EXPECT_TRUE(isLateAt(now_ms_ + 201));
}

TEST_F(LateFramesTest, SeldomAndLateIsLateAllTheTime) {
  send(/*period_ms=*/100, /*late_ms=*/101, 3);
  for (int i = 0; i < 30; ++i) {
    send(100, 101, 1);
    for (int ms = 0; ms < 100; ms += 10) EXPECT_TRUE(isLateAt(now_ms_ + ms)) << i << ", after " << ms << " ms";
  }
}

TEST_F(LateFramesTest, ItEndsASecondAfterTheLastThatWasLate) {
  send(33, 10, 20);
  stamp_ms_ += 300;
  send(33, 10, 1);  // the one before is 333 ms + 10 ms old by then
  const int late_at = now_ms_;
  send(33, 10, 30);
  EXPECT_TRUE(isLateAt(late_at + 1000));
  EXPECT_FALSE(isLateAt(late_at + 1001));
  EXPECT_EQ(inputs_.frames[0].late, milliseconds(343));
}

TEST_F(LateFramesTest, SilenceIsLateByEitherClock) {
  send(33, 10, 20);
  const Instant frozen{at(now_ms_).stamp, at(now_ms_ + 200).steady};
  EXPECT_EQ(lateAge(inputs_.frames[0], frozen, milliseconds(100)), milliseconds(200));
}

TEST_F(LateFramesTest, ASingleGapDoesNotMakeThePeriodLonger) {
  send(20, 0, 20);
  stamp_ms_ += 80;
  send(20, 0, 2);
  EXPECT_EQ(inputs_.frames[0].period, milliseconds(20));
}

TEST_F(LateFramesTest, AFrameBeginsAnewWhenTimeGoesBack) {
  send(33, 10, 20);
  stamp_ms_ = 200;
  send(33, 10, 3);
  EXPECT_EQ(inputs_.frames[0].newest.stamp, at(266).stamp);
  EXPECT_EQ(inputs_.frames[0].period, milliseconds(33));
}

TEST_F(LateFramesTest, ForgetsFramesThatAreGone) {
  send(33, 10, 2);
  addTransform(inputs_.frames, "arm", at(0).stamp, at(0), milliseconds(100));
  keepOnly({"arm"}, inputs_.frames);
  ASSERT_EQ(inputs_.frames.size(), 1U);
  EXPECT_EQ(inputs_.frames[0].name, "arm");
}

class LateFrameWarningTest : public WarningMonitorTest {};

TEST_F(LateFrameWarningTest, NamesTheFrameItsAgeAndTheParameter) {
  monitor_.frameHeard("tray", at(1000).stamp, at(1010));
  EXPECT_EQ(reasonsAt(1050) & kTfFail, 0U);
  monitor_.frameHeard("tray", at(1250).stamp, at(1260));
  EXPECT_NE(reasonsAt(1270) & kTfFail, 0U);
  const std::string text = warningOf(monitor_, at(1270)).text;
  for (const char* const part : {"'tray'", "0.26 s", "timing/pose_timeout"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in: " << text;
}

TEST_F(LateFrameWarningTest, CountsAFrameOnlyWhileAWorkpieceIsInIt) {
  monitor_.frameHeard("tray", at(500).stamp, at(510));
  EXPECT_NE(reasonsAt(1050) & kTfFail, 0U);
  monitor_.setMovingFrames({});
  EXPECT_EQ(reasonsAt(1050) & kTfFail, 0U);
}

// A restart knows no better: the frame is as silent as before.
TEST_F(LateFrameWarningTest, SilenceIsNotForgottenByARestart) {
  monitor_.frameHeard("tray", at(500).stamp, at(510));
  monitor_.restart();
  EXPECT_NE(reasonsAt(1050) & kTfFail, 0U);
}

}  // namespace
}  // namespace sweep_guard_core
