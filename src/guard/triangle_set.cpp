#include "guard/triangle_set.h"

#include <algorithm>
#include <functional>

namespace sweep_guard_core {

void unite(TriangleSet& all, const TriangleSet& more) { unite(all, more, std::less<>()); }

void remove(TriangleSet& all, const TriangleSet& others) {
  const auto is_other = [&](std::uint32_t one) { return std::binary_search(others.begin(), others.end(), one); };
  if (!others.empty()) all.erase(std::remove_if(all.begin(), all.end(), is_other), all.end());
}

void keepOnly(TriangleSet& all, const TriangleSet& others) {
  const auto is_none = [&](std::uint32_t one) { return !std::binary_search(others.begin(), others.end(), one); };
  all.erase(std::remove_if(all.begin(), all.end(), is_none), all.end());
}

}  // namespace sweep_guard_core
