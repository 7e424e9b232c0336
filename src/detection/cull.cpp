#include "sweep_guard/detection/cull.h"

#include <cassert>

#include "sweep_guard/detection/box_coordinates.h"

namespace sweep_guard {
namespace {

// One bit for each plane of the volume that the point lies beyond.
std::uint16_t planesBeyond(const Eigen::Vector3d& p_B, const Eigen::Vector3d& half_extents,
                           const std::vector<HalfSpace>& clips_B, double rounding) {
  unsigned bits = 0;
  for (int i = 0; i < 3; ++i) {
    bits |= static_cast<unsigned>(p_B[i] > half_extents[i] + rounding) << (2 * i);
    bits |= static_cast<unsigned>(-p_B[i] > half_extents[i] + rounding) << (2 * i + 1);
  }
  for (size_t i = 0; i < clips_B.size(); ++i) {
    bits |= static_cast<unsigned>(clips_B[i].signedDistance(p_B) > rounding) << (6 + i);
  }
  return static_cast<std::uint16_t>(bits);
}

}  // namespace

const std::vector<std::uint32_t>& Cull::operator()(const TriangleMesh& mesh_M, const SweptVolume& swept_M) {
  const BoxCoordinates coordinates(mesh_M, swept_M.box);
  assert(swept_M.clips_B.size() <= 10);  // 6 + 10 bits
  beyond_.resize(mesh_M.vertexCount());
  for (std::uint32_t i = 0; i < beyond_.size(); ++i) {
    beyond_[i] = planesBeyond(coordinates(i), swept_M.box.half_extents, swept_M.clips_B, 2.0 * coordinates.rounding());
  }

  left_.clear();
  const std::vector<Triangle>& triangles = mesh_M.triangles();
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const auto& [a, b, c] = triangles[i];
    if ((beyond_[a] & beyond_[b] & beyond_[c]) == 0) left_.push_back(i);
  }
  return left_;
}

const std::vector<std::uint32_t>& Cull::operator()(const TriangleMesh& mesh_M, const SweptVolume& swept_M,
                                                   const std::vector<std::uint32_t>& among) {
  assert(&among != &left_ && swept_M.clips_B.size() <= 10);
  const BoxCoordinates coordinates(mesh_M, swept_M.box);
  const auto beyond = [&](std::uint32_t vertex) {
    return planesBeyond(coordinates(vertex), swept_M.box.half_extents, swept_M.clips_B, 2.0 * coordinates.rounding());
  };
  left_.clear();
  for (const std::uint32_t i : among) {
    const auto& [a, b, c] = mesh_M.triangles()[i];
    if ((beyond(a) & beyond(b) & beyond(c)) == 0) left_.push_back(i);
  }
  return left_;
}

}  // namespace sweep_guard
