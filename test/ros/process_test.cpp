#include "ros/process.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>

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
    asked.refusal = requestRealTime(priority);
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

}  // namespace
}  // namespace sweep_guard_ros
