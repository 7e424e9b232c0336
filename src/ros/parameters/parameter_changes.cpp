#include "ros/parameters/parameter_changes.h"

#include <algorithm>

namespace sweep_guard_ros {

std::vector<ParameterChange> differences(const Parameters& before, const Parameters& after) {
  std::vector<ParameterChange> changes;
  for (size_t i = 0; i < after.described.size(); ++i) {
    const ParameterInfo& was = before.described[i];
    const ParameterInfo& is = after.described[i];
    if (was.value != is.value) changes.push_back({is.key, was.value, is.value});
  }
  return changes;
}

bool differ(const Parameters& before, const Parameters& after, const std::string& beginning) {
  const std::vector<ParameterChange> changes = differences(before, after);
  return std::any_of(changes.begin(), changes.end(), [&](const ParameterChange& change) {
    return change.key.compare(0, beginning.size(), beginning) == 0;
  });
}

bool detectorsDiffer(const Parameters& before, const Parameters& after) {
  return differ(before, after, "detector") || differ(before, after, "cull");
}

}  // namespace sweep_guard_ros
