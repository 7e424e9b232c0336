#include "sweep_guard/guard/triangle_set.h"

#include <algorithm>
#include <iterator>

namespace sweep_guard {

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
