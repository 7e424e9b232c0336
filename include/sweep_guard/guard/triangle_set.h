#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sweep_guard_core {

/// Indices of triangles: ascending, each once.
using TriangleSet = std::vector<std::uint32_t>;

/// Adds ascending values, each once, to others; in place.
/// @param below  their order
template <typename Value, typename Below>
void unite(std::vector<Value>& all, const std::vector<Value>& more, const Below& below) {
  size_t left = all.size();
  size_t added = more.size();
  size_t place = left + added;
  if (added == 0) return;
  all.resize(place, more.front());
  while (added > 0) {  // from behind, so that nothing is overwritten that is still to be read
    const bool old_one = left > 0 && !below(all[left - 1], more[added - 1]);
    if (old_one && !below(more[added - 1], all[left - 1])) --added;  // known already
    --place;
    all[place] = old_one ? all[--left] : more[--added];
  }
  all.erase(all.begin() + static_cast<std::ptrdiff_t>(left), all.begin() + static_cast<std::ptrdiff_t>(place));
}

/// Adds `more` to `all`, in place.
void unite(TriangleSet& all, const TriangleSet& more);
/// Takes `others` out of `all`, in place.
void remove(TriangleSet& all, const TriangleSet& others);
/// Takes all but `others` out of `all`, in place.
void keepOnly(TriangleSet& all, const TriangleSet& others);

}  // namespace sweep_guard_core
