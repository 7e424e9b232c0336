#pragma once

#include <sys/types.h>

#include <ctime>

#include "ros/threads/stall_timer.h"

namespace sweep_guard_ros {

/// A thread as the kernel sees it. Its state is read without a lock and without memory from the heap.
class KernelThread {
 public:
  KernelThread();  ///< the calling thread
  ThreadState state() const;

 private:
  clockid_t clock_{};
  char stat_file_[64];
};

}  // namespace sweep_guard_ros
