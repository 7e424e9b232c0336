#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_core {

/// Boxes along the axes around every simd::kBlock consecutive vertices of a mesh: what a deformation is looked at by.
/// Taken in one pass over the positions.
class VertexBlocks {
 public:
  /// @param positions  x0 y0 z0 x1 ... [m], not empty
  /// @returns whether all of them are finite; if not, the boxes mean nothing
  bool measure(const std::vector<float>& positions);

  size_t count() const { return count_; }

  /// One array per side, padded to simd::kPadding [m].
  simd::BoxArrays<const float> arrays() const;

  /// Around all of them [m].
  const Eigen::AlignedBox3d& bounds() const { return bounds_; }

  /// Sum of the lengths of their diagonals [m]: the smaller, the better they tell near from far.
  double totalSize() const;

 private:
  size_t count_ = 0;
  std::vector<float> sides_;  // six arrays of boxes
  Eigen::AlignedBox3d bounds_;
};

constexpr size_t kBlockFloats = 3 * simd::kBlock;

/// Calls a function with the vertices of one block: kBlock of them, readable simd::kPadding floats on. The last block
/// is filled up with its last vertex.
template <typename Function>
void withBlock(const std::vector<float>& positions, size_t block, const Function& function) {
  const size_t first = block * kBlockFloats;
  if (first + kBlockFloats + simd::kPadding <= positions.size()) return function(positions.data() + first);
  std::array<float, kBlockFloats + simd::kPadding> filled;
  for (size_t i = 0; i < filled.size(); ++i) {
    const size_t at = first + i;
    filled[i] = positions[at < positions.size() ? at : positions.size() - 3 + i % 3];
  }
  function(filled.data());
}

}  // namespace sweep_guard_core
