#pragma once

#include <cstddef>
#include <vector>

#include "sweep_guard/detection/detector.h"

namespace sweep_guard_core {

/// Adds ascending values, each once, to such values, in place.
/// @param below  order of both
template <typename Value, typename Below>
void unite(std::vector<Value>& all, const std::vector<Value>& more, const Below& below) {
  size_t left = all.size();
  size_t added = more.size();
  size_t place = left + added;
  if (added == 0) return;
  all.resize(place, more.front());
  while (added > 0) {  // from the back, so that no value is overwritten before it is read
    const bool from_all = left > 0 && !below(all[left - 1], more[added - 1]);
    if (from_all && !below(more[added - 1], all[left - 1])) --added;  // in both
    --place;
    all[place] = from_all ? all[--left] : more[--added];
  }
  all.erase(all.begin() + static_cast<std::ptrdiff_t>(left), all.begin() + static_cast<std::ptrdiff_t>(place));
}

void unite(TriangleSet& all, const TriangleSet& more);       ///< adds `more` to `all`, in place
void remove(TriangleSet& all, const TriangleSet& others);    ///< removes `others` from `all`, in place
void keepOnly(TriangleSet& all, const TriangleSet& others);  ///< removes all but `others` from `all`, in place

}  // namespace sweep_guard_core
