#include "ros/process.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

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

}  // namespace
}  // namespace sweep_guard_ros
