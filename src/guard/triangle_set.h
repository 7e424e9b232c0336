#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
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

/// Adds `more` to `all`, in place.
inline void unite(TriangleSet& all, const TriangleSet& more) { unite(all, more, std::less<>()); }

/// Removes `others` from `all`, in place.
inline void remove(TriangleSet& all, const TriangleSet& others) {
  const auto is_other = [&](std::uint32_t one) { return std::binary_search(others.begin(), others.end(), one); };
  if (!others.empty()) all.erase(std::remove_if(all.begin(), all.end(), is_other), all.end());
}

/// Removes all but `others` from `all`, in place.
inline void keepOnly(TriangleSet& all, const TriangleSet& others) {
  const auto is_none = [&](std::uint32_t one) { return !std::binary_search(others.begin(), others.end(), one); };
  all.erase(std::remove_if(all.begin(), all.end(), is_none), all.end());
}

}  // namespace sweep_guard_core
