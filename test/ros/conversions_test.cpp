#include "sweep_guard/ros/conversions.h"

#include <gtest/gtest.h>

namespace sweep_guard_ros {
namespace {

using namespace std::chrono_literals;
using sweep_guard_core::Duration;
using sweep_guard_core::Time;

// `/clock` may stand there.
TEST(ConversionsTest, StampsAtTheEndOfRosTimeAreKeptAndLaterOnesAreTheLast) {
  const Time last = fromMsg(ros::TIME_MAX);
  EXPECT_EQ(toMsg(last), ros::TIME_MAX);
  EXPECT_EQ(toMsg(last + 200ms), ros::TIME_MAX);
  EXPECT_EQ(toMsg(Time::max()), ros::TIME_MAX);
  EXPECT_EQ(toMsg(last - 1ns), ros::Time(ros::TIME_MAX.sec, ros::TIME_MAX.nsec - 1));
}

TEST(ConversionsTest, StampsBeforeTheBeginningOfRosTimeAreZero) {
  EXPECT_EQ(toMsg(Time(-1ns)), ros::Time());
  EXPECT_EQ(toMsg(Time(1ns)), ros::Time(0, 1));
}

TEST(ConversionsTest, DurationsBeyondThoseOfRosAreTheLongest) {
  EXPECT_EQ(toMsg(Duration(-1500ms)), ros::Duration(-1.5));
  EXPECT_GT(toMsg(Duration::max()).toSec(), 2e9);
  EXPECT_LT(toMsg(Duration::min()).toSec(), -2e9);
}

}  // namespace
}  // namespace sweep_guard_ros
