#pragma once

#include <atomic>
#include <cstdint>

namespace sweep_guard_ros {

/// What goes wrong in the memory of a thread.
enum class Fault : int {
  kNone,
  kOneFails,  ///< its next allocation fails
  kAllFail,   ///< all its allocations fail
  kBlocks,    ///< its next allocation waits
  kSpins,     ///< its next allocation takes the processor
};

/// Shared memory of a test and the process that has loaded the library of the faults.
struct Faults {
  std::atomic<Fault> fault;          ///< lasts until it is kNone
  char thread[16];                   ///< name of the thread that has it
  std::atomic<std::int64_t> struck;  ///< steady time when the thread met it first [ns]; 0: not yet
};

constexpr const char* kFaultsName = "/sweep_guard_faults.%d";  ///< of the shared memory of a process

}  // namespace sweep_guard_ros
