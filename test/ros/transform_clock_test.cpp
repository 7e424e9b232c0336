#include "ros/input/transform_clock.h"

#include <gtest/gtest.h>

namespace sweep_guard_ros {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using sweep_guard_core::Instant;
using sweep_guard_core::SteadyTime;
using sweep_guard_core::Time;

Instant instantAt(milliseconds stamp, milliseconds steady) { return {Time(stamp), SteadyTime(steady)}; }

TEST(TransformClockTest, ATransformMayBeStampedTenSecondsAhead) {
  TransformClock clock;
  EXPECT_FALSE(clock.hasGoneBack(instantAt(seconds(100), seconds(1))));
  EXPECT_FALSE(clock.hasGoneBack(instantAt(seconds(101), seconds(2))));
  EXPECT_EQ(clock.refusal(Time(seconds(110)), instantAt(seconds(101), seconds(2))), "");
  EXPECT_EQ(clock.refusal(Time(milliseconds(111250)), instantAt(seconds(101), seconds(2))),
            "its stamp lies 10.25 s in the future, more than 10 s");
}

// The clock steps from 100 s back to 95 s. A transform that was sent before, for 100.1 s, arrives after that.
TEST(TransformClockTest, OneOfTheTimeBeforeThatComesLateDoesNotCount) {
  TransformClock clock;
  clock.hasGoneBack(instantAt(seconds(100), seconds(1)));
  EXPECT_TRUE(clock.hasGoneBack(instantAt(seconds(95), milliseconds(1010))));
  EXPECT_EQ(clock.refusal(Time(milliseconds(100100)), instantAt(milliseconds(95900), milliseconds(1910))),
            "its stamp is of the time before it went back");
  EXPECT_EQ(clock.refusal(Time(milliseconds(96000)), instantAt(milliseconds(95900), milliseconds(1910))), "");
  EXPECT_EQ(clock.refusal(Time(milliseconds(100100)), instantAt(milliseconds(96000), milliseconds(2010))), "");
}

TEST(TransformClockTest, WithoutATimeEveryStampCounts) {
  EXPECT_EQ(TransformClock().refusal(Time(seconds(1000)), instantAt(seconds(0), seconds(1))), "");
}

}  // namespace
}  // namespace sweep_guard_ros
