#pragma once

#include <pthread.h>

#include <mutex>

// Clang checks with -Wthread-safety that what a mutex guards is used with it only; others ignore it. See
// clang.llvm.org/docs/ThreadSafetyAnalysis.html.
#ifdef __clang__
#define SWEEP_GUARD_ATTRIBUTE(x) __attribute__((x))
#else
#define SWEEP_GUARD_ATTRIBUTE(x)
#endif
#define SWEEP_GUARD_CAPABILITY(x) SWEEP_GUARD_ATTRIBUTE(capability(x))
#define SWEEP_GUARD_SCOPED_CAPABILITY SWEEP_GUARD_ATTRIBUTE(scoped_lockable)
#define SWEEP_GUARD_GUARDED_BY(x) SWEEP_GUARD_ATTRIBUTE(guarded_by(x))
#define SWEEP_GUARD_PT_GUARDED_BY(x) SWEEP_GUARD_ATTRIBUTE(pt_guarded_by(x))
#define SWEEP_GUARD_REQUIRES(...) SWEEP_GUARD_ATTRIBUTE(requires_capability(__VA_ARGS__))
#define SWEEP_GUARD_ACQUIRE(...) SWEEP_GUARD_ATTRIBUTE(acquire_capability(__VA_ARGS__))
#define SWEEP_GUARD_TRY_ACQUIRE(...) SWEEP_GUARD_ATTRIBUTE(try_acquire_capability(__VA_ARGS__))
#define SWEEP_GUARD_RELEASE(...) SWEEP_GUARD_ATTRIBUTE(release_capability(__VA_ARGS__))

namespace sweep_guard_core {

/// A mutex whose owner inherits the priority of the threads that wait for it: a real-time thread shares it with others.
/// Not recursive. Never throws, and ignores errors of pthread.
class SWEEP_GUARD_CAPABILITY("mutex") Mutex {
 public:
  Mutex() {
    pthread_mutexattr_t attributes;
    pthread_mutexattr_init(&attributes);
    pthread_mutexattr_setprotocol(&attributes, PTHREAD_PRIO_INHERIT);
    pthread_mutex_init(&mutex_, &attributes);
    pthread_mutexattr_destroy(&attributes);
  }
  ~Mutex() { pthread_mutex_destroy(&mutex_); }
  Mutex(const Mutex&) = delete;
  Mutex& operator=(const Mutex&) = delete;

  void lock() SWEEP_GUARD_ACQUIRE() { pthread_mutex_lock(&mutex_); }
  bool tryLock() SWEEP_GUARD_TRY_ACQUIRE(true) { return pthread_mutex_trylock(&mutex_) == 0; }
  void unlock() SWEEP_GUARD_RELEASE() { pthread_mutex_unlock(&mutex_); }

 private:
  pthread_mutex_t mutex_;
};

/// Holds a mutex during its lifetime, but between unlock() and lock(), as in std::condition_variable_any::wait().
class SWEEP_GUARD_SCOPED_CAPABILITY Lock {
 public:
  explicit Lock(Mutex& mutex) SWEEP_GUARD_ACQUIRE(mutex) : mutex_(mutex) { mutex.lock(); }
  Lock(Mutex& mutex, std::adopt_lock_t) SWEEP_GUARD_REQUIRES(mutex) : mutex_(mutex) {}  ///< of a mutex that is held
  ~Lock() SWEEP_GUARD_RELEASE() {
    if (held_) mutex_.unlock();
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

  void lock() SWEEP_GUARD_ACQUIRE() {
    mutex_.lock();
    held_ = true;
  }
  void unlock() SWEEP_GUARD_RELEASE() {
    held_ = false;
    mutex_.unlock();
  }

 private:
  Mutex& mutex_;
  bool held_ = true;
};

}  // namespace sweep_guard_core
