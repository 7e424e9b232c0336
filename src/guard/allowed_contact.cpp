#include "sweep_guard/guard/allowed_contact.h"

#include <algorithm>

namespace sweep_guard_core {

std::string describe(const AllowedPair& pair) {
  const std::string link = pair.link == AllowedPair::kAny ? "any link" : "link '" + pair.link + "'";
  return link + " with " + (pair.mesh_id == AllowedPair::kAny ? "any workpiece" : "'" + pair.mesh_id + "'");
}

AllowedMatches::AllowedMatches(const AllowedPairs& pairs) {
  for (const AllowedPair& pair : pairs) matches_.push_back({pair, pair.mesh_id == AllowedPair::kAny});
}

void AllowedMatches::follow(const Workpieces& newest) {
  const Lock lock(mutex_);
  for (Match& match : matches_) {
    match.has_matched = match.has_matched || std::any_of(newest.begin(), newest.end(), [&](const auto& workpiece) {
                          return match.pair.concerns(workpiece->id);
                        });
  }
}

std::vector<AllowedMatches::Match> AllowedMatches::matches() const {
  const Lock lock(mutex_);
  return matches_;
}

}  // namespace sweep_guard_core
