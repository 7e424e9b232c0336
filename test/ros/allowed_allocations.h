#pragma once

#include <set>
#include <string>
#include <vector>

#include "allocations.h"

namespace sweep_guard_ros {

struct AllowedAllocation {
  std::string frame;   ///< in the call stack
  bool innermost;      ///< as the first frame
  double most;         ///< per cycle
  std::string reason;  ///< why it may
};

/// Expects that the threads allocated what is listed, each at most as often as it may, and nothing else.
/// @param threads  names
/// @param cycles   number of cycles while it was counted
/// @param growth   allocations per cycle of what is not listed: by buffers that meet something larger
void expectAllocations(const sweep_guard_core::AllocationsOfAllThreads& made, const std::set<std::string>& threads,
                       const std::vector<AllowedAllocation>& allowed, double cycles, double growth = 0.05);

}  // namespace sweep_guard_ros
