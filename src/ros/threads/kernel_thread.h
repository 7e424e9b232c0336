#pragma once

#include <sys/types.h>

#include <ctime>

#include "ros/threads/stall_timer.h"

namespace sweep_guard_ros {

/// A thread as the kernel sees it. Its state is read without a lock, memory from the heap, or a new file
/// descriptor.
class KernelThread {
 public:
  KernelThread();  ///< the calling thread
  ~KernelThread();
  KernelThread(const KernelThread&) = delete;
  KernelThread& operator=(const KernelThread&) = delete;

  ThreadState state() const;

 private:
  clockid_t clock_{};
  int stat_file_ = -1;
};

}  // namespace sweep_guard_ros
