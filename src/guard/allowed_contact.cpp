#include "sweep_guard/guard/allowed_contact.h"

#include <algorithm>

namespace sweep_guard_core {

std::string describe(const AllowedPair& pair) {
  const std::string link = pair.link == AllowedPair::kAny ? "any link" : "link '" + pair.link + "'";
  return link + " with " + (pair.mesh_id == AllowedPair::kAny ? "any workpiece" : "'" + pair.mesh_id + "'");
}

AllowedMatches::AllowedMatches(const AllowedPairs& pairs) : pairs_(pairs) {
  for (const AllowedPair& pair : pairs) matched_.push_back(pair.mesh_id == AllowedPair::kAny);
}

void AllowedMatches::follow(const Workpieces& newest) {
  const Lock lock(mutex_);
  for (size_t i = 0; i < pairs_.size(); ++i) {
    const auto concerned = [&](const auto& workpiece) { return pairs_[i].concerns(workpiece->id); };
    matched_[i] = matched_[i] || std::any_of(newest.begin(), newest.end(), concerned);
  }
}

std::vector<bool> AllowedMatches::matched() const {
  const Lock lock(mutex_);
  return matched_;
}

}  // namespace sweep_guard_core
