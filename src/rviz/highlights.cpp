#include "rviz/highlights.h"

#include <algorithm>
#include <iterator>

namespace sweep_guard_rviz {
namespace {

using Triangles = std::vector<std::uint32_t>;

Triangles without(const Triangles& all, const Triangles& others) {
  Triangles left;
  std::set_difference(all.begin(), all.end(), others.begin(), others.end(), std::back_inserter(left));
  return left;
}

Triangles below(Triangles all, size_t count) {
  std::sort(all.begin(), all.end());
  const auto end = std::find_if(all.begin(), all.end(), [&](std::uint32_t triangle) { return triangle >= count; });
  all.erase(end, all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace

Highlights highlightsOf(const sweep_guard::ObjectView& view, const Triangles& intended, size_t triangles) {
  Highlights shown;
  shown.touched = below(view.touched, triangles);
  shown.reflex = without(below(view.reflex, triangles), shown.touched);
  shown.considered = without(without(below(view.considered, triangles), shown.touched), shown.reflex);
  shown.allowed = below(view.allowed, triangles);
  shown.intended = below(intended, triangles);
  for (const Triangles* const urgent : {&shown.touched, &shown.reflex, &shown.considered}) {
    shown.allowed = without(shown.allowed, *urgent);
    shown.intended = without(shown.intended, *urgent);
  }
  shown.intended = without(shown.intended, shown.allowed);
  return shown;
}

}  // namespace sweep_guard_rviz
