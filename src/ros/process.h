#pragma once

#include <cstddef>
#include <string>

namespace sweep_guard_ros {

/// Gives the calling thread a real-time priority (SCHED_FIFO).
/// @param priority  1 to 99
/// @returns the reason of a refusal, and what to set; empty if granted
std::string requestRealTime(int priority);

/// Lets the XML-RPC server of roscpp, which listens on every interface, answer on the loopback interface alone if
/// ROS_IP or ROS_HOSTNAME is there. Call it when the first node handle exists. Logs a failure.
void keepToLoopback();

/// Lowers the priority of the calling thread and of those that it starts: its share of a busy processor.
/// @param nice  0 (as others) to 19 (runs when nothing else does)
void setNice(int nice);

/// Lets the calling thread run when nothing else does (SCHED_IDLE): any thread that wakes up takes its processor at
/// once. It stays so; it should hold no lock that others wait for.
void setIdle();

/// Lets all threads share two heaps, where each would keep as much free memory as its largest burst of messages took.
/// Before the first thread.
void shareHeaps();

/// Limits the address space of the process; what does not fit throws std::bad_alloc. Does nothing in builds with a
/// sanitizer, which reserves terabytes.
/// @param max_memory  [MiB]; 0: no limit
/// @throws sweep_guard_core::InvalidInput if the process takes nearly as much already
void limitMemory(size_t max_memory);

}  // namespace sweep_guard_ros
