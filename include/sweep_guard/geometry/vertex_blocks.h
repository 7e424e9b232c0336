#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_core {

/// Boxes along the axes around every simd::kBlock consecutive vertices of a mesh (a block), in the frame of the
/// positions, computed in one pass over them. Sweeps test these boxes first.
class VertexBlocks {
 public:
  /// Computes the boxes.
  /// @param positions  x0 y0 z0 x1 ... [m], at least one vertex (asserted)
  /// @returns whether all positions are finite (see simd::Kernels::bound); if not, the boxes are not valid
  /// @throws InvalidInput if the environment variable SWEEP_GUARD_SIMD is wrong (simd::kernels())
  bool measure(const std::vector<float>& positions);

  /// Grows each box, and that around all, to hold the box at its place among others.
  /// @param others  as many (asserted)
  void include(const VertexBlocks& others);

  size_t count() const { return count_; }  ///< number of boxes, without padding

  /// Returns one array per side of the boxes [m], padded to a multiple of simd::kPadding with unspecified values; valid
  /// until the next measure().
  simd::BoxArrays<const float> arrays() const;

  /// Returns the box around all positions [m].
  const Eigen::AlignedBox3d& bounds() const { return bounds_; }

  /// Returns the sum of the lengths of the boxes' diagonals [m]: a small sum means that the boxes are selective.
  double totalSize() const;

 private:
  size_t count_ = 0;
  std::vector<float> sides_;  // six arrays of boxes
  Eigen::AlignedBox3d bounds_;
};

constexpr size_t kBlockFloats = 3 * simd::kBlock;  ///< coordinates of one block

/// Calls a function with a pointer to the kBlock vertices of one block; simd::kPadding more floats are readable. The
/// last vertex fills the last block. The pointer is valid during the call only.
/// @param positions  x0 y0 z0 x1 ... [m], at least one vertex
/// @param block      below VertexBlocks::count(); not checked
template <typename Function>
void withBlock(const std::vector<float>& positions, size_t block, const Function& function) {
  const size_t first = block * kBlockFloats;
  if (first + kBlockFloats + simd::kPadding <= positions.size()) return function(positions.data() + first);
  std::array<float, kBlockFloats + simd::kPadding + 2> filled;  // whole vertices
  float* const end = std::copy(positions.data() + first, positions.data() + positions.size(), filled.data());
  for (float* to = end; to != filled.data() + filled.size(); to += 3) std::copy_n(&positions.end()[-3], 3, to);
  function(filled.data());
}

}  // namespace sweep_guard_core
