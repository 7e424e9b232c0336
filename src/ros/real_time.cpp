#include "ros/real_time.h"

#include <pthread.h>
#include <sched.h>

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

}  // namespace sweep_guard_ros
