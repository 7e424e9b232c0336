#include "guard/displacements.h"

#include <algorithm>
#include <limits>

namespace sweep_guard_core {
namespace {

constexpr Eigen::Index kLanes = 24;  // x y z of eight vertices: fills registers of any width
using Lanes = Eigen::Array<float, kLanes, 1>;

// Bounds the differences of coordinates x y z x ... Each is rounded by half a unit in the last of 24 digits.
Eigen::AlignedBox3d boxOfDifferences(const float* from, const float* to, size_t vertices) {
  Eigen::AlignedBox3f box;
  Lanes least = Lanes::Constant(std::numeric_limits<float>::infinity());
  Lanes most = -least;
  size_t i = 0;
  for (; i + kLanes <= 3 * vertices; i += kLanes) {
    const Lanes difference = Eigen::Map<const Lanes>(to + i) - Eigen::Map<const Lanes>(from + i);
    least = least.min(difference);
    most = most.max(difference);
  }
  for (Eigen::Index lane = 0; lane < kLanes && i > 0; lane += 3) {
    box.extend(least.segment<3>(lane).matrix()).extend(most.segment<3>(lane).matrix());
  }
  for (; i < 3 * vertices; i += 3) {
    box.extend(Eigen::Map<const Eigen::Vector3f>(to + i) - Eigen::Map<const Eigen::Vector3f>(from + i));
  }
  const auto rounding = [](const Eigen::Vector3f& corner) -> Eigen::Vector3d {
    return corner.cwiseAbs().cast<double>() * 0x1.001p-24;
  };
  return {box.min().cast<double>() - rounding(box.min()), box.max().cast<double>() + rounding(box.max())};
}

Eigen::AlignedBox3d boxOfEach(const TriangleMesh& from_M, const TriangleMesh& to_M) {
  Eigen::AlignedBox3d box;
  for (size_t i = 0; i < to_M.vertexCount(); ++i) box.extend(to_M.offset(i) - from_M.offset(i));
  return box;
}

}  // namespace

// Meshes that share their triangles keep their vertices in the same order.
Displacements::Displacements(const TriangleMesh& from_M, const TriangleMesh& to_M) {
  const bool same_order = &from_M.triangles() == &to_M.triangles();
  box_M_ = same_order ? boxOfDifferences(from_M.places().data(), to_M.places().data(), to_M.vertexCount())
                      : boxOfEach(from_M, to_M);
  if (from_M.origin() == to_M.origin()) return;
  const Eigen::Vector3d shift_M = to_M.origin() - from_M.origin();
  const Eigen::Vector3d rounding = (to_M.origin().cwiseAbs() + from_M.origin().cwiseAbs()) * 0x1p-50;
  box_M_ = Eigen::AlignedBox3d(box_M_.min() + shift_M - rounding, box_M_.max() + shift_M + rounding);
}

Displacements DisplacementCache::between(const std::shared_ptr<const Workpiece>& from,
                                         const std::shared_ptr<const Workpiece>& to) {
  if (from == to) return {};
  const auto same = [&](const Known& known) { return known.from == from && known.to == to; };
  auto known = std::find_if(known_.begin(), known_.end(), same);
  if (known == known_.end())
    known = known_.insert(known, {from, to, Displacements(from->mesh_M, to->mesh_M), /*used=*/true});
  known->used = true;
  return known->displacements;
}

void DisplacementCache::forgetUnused() {
  known_.erase(std::remove_if(known_.begin(), known_.end(), [](const Known& known) { return !known.used; }),
               known_.end());
  for (Known& known : known_) known.used = false;
}

}  // namespace sweep_guard_core
