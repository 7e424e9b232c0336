#include "geometry/surface_parts.h"

#include <algorithm>
#include <numeric>
#include <optional>

namespace sweep_guard_core {

SurfaceParts::SurfaceParts(const WeldedSurface& surface, const Patches& patches)
    : patches_(patches), flipped_(patches.count()), parents_(patches.count()), parts_(patches.count()) {
  std::vector<std::int64_t> majority(patches.count());
  for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
    if (!surface.left_out[i]) majority[patches.of(i)] += patches.turned(i) ? -1 : 1;
  }
  std::transform(majority.begin(), majority.end(), flipped_.begin(), [](std::int64_t sum) { return sum < 0; });
  std::iota(parents_.begin(), parents_.end(), 0U);
  for (const EdgeGroups::Group& group : patches.irregular()) uniteBordersAt(group);
  for (std::uint32_t i = 0; i < parents_.size(); ++i) parts_[i] = parents_[i] == i ? count_++ : parts_[root(i)];
}

std::uint32_t SurfaceParts::root(std::uint32_t patch) {
  while (parents_[patch] != patch) patch = parents_[patch] = parents_[parents_[patch]];
  return patch;
}

void SurfaceParts::uniteBordersAt(const EdgeGroups::Group& group) {
  std::optional<std::uint32_t> first;
  forEachPatchAt(group, patches_, [&](std::uint32_t patch, int sum, std::ptrdiff_t) {
    if (sum == 0) return;
    const std::uint32_t one = root(patch);
    const std::uint32_t other = first ? root(*first) : one;
    parents_[std::max(one, other)] = std::min(one, other);
    first = std::min(one, other);
  });
}

std::vector<Border> bordersOf(const SurfaceParts& parts) {
  std::vector<Border> borders;
  for (const EdgeGroups::Group& group : parts.irregular()) {
    forEachPatchAt(group, parts, [&](std::uint32_t part, int sum, std::ptrdiff_t) {
      const std::uint32_t high = group.first->high;
      for (int i = 0; i < sum; ++i) borders.push_back({part, group.low, high, i > 0});
      for (int i = 0; i < -sum; ++i) borders.push_back({part, high, group.low, i > 0});
    });
  }
  std::stable_sort(borders.begin(), borders.end(), [](const Border& a, const Border& b) { return a.part < b.part; });
  return borders;
}

std::vector<Shell> shellsOf(const WeldedSurface& surface, const SurfaceParts& parts,
                            const std::vector<Border>& borders) {
  std::vector<Shell> shells(parts.count());
  for (const Border& border : borders) shells[border.part].closed = false;
  for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
    if (surface.left_out[i]) continue;
    Shell& shell = shells[parts.of(i)];
    const auto& [a, b, c] = surface.triangles[i];
    const double six_volumes = surface.at(a).dot(surface.at(b).cross(surface.at(c)));
    shell.six_volumes += parts.turned(i) ? -six_volumes : six_volumes;
    shell.turned += parts.turned(i) ? 1 : 0;
    shell.both_ways = shell.both_ways || surface.both_ways[i];
    ++shell.count;
    for (const std::uint32_t corner : surface.triangles[i]) shell.box.extend(surface.at(corner));
  }
  return shells;
}

}  // namespace sweep_guard_core
