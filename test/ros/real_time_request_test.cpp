#include "ros/threads/real_time_request.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <thread>

#include "refusal.h"

namespace sweep_guard_ros {
namespace {

constexpr uid_t kNobody = 65534;

// For this process from now on, also if it is root's.
void refuseRealTime() {
  const rlimit none{};
  if (setrlimit(RLIMIT_RTPRIO, &none) != 0) std::exit(3);
  if (geteuid() == 0 && setuid(kNobody) != 0) std::exit(4);
}

TEST(RealTimeRequestDeathTest, ARefusalIsSaidWithWhatToDoAndTheThreadGoesOn) {
  const auto goes_on = [] {
    refuseRealTime();
    RealTimeRequest request(50, "realtime_priority");
    request.make();
    if (request.refusal().empty()) std::exit(5);
    std::exit(sched_getscheduler(0) == SCHED_OTHER ? 0 : 1);
  };
  EXPECT_EXIT(goes_on(), testing::ExitedWithCode(0), "'USER - rtprio 50'.*or set realtime_priority to 0");
}

TEST(RealTimeRequestTest, ZeroAsksForNothing) {
  std::thread([] {
    RealTimeRequest request(0, "realtime_priority");
    request.make();
    EXPECT_EQ(request.refusal(), "");
    EXPECT_EQ(sched_getscheduler(0), SCHED_OTHER);
  }).join();
}

}  // namespace
}  // namespace sweep_guard_ros
