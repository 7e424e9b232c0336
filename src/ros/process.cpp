#include "ros/process.h"

#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <system_error>

namespace sweep_guard_ros {

// SCHED_RESET_ON_FORK: threads started by this one do not inherit the priority.
std::string requestRealTime(int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO | SCHED_RESET_ON_FORK, &parameters);
  if (error == 0) return {};
  return "real-time priority " + std::to_string(priority) + " is refused: " + std::generic_category().message(error) +
         ". Allow it with the line 'USER - rtprio " + std::to_string(priority) +
         "' in /etc/security/limits.conf and a new login, or set timing/realtime_priority to 0";
}

void limitMemory(size_t max_memory) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  if (max_memory == 0) return;
  rlimit limit{};
  getrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, rlim_t{max_memory} << 20U);
  setrlimit(RLIMIT_AS, &limit);
#else
  static_cast<void>(max_memory);
#endif
}

}  // namespace sweep_guard_ros
