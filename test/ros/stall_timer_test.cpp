#include "ros/threads/stall_timer.h"

#include <gtest/gtest.h>

namespace sweep_guard_ros {
namespace {

using namespace std::chrono_literals;
using Activity = ThreadState::Activity;
using sweep_guard_core::Duration;

// A thread with work, checked every 10 ms.
class StallTimerTest : public testing::Test {
 protected:
  StallTimerTest() { check(Activity::kRunnable, 0ms, 10ms); }

  void check(Activity activity, Duration used, Duration since_last = 10ms, bool starving = false) {
    processor_time_ += used;
    timer_.check(steps(), {processor_time_, activity}, since_last, starving);
  }
  // @param used  processor time in each 10 ms
  Duration stalledAfter(Duration time, Activity activity, Duration used) {
    for (Duration passed{}; passed < time; passed += 10ms) check(activity, used);
    return timer_.stalled();
  }

  std::optional<std::uint64_t> steps() const { return working_ ? std::optional(steps_) : std::nullopt; }

  std::uint64_t steps_ = 1;
  bool working_ = true;
  Duration processor_time_{};
  StallTimer timer_;
};

TEST_F(StallTimerTest, CountsTheProcessorTimeOfAThreadThatRuns) {
  EXPECT_EQ(stalledAfter(100ms, Activity::kRunnable, 10ms), 100ms);
  EXPECT_EQ(stalledAfter(100ms, Activity::kRunnable, 2ms), 120ms);
}

TEST_F(StallTimerTest, CountsTheTimeOfAThreadThatIsBlocked) {
  EXPECT_EQ(stalledAfter(150ms, Activity::kBlocked, 0ms), 150ms);
}

TEST_F(StallTimerTest, CountsTheTimeOfAThreadThatPolls) {
  EXPECT_EQ(stalledAfter(150ms, Activity::kBlocked, 1ms), 150ms);
}

TEST_F(StallTimerTest, BeginsAnewWithEachStep) {
  stalledAfter(100ms, Activity::kBlocked, 0ms);
  ++steps_;
  check(Activity::kBlocked, 0ms);
  EXPECT_EQ(timer_.stalled(), 0ms);
  EXPECT_EQ(stalledAfter(50ms, Activity::kBlocked, 0ms), 50ms);
}

TEST_F(StallTimerTest, CountsNothingWhileThereIsNoWork) {
  stalledAfter(100ms, Activity::kBlocked, 0ms);
  working_ = false;
  EXPECT_EQ(stalledAfter(1s, Activity::kBlocked, 0ms), 0ms);
  working_ = true;
  check(Activity::kBlocked, 0ms);
  EXPECT_EQ(timer_.stalled(), 0ms);
}

TEST_F(StallTimerTest, CountsNothingWhileTheThreadGetsNoProcessor) {
  EXPECT_EQ(stalledAfter(10s, Activity::kRunnable, 0ms), 0ms);
}

TEST_F(StallTimerTest, CountsNothingWhileTheThreadIsStopped) {
  EXPECT_EQ(stalledAfter(10s, Activity::kStopped, 0ms), 0ms);
}

// All threads stop with the process, the one that checks too.
TEST_F(StallTimerTest, CountsHardlyAnythingOfAStoppedProcess) {
  check(Activity::kBlocked, 0ms, 3s);
  EXPECT_LE(timer_.stalled(), 20ms);
}

TEST_F(StallTimerTest, CountsNothingWhileItMayBeBlockedByAThreadThatStarves) {
  for (int i = 0; i < 1000; ++i) check(Activity::kBlocked, 0ms, 10ms, /*starving=*/true);
  EXPECT_EQ(timer_.stalled(), 0ms);
}

TEST_F(StallTimerTest, AThreadWithWorkStarvesIfItIsRunnableAndDoesNotRun) {
  const auto starves = [&](Activity activity, Duration used) {
    return timer_.starves(steps(), {processor_time_ + used, activity});
  };
  EXPECT_TRUE(starves(Activity::kRunnable, 0ms));
  EXPECT_FALSE(starves(Activity::kRunnable, 1ms));
  EXPECT_FALSE(starves(Activity::kBlocked, 0ms));
  working_ = false;
  EXPECT_FALSE(starves(Activity::kRunnable, 0ms));
}

}  // namespace
}  // namespace sweep_guard_ros
