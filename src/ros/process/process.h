#pragma once

#include <cstddef>
#include <string>

#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// Gives the calling thread a real-time priority (SCHED_FIFO).
/// @param priority   1 to 99
/// @param parameter  that it was set by
/// @returns the reason of a refusal, and what to set; empty if granted
std::string requestRealTime(int priority, const std::string& parameter);

/// Ends the process by SIGXCPU once a thread with a real-time priority has taken this much processor time without a pause: it
/// would keep others from running. For programs whose process is their own.
void limitRealTime(sweep_guard_core::Duration longest);

/// Lets the calling thread run sooner after it wakes up, without any privilege: its timers have no slack, and its time slice
/// is the shortest there is. From Linux 6.12 on it preempts threads whose slices are longer; before, slices are all alike.
void setPrompt();

/// Lets the logs of the process show all characters: without a locale, log4cxx takes text for ASCII. Before the first log.
void logInUtf8();

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

/// Keeps what is freed, up to 32 MiB, for the next message: to take memory from the system anew lasts longer than to read a
/// large message. Before the first thread.
void keepFreedMemory();

/// Limits the address space of the process; what does not fit throws std::bad_alloc. Does nothing in builds with a
/// sanitizer, which reserves terabytes.
/// @param max_memory  [MiB]; 0: no limit
/// @throws sweep_guard_core::InvalidInput if the process takes nearly as much already
void limitMemory(size_t max_memory);

}  // namespace sweep_guard_ros
