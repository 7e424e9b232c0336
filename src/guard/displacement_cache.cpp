#include "guard/displacement_cache.h"

#include <algorithm>

namespace sweep_guard_core {

Displacements DisplacementCache::between(const std::shared_ptr<const Workpiece>& from,
                                         const std::shared_ptr<const Workpiece>& to) {
  if (from == to) return {};
  const auto same = [&](const Known& known) { return known.from == from && known.to == to; };
  auto known = std::find_if(known_.begin(), known_.end(), same);
  if (known == known_.end())
    known = known_.insert(known, {from, to, Displacements(from->mesh_M, to->mesh_M), /*used=*/true});
  known->used = true;
  return known->displacements;
}

void DisplacementCache::forgetUnused() {
  known_.erase(std::remove_if(known_.begin(), known_.end(), [](const Known& known) { return !known.used; }),
               known_.end());
  for (Known& known : known_) known.used = false;
}

}  // namespace sweep_guard_core
