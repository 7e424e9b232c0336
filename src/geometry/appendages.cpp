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

// Finds the patches that may be left out without a new border: those with triangles at an edge where the number of all is
// odd and above 2, and that everywhere. Of several at such an edge the smallest one is left out.
class Appendages {
 public:
  Appendages(const WeldedSurface& surface, const Patches& patches)
      : patches_(patches), areas_(patches.count()), hang_(patches.count()), stay_(patches.count()) {
    for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
      if (!surface.left_out[i]) areas_[patches.of(i)] += area(surface, i);
    }
    for (const EdgeGroups::Group& group : patches.irregular()) {
      std::vector<bool>& patches_there = group.size() % 2 == 0 ? stay_ : hang_;
      if (group.size() > 1) forEachOddAt(group, [&](std::uint32_t patch) { patches_there[patch] = true; });
    }
    for (const EdgeGroups::Group& group : patches.irregular()) {
      if (group.size() % 2 != 0 && group.size() > 1) keepAllButSmallest(group);
    }
  }

  bool contains(std::uint32_t patch) const { return mayGo(patch) && !waits_[patch]; }

 private:
  bool mayGo(std::uint32_t patch) const { return hang_[patch] && !stay_[patch]; }

  template <typename Function>
  void forEachOddAt(const EdgeGroups::Group& group, const Function& function) const {
    forEachPatchAt(group, patches_, [&](std::uint32_t patch, int, std::ptrdiff_t count) {
      if (count % 2 != 0) function(patch);
    });
  }

  void keepAllButSmallest(const EdgeGroups::Group& group) {
    std::optional<std::uint32_t> smallest;
    forEachOddAt(group, [&](std::uint32_t patch) {
      if (mayGo(patch) && (!smallest || areas_[patch] < areas_[*smallest])) smallest = patch;
    });
    forEachOddAt(group, [&](std::uint32_t patch) {
      if (patch != smallest) waits_[patch] = true;
    });
  }

  const Patches& patches_;
  std::vector<double> areas_;
  std::vector<bool> hang_;
  std::vector<bool> stay_;
  std::vector<bool> waits_ = std::vector<bool>(patches_.count());
};

}  // namespace

bool leaveOutAppendages(WeldedSurface& surface, const Patches& patches) {
  const auto hangs = [](const EdgeGroups::Group& group) { return group.size() > 2 && group.size() % 2 != 0; };
  if (std::none_of(patches.irregular().begin(), patches.irregular().end(), hangs)) return false;
  const Appendages appendages(surface, patches);
  bool any = false;
  for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
    if (surface.left_out[i] || !appendages.contains(patches.of(i))) continue;
    surface.left_out[i] = true;
    any = true;
  }
  return any;
}

}  // namespace sweep_guard_core
