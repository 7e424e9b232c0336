#include "ros/threads/thread_top.h"

#include <pthread.h>

#include "ros/threads/supervisor.h"

namespace sweep_guard_ros {

void ThreadTop::enter() {
  pthread_setname_np(pthread_self(), traits_.name);
  thread_.emplace();
}

void ThreadTop::caught() noexcept {
  try {
    throw;
  } catch (const std::exception& error) {
    failed(error.what());
  } catch (const PassesRoscpp& error) {
    failed(error.what);
  } catch (...) {
    failed("unknown exception");
  }
}

void ThreadTop::failed(const char* what) noexcept { supervisor_.failed(traits_, what); }

}  // namespace sweep_guard_ros
