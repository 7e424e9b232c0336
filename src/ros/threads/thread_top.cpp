#include "ros/threads/thread_top.h"

#include <pthread.h>

#include "ros/threads/supervisor.h"

namespace sweep_guard_ros {

void ThreadTop::enter() {
  pthread_setname_np(pthread_self(), traits_.name);
  thread_.emplace();
}

void ThreadTop::failed(const char* what) noexcept { supervisor_.failed(traits_, what); }

}  // namespace sweep_guard_ros
