#pragma once

#include <pthread.h>

namespace sweep_guard_core {

/// A mutex whose owner inherits the priority of the threads that wait for it: for what a real-time thread shares with
/// others. Used with std::lock_guard and std::unique_lock. Not recursive. Never throws, and ignores errors of pthread.
class PriorityMutex {
 public:
  PriorityMutex() {
    pthread_mutexattr_t attributes;
    pthread_mutexattr_init(&attributes);
    pthread_mutexattr_setprotocol(&attributes, PTHREAD_PRIO_INHERIT);
    pthread_mutex_init(&mutex_, &attributes);
    pthread_mutexattr_destroy(&attributes);
  }
  ~PriorityMutex() { pthread_mutex_destroy(&mutex_); }
  PriorityMutex(const PriorityMutex&) = delete;
  PriorityMutex& operator=(const PriorityMutex&) = delete;

  void lock() { pthread_mutex_lock(&mutex_); }
  // NOLINTNEXTLINE(readability-identifier-naming): the name that std::unique_lock calls
  bool try_lock() { return pthread_mutex_trylock(&mutex_) == 0; }
  void unlock() { pthread_mutex_unlock(&mutex_); }

 private:
  pthread_mutex_t mutex_;
};

}  // namespace sweep_guard_core
