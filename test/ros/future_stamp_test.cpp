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

const Time kStamp{std::chrono::seconds(1000)};

class FutureStampTest : public testing::Test {
 protected:
  FutureStampTest() { ros::Time::init(); }
  ~FutureStampTest() override { ros::Time::init(); }

  // Lets a clock go on while a stamp is judged, once it is waited for.
  static bool liesInFutureWhile(const ros::Time& before, const ros::Time& after) {
    ros::Time::setNow(before);
    Heartbeat heartbeat;
    auto answer = std::async(std::launch::async, [&heartbeat] {
      heartbeat.begin();
      const bool future = liesInFuture(kStamp);
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
    ros::Time::setNow(ros::Time(clock));
    sweep_guard_core::Timestamps input{kStamp, begin};
    auto answer = std::async(std::launch::async, [&input] { return liesInFuture(input); });
    const bool waits = answer.wait_for(std::chrono::milliseconds(5)) != std::future_status::ready;
    ros::Time::setNow(ros::Time(1000.0));
    EXPECT_FALSE(answer.get());
    EXPECT_EQ(input.stamp, kStamp);
    if (waits) EXPECT_GT(input.received, begin) << clock;
    if (clock > 999.95) EXPECT_EQ(input.received, begin) << clock;
  }
}

}  // namespace
}  // namespace sweep_guard_ros
