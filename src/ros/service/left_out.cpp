#include "ros/service/left_out.h"

#include <algorithm>

namespace sweep_guard_ros {

std::string describeLeftOut(const sweep_guard_core::AllowedPairs& pairs,
                            const sweep_guard_core::Workpieces& workpieces) {
  std::string left_out;
  for (const sweep_guard_core::AllowedPair& pair : pairs) {
    const auto concerned = [&](const auto& workpiece) { return pair.concerns(workpiece->id); };
    if (std::none_of(workpieces.begin(), workpieces.end(), concerned)) continue;
    left_out += (left_out.empty() ? "tool/allowed leaves out contact of " : ", ") + describe(pair);
  }
  return left_out;
}

}  // namespace sweep_guard_ros
