#include "sweep_guard/geometry/vertex_blocks.h"

#include <cassert>
#include <limits>

namespace sweep_guard {

bool VertexBlocks::measure(const std::vector<float>& positions) {
  assert(!positions.empty() && positions.size() % 3 == 0);
  constexpr size_t kFloats = 3 * simd::kBlock;
  constexpr float kFar = std::numeric_limits<float>::infinity();
  count_ = (positions.size() + kFloats - 1) / kFloats;
  stride_ = simd::padded(count_);
  sides_.resize(6 * stride_);

  const auto sidesFrom = [&](size_t block) {
    const auto side = [&](size_t i) { return sides_.data() + i * stride_ + block; };
    return simd::BoxArrays<float>{{side(0), side(1), side(2)}, {side(3), side(4), side(5)}};
  };
  simd::Extremes extremes{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  const size_t readable = positions.size() - std::min(positions.size(), simd::kPadding);
  const size_t whole = std::min(readable / kFloats, count_ - 1);
  bool finite = simd::kernels().bound(positions.data(), whole, sidesFrom(0), extremes);
  for (size_t block = whole; block < count_; ++block) {
    withBlock(positions, block, [&](const float* vertices) {
      finite = simd::kernels().bound(vertices, 1, sidesFrom(block), extremes) && finite;
    });
  }
  bounds_ = Eigen::AlignedBox3f(Eigen::Vector3f(extremes.lower.data()), Eigen::Vector3f(extremes.upper.data()))
                .cast<double>();
  return finite;
}

simd::BoxArrays<const float> VertexBlocks::arrays() const {
  const auto side = [&](size_t i) { return sides_.data() + i * stride_; };
  return {{side(0), side(1), side(2)}, {side(3), side(4), side(5)}};
}

double VertexBlocks::totalSize() const {
  const auto [lower, upper] = arrays();
  double sum = 0.0;
  for (size_t i = 0; i < count_; ++i) {
    sum += (Eigen::Vector3d(upper[0][i], upper[1][i], upper[2][i]) -
            Eigen::Vector3d(lower[0][i], lower[1][i], lower[2][i]))
               .norm();
  }
  return sum;
}

}  // namespace sweep_guard
