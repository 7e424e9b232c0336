#include "ros/process/process.h"

#include <gtest/gtest.h>
#include <malloc.h>
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <thread>

#include "refusal.h"

namespace sweep_guard_ros {
namespace {

struct Asked {
  std::string refusal;
  int policy;
  int priority;
};

// Requests it in a separate thread.
Asked ask(int priority) {
  Asked asked;
  std::thread([&] {
    asked.refusal = requestRealTime(priority, "timing/realtime_priority");
    sched_param parameters{};
    pthread_getschedparam(pthread_self(), &asked.policy, &parameters);
    asked.policy &= ~SCHED_RESET_ON_FORK;
    asked.priority = parameters.sched_priority;
  }).join();
  return asked;
}

TEST(RequestRealTimeTest, IsGrantedOrNamesTheSetting) {
  const Asked asked = ask(10);
  if (asked.refusal.empty()) {
    EXPECT_EQ(asked.policy, SCHED_FIFO);
    EXPECT_EQ(asked.priority, 10);
  } else {
    EXPECT_EQ(asked.policy, SCHED_OTHER);
    EXPECT_TRUE(has(asked.refusal, "rtprio 10"));
    EXPECT_TRUE(has(asked.refusal, "limits.conf"));
  }
}

TEST(RequestRealTimeTest, ARefusalNamesTheReasonAndChangesNothing) {
  const Asked asked = ask(1000);
  EXPECT_TRUE(has(asked.refusal, "real-time priority 1000 is refused"));
  EXPECT_TRUE(has(asked.refusal, "timing/realtime_priority"));
  EXPECT_EQ(asked.policy, SCHED_OTHER);
}

TEST(RequestRealTimeTest, ConcernsOnlyTheCallingThread) {
  ask(10);
  sched_param parameters{};
  int policy = 0;
  pthread_getschedparam(pthread_self(), &policy, &parameters);
  EXPECT_EQ(policy, SCHED_OTHER);
}

// In a process of its own: the limit stays.
TEST(LimitRealTimeDeathTest, LowersTheLimitOfTheKernelAndNeverRaisesIt) {
  const auto limits = [] {
    limitRealTime(std::chrono::milliseconds(20));
    limitRealTime(std::chrono::seconds(1));
    rlimit limit{};
    getrlimit(RLIMIT_RTTIME, &limit);
    std::exit(limit.rlim_cur == 20'000 ? 0 : 1);
  };
  EXPECT_EXIT(limits(), testing::ExitedWithCode(0), "");
}

// In a process of its own: a thread that never rests ends it.
TEST(LimitRealTimeDeathTest, EndsAProcessThatAHungRealTimeThreadWouldHoldUp) {
  const std::string refusal = ask(10).refusal;  // the kernel then ends nothing
  if (!refusal.empty()) GTEST_SKIP() << refusal;
  const auto hang = [] {
    limitRealTime(std::chrono::milliseconds(20));
    requestRealTime(10, "timing/realtime_priority");
    for (volatile int spins = 0;; spins = spins + 1) {
    }
  };
  EXPECT_EXIT(hang(), testing::KilledBySignal(SIGXCPU), "");
}

TEST(SetPromptTest, TakesTheSlackOfTimersFromTheCallingThreadAlone) {
  int slack = 0;
  int policy = -1;
  int nice = 0;
  std::thread([&] {
    setNice(3);
    setPrompt();
    slack = prctl(PR_GET_TIMERSLACK);
    policy = sched_getscheduler(0);
    nice = getpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)));
  }).join();
  EXPECT_EQ(slack, 1);
  EXPECT_EQ(policy, SCHED_OTHER);
  EXPECT_EQ(nice, 3);
  EXPECT_GT(prctl(PR_GET_TIMERSLACK), 1);
}

rlim_t addressSpaceLimit() {
  rlimit limit{};
  getrlimit(RLIMIT_AS, &limit);
  return limit.rlim_cur;
}

// In a process of its own: the limit stays.
TEST(LimitMemoryDeathTest, WhatDoesNotFitThrows) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  const auto reserve = [] {
    constexpr size_t kMaxMemory = 1024;
    limitMemory(kMaxMemory);
    if (addressSpaceLimit() != kMaxMemory << 20U) std::exit(1);
    try {
      const std::vector<char> large(kMaxMemory << 20U);
      static const char* volatile used;  // else GCC 10 leaves the memory out
      used = large.data();
      std::exit(used == nullptr ? 2 : 3);
    } catch (const std::bad_alloc&) {
      std::exit(0);
    }
  };
  EXPECT_EXIT(reserve(), testing::ExitedWithCode(0), "");
#endif
}

TEST(LimitMemoryTest, ZeroLimitsNothing) {
  const rlim_t before = addressSpaceLimit();
  limitMemory(0);
  EXPECT_EQ(addressSpaceLimit(), before);
}

// Returns the number of heaps that malloc has made for eight threads at once.
[[maybe_unused]] int heapsOfEightThreads() {
  std::array<std::thread, 8> threads;
  std::array<std::unique_ptr<int>, 8> made;
  std::atomic<std::size_t> ready{0};
  for (std::size_t i = 0; i < threads.size(); ++i) {
    threads[i] = std::thread([&, i] {
      made[i] = std::make_unique<int>(1);
      for (++ready; ready < threads.size();) std::this_thread::yield();
    });
  }
  for (std::thread& thread : threads) thread.join();
  char* text = nullptr;
  std::size_t size = 0;
  FILE* const stream = open_memstream(&text, &size);
  malloc_info(0, stream);
  fclose(stream);
  int heaps = 0;
  for (const char* at = strstr(text, "<heap "); at != nullptr; at = strstr(at + 1, "<heap ")) ++heaps;
  free(text);
  return heaps;
}

// Sanitizers have a malloc of their own.
TEST(ShareHeapsTest, ThreadsShareTwoHeaps) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  testing::FLAGS_gtest_death_test_style = "threadsafe";  // a process in which no thread has run
  const auto shared = [] {
    shareHeaps();
    _exit(heapsOfEightThreads());
  };
  EXPECT_EXIT(shared(), testing::ExitedWithCode(2), "");
  const auto separate = [] { _exit(heapsOfEightThreads()); };
  EXPECT_EXIT(
      separate(), [](int status) { return WIFEXITED(status) && WEXITSTATUS(status) > 2; }, "");
#endif
}

}  // namespace
}  // namespace sweep_guard_ros
