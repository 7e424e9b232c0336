#include "ros/input/future_stamp.h"

#include <gtest/gtest.h>
#include <ros/time.h>

#include <chrono>
#include <future>

#include "common/heartbeat.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Heartbeat;
using sweep_guard_core::Time;
using sweep_guard_core::Timestamps;

const Time kStamp{std::chrono::seconds(1000)};

class FutureStampTest : public testing::Test {
 protected:
  FutureStampTest() { ros::Time::init(); }
  ~FutureStampTest() override { ros::Time::init(); }

  // Lets a clock go on while a stamp is judged, once it is waited for.
  static bool liesInFutureWhile(const ros::Time& before, const ros::Time& after) {
    Timestamps input{kStamp, {}};
    return liesInFutureWhile(before, after, input);
  }
  static bool liesInFutureWhile(const ros::Time& before, const ros::Time& after, Timestamps& input) {
    ros::Time::setNow(before);
    Heartbeat heartbeat;
    auto answer = std::async(std::launch::async, [&heartbeat, &input] {
      heartbeat.begin();
      const bool future = liesInFuture(input);
      heartbeat.end();
      return future;
    });
    while (heartbeat.steps().value_or(0) == 0 &&
           answer.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready) {
    }
    ros::Time::setNow(after);
    return answer.get();
  }
};

TEST_F(FutureStampTest, AMessageMayOvertakeTheClock) {
  EXPECT_FALSE(liesInFutureWhile(ros::Time(999.6), ros::Time(999.96)));
}

TEST_F(FutureStampTest, AMessageMayOvertakeTheFirstMessageOfTheClock) {
  EXPECT_FALSE(liesInFutureWhile(ros::Time(), ros::Time(1000.0)));
}

TEST_F(FutureStampTest, OneThatIsFarAheadIsNotWaitedFor) {
  EXPECT_TRUE(liesInFutureWhile(ros::Time(999.4), ros::Time(1000.0)));
}

TEST_F(FutureStampTest, AClockThatBeginsEarlierSaysThatItLiesAhead) {
  EXPECT_TRUE(liesInFutureWhile(ros::Time(), ros::Time(990.0)));
}

TEST_F(FutureStampTest, AnInputThatWaitsIsReceivedWhenTheClockHasCome) {
  const sweep_guard_core::SteadyTime begin = std::chrono::steady_clock::now();
  for (const double clock : {999.6, 999.8, 999.949, 999.951, 1000.0}) {
    Timestamps input{kStamp, begin};
    EXPECT_FALSE(liesInFutureWhile(ros::Time(clock), ros::Time(1000.0), input)) << clock;
    EXPECT_EQ(input.stamp, kStamp) << clock;
    EXPECT_EQ(input.received > begin, clock < 999.95) << clock;
  }
}

}  // namespace
}  // namespace sweep_guard_ros
