#include "sweep_guard/guard/triangle_set.h"

#include <algorithm>
#include <functional>
#include <iterator>

namespace sweep_guard {

void unite(TriangleSet& all, const TriangleSet& more) { unite(all, more, std::less<>()); }

void remove(TriangleSet& all, const TriangleSet& others) {
  const auto is_other = [&](std::uint32_t one) { return std::binary_search(others.begin(), others.end(), one); };
  if (!others.empty()) all.erase(std::remove_if(all.begin(), all.end(), is_other), all.end());
}

void keepOnly(TriangleSet& all, const TriangleSet& others) {
  const auto is_none = [&](std::uint32_t one) { return !std::binary_search(others.begin(), others.end(), one); };
  all.erase(std::remove_if(all.begin(), all.end(), is_none), all.end());
}

TriangleSet united(const TriangleSet& a, const TriangleSet& b) {
  TriangleSet both;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

TriangleSet without(const TriangleSet& all, const TriangleSet& others) {
  TriangleSet rest;
  std::set_difference(all.begin(), all.end(), others.begin(), others.end(), std::back_inserter(rest));
  return rest;
}

}  // namespace sweep_guard
