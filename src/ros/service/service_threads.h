#pragma once

#include "ros/threads/queue_thread.h"

namespace sweep_guard_ros {

/// The threads of all services of a node. roscpp answers a call in the thread that runs its callback, which the call
/// blocks; the thread that reads the requests only counts them and puts them into a queue (LimitedCalls). So calls of
/// bounded time and calls that compute have a thread each, and a third one does nothing but answer BUSY: with fewer, an
/// answer would wait for a path test. None of the three waits for another one, so they cannot come to a deadlock.
struct ServiceThreads {
  QueueThread brief;    ///< sets something: waits up to 0.5 s until the guard begins, or up to 0.1 s for each transform
  QueueThread lasting;  ///< tests paths, cuts meshes, makes a tool or a detector, writes parameters
  QueueThread refusals;  ///< answers BUSY

  /// Starts the threads; the supervisor must outlive them.
  void start(Supervisor& supervisor) {
    brief.start(supervisor, {"calls", sweep_guard_core::Stage::kOther, /*watched=*/false});
    lasting.start(supervisor, {"long calls", sweep_guard_core::Stage::kOther, /*watched=*/false});
    refusals.start(supervisor, {"busy", sweep_guard_core::Stage::kOther, /*watched=*/false});
  }
  /// Waits for the running calls, and runs no more: before the services are destroyed, or what their calls use.
  void stop() {
    brief.stop();
    lasting.stop();
    refusals.stop();
  }
};

}  // namespace sweep_guard_ros
