#include "ros/threads/timer_thread.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <future>
#include <new>

namespace sweep_guard_ros {
namespace {

using namespace std::chrono_literals;
using SteadyClock = std::chrono::steady_clock;

constexpr auto kLate = 500ms;  // for a machine under load

// Waits for this many calls.
class Calls {
 public:
  explicit Calls(int awaited) : left_(awaited) {}
  void count() {
    if (--left_ == 0) reached_.set_value();
  }
  void await() { reached_.get_future().wait(); }

 private:
  std::atomic<int> left_;
  std::promise<void> reached_;
};

class TimerThreadTest : public testing::Test {
 protected:
  Supervisor supervisor_{Process::kShared};
};

TEST_F(TimerThreadTest, CallsEachFunctionAtItsPeriod) {
  Calls fast(20);
  Calls slow(4);
  TimerThread thread;
  thread.every(10ms, [&] { fast.count(); });
  thread.every(100ms, [&] { slow.count(); });
  const auto begin = SteadyClock::now();
  thread.start(supervisor_, {"timers"});
  fast.await();
  EXPECT_GE(SteadyClock::now() - begin, 200ms);
  EXPECT_LT(SteadyClock::now() - begin, 400ms + kLate);
  slow.await();
  EXPECT_GE(SteadyClock::now() - begin, 400ms);
  EXPECT_LT(SteadyClock::now() - begin, 800ms + kLate);
}

TEST_F(TimerThreadTest, GoesOnAfterExceptions) {
  Calls calls(5);
  TimerThread thread;
  thread.every(1ms, [&] {
    calls.count();
    throw std::bad_alloc();
  });
  thread.start(supervisor_, {"timers"});
  calls.await();
}

TEST_F(TimerThreadTest, DoesNotMakeUpForLateCalls) {
  std::atomic<int> count = 0;
  TimerThread thread;
  thread.every(10ms, [&] {
    if (count++ == 0) std::this_thread::sleep_for(500ms);
  });
  thread.start(supervisor_, {"timers"});
  while (count < 3) std::this_thread::sleep_for(1ms);
  std::this_thread::sleep_for(30ms);
  EXPECT_LE(count, 10);
}

long pausesOfThisThread() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_nvcsw;
}

// With a real-time priority it would keep all others from running.
TEST_F(TimerThreadTest, RestsBetweenCallsThatAreAlwaysLate) {
  Calls calls(10);
  long before = -1;
  int without_pause = 0;
  TimerThread thread;
  thread.every(100us, [&] {
    const long pauses = pausesOfThisThread();
    without_pause += pauses == before ? 1 : 0;
    before = pauses;
    for (const auto begin = SteadyClock::now(); SteadyClock::now() - begin < 1ms;) {
    }
    calls.count();
  });
  thread.start(supervisor_, {"timers"});
  calls.await();
  thread.stop();
  EXPECT_LT(without_pause, 5);  // a rest is over at once where others run meanwhile
}

TEST_F(TimerThreadTest, PreparesItselfBeforeTheFirstCallAndGoesOnIfThatFails) {
  std::atomic<bool> prepared = false;
  std::promise<bool> called;
  TimerThread thread;
  thread.every(1ms, [&, first = true]() mutable {
    if (std::exchange(first, false)) called.set_value(prepared);
  });
  thread.start(supervisor_, {"timers"}, [&] {
    prepared = true;
    throw std::bad_alloc();
  });
  EXPECT_TRUE(called.get_future().get());
}

TEST_F(TimerThreadTest, ANewPeriodCountsFromTheNextCallOn) {
  Calls calls(12);
  TimerThread thread;
  TimerThread::Timer& timer = thread.every(100ms, [&] { calls.count(); });
  thread.every(10ms, [&] { timer.setPeriod(10ms); });
  const auto begin = SteadyClock::now();
  thread.start(supervisor_, {"timers"});
  calls.await();
  EXPECT_LE(SteadyClock::now() - begin, 1s);
}

TEST_F(TimerThreadTest, StoppingWaitsForTheRunningCallAndCallsNoMore) {
  std::promise<void> running;
  std::atomic<int> count = 0;
  TimerThread thread;
  thread.every(1ms, [&] {
    if (count == 0) running.set_value();
    std::this_thread::sleep_for(50ms);
    ++count;
  });
  thread.start(supervisor_, {"timers"});
  running.get_future().wait();
  thread.stop();
  const int then = count;
  EXPECT_GE(then, 1);
  std::this_thread::sleep_for(20ms);
  EXPECT_EQ(count, then);
}

}  // namespace
}  // namespace sweep_guard_ros
