#include "monitor/clock_watch.h"

#include <gtest/gtest.h>

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

const Time kStart{std::chrono::seconds(1000)};

// The machine may have slept before the guard began.
TEST(ClockWatchTest, TimeThatGoesOnIsNoJump) {
  ClockWatch watch;
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(watch.jump(kStart + milliseconds(10 * i), std::chrono::hours(5)));
  }
}

TEST(ClockWatchTest, ClocksMayDifferByALittle) {
  ClockWatch watch;
  watch.jump(kStart, Duration::zero());
  EXPECT_FALSE(watch.jump(kStart - milliseconds(100), milliseconds(200)));
}

TEST(ClockWatchTest, TimeThatGoesBackIsAJump) {
  ClockWatch watch;
  watch.jump(kStart, Duration::zero());
  EXPECT_EQ(watch.jump(kStart - milliseconds(110), Duration::zero()), "time went back by 0.11 s");
  EXPECT_FALSE(watch.jump(kStart, Duration::zero()));
}

// The stamps may go on as if nothing had happened.
TEST(ClockWatchTest, SuspendIsAJump) {
  ClockWatch watch;
  watch.jump(kStart, milliseconds(7000));
  EXPECT_EQ(watch.jump(kStart + milliseconds(10), milliseconds(7210)), "the machine was suspended for 0.21 s");
  EXPECT_FALSE(watch.jump(kStart + milliseconds(20), milliseconds(7210)));
}

TEST(ClockWatchTest, SuspendedTimeStandsStillWhileTheMachineRuns) {
  const Duration before = suspendedTime();
  EXPECT_LT(suspendedTime() - before, milliseconds(200));
}

// The first two readings of the clocks are 10 s apart, as in a process that was stopped in between.
TEST(ClockWatchTest, APauseBetweenReadingsIsNoSuspend) {
  static int readings;
  readings = 0;
  const ReadClock read = [](clockid_t clock) -> Duration {
    const Duration running = std::chrono::seconds(readings++ == 0 ? 100 : 110);
    return clock == CLOCK_BOOTTIME ? running + std::chrono::seconds(7) : running;
  };
  EXPECT_EQ(suspendedTime(read), std::chrono::seconds(7));
  EXPECT_GT(readings, 3);
}

}  // namespace
}  // namespace sweep_guard_core
