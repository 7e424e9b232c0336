#include "geometry/appendages.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>

namespace sweep_guard_core {
namespace {

double area(const WeldedSurface& surface, std::uint32_t triangle) {
  const auto& [a, b, c] = surface.triangles[triangle];
  return 0.5 * (surface.at(b) - surface.at(a)).cross(surface.at(c) - surface.at(a)).norm();
}

std::vector<double> areasOf(const WeldedSurface& surface, const Patches& patches) {
  std::vector<double> areas(patches.count());
  for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
    if (!surface.left_out[i]) areas[patches.of(i)] += area(surface, i);
  }
  return areas;
}

template <typename Function>
void forEachOddAt(const EdgeGroups::Group& group, const Patches& patches, const Function& function) {
  forEachPatchAt(group, patches, [&](std::uint32_t patch, int, std::ptrdiff_t count) {
    if (count % 2 != 0) function(patch);
  });
}

bool isBranch(const EdgeGroups::Group& group) { return group.size() > 2 && group.size() % 2 != 0; }

// Returns of each patch whether it has an odd number of triangles at an edge where the number of all is odd and above 2, and
// at no edge where it is even.
std::vector<bool> hangingPatches(const Patches& patches) {
  std::vector<bool> hang(patches.count());
  std::vector<bool> stay(patches.count());
  for (const EdgeGroups::Group& group : patches.irregular()) {
    std::vector<bool>& patches_there = group.size() % 2 == 0 ? stay : hang;
    if (group.size() > 1) forEachOddAt(group, patches, [&](std::uint32_t patch) { patches_there[patch] = true; });
  }
  for (size_t i = 0; i < hang.size(); ++i) hang[i] = hang[i] && !stay[i];
  return hang;
}

// Returns of each patch whether it may be left out without a new border: of several at an edge the smallest one.
std::vector<bool> appendages(const WeldedSurface& surface, const Patches& patches) {
  const std::vector<double> areas = areasOf(surface, patches);
  const std::vector<bool> hang = hangingPatches(patches);
  std::vector<bool> found = hang;
  for (const EdgeGroups::Group& group : patches.irregular()) {
    if (!isBranch(group)) continue;
    std::optional<std::uint32_t> smallest;
    forEachOddAt(group, patches, [&](std::uint32_t patch) {
      if (hang[patch] && (!smallest || areas[patch] < areas[*smallest])) smallest = patch;
    });
    forEachOddAt(group, patches, [&](std::uint32_t patch) { found[patch] = found[patch] && patch == smallest; });
  }
  return found;
}

}  // namespace

bool leaveOutAppendages(WeldedSurface& surface, const Patches& patches) {
  if (std::none_of(patches.irregular().begin(), patches.irregular().end(), isBranch)) return false;
  const std::vector<bool> gone = appendages(surface, patches);
  bool any = false;
  for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
    if (surface.left_out[i] || !gone[patches.of(i)]) continue;
    surface.left_out[i] = true;
    any = true;
  }
  return any;
}

}  // namespace sweep_guard_core
