#include "sweep_guard/common/mutex.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

namespace sweep_guard_core {
namespace {

using namespace std::chrono_literals;

bool setPriority(int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters) == 0;
}

void stayOnOneProcessor() {
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(static_cast<size_t>(sched_getcpu()), &one);
  pthread_setaffinity_np(pthread_self(), sizeof one, &one);
}

void burnFor(std::chrono::milliseconds time) {
  for (const auto end = std::chrono::steady_clock::now() + time; std::chrono::steady_clock::now() < end;) continue;
}

// A thread of low priority holds the mutex for 10 ms of processor time, while one of middle priority takes the processor
// for 400 ms. The three share a processor.
// @returns how long a thread of high priority waits for the mutex
template <typename AnyMutex>
std::chrono::milliseconds waitOfHighPriority() {
  AnyMutex mutex;
  std::atomic<bool> held = false;
  std::chrono::milliseconds waited{};
  std::thread([&] {
    stayOnOneProcessor();
    setPriority(20);
    std::thread low([&] {
      setPriority(5);
      const std::lock_guard lock(mutex);
      held = true;
      burnFor(10ms);
    });
    while (!held) std::this_thread::sleep_for(100us);
    std::thread middle([] {
      setPriority(10);
      burnFor(400ms);
    });
    const auto begin = std::chrono::steady_clock::now();
    const std::lock_guard lock(mutex);
    waited = std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - begin);
    low.join();
    middle.join();
  }).join();
  return waited;
}

TEST(MutexTest, AThreadOfMiddlePriorityDelaysNoWaitOfHighPriority) {
  bool granted = false;
  std::thread([&] { granted = setPriority(20); }).join();
  if (!granted)
    GTEST_SKIP() << "real-time priorities are refused: run it as root, or with a limit of rtprio of 20 or more";
  EXPECT_LT(waitOfHighPriority<Mutex>(), 200ms);
  EXPECT_GE(waitOfHighPriority<std::mutex>(), 200ms) << "there is nothing to avoid: the test proves nothing";
}

TEST(MutexTest, IsHeldByOneThread) {
  Mutex mutex;
  const Lock lock(mutex);
  std::thread([&] { EXPECT_FALSE(mutex.tryLock()); }).join();
}

}  // namespace
}  // namespace sweep_guard_core
