#include "sweep_guard/geometry/vertex_blocks.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace sweep_guard {
namespace {

template <typename Number>
simd::BoxArrays<Number> sixArrays(Number* sides, size_t boxes) {
  const size_t stride = simd::padded(boxes);
  return {{sides, sides + stride, sides + 2 * stride}, {sides + 3 * stride, sides + 4 * stride, sides + 5 * stride}};
}

size_t largerCount(size_t boxes) { return simd::padded(boxes) / simd::kPadding; }

}  // namespace

bool VertexBlocks::measure(const std::vector<float>& positions) {
  assert(!positions.empty() && positions.size() % 3 == 0);
  constexpr size_t kFloats = 3 * simd::kBlock;
  constexpr float kFar = std::numeric_limits<float>::infinity();
  count_ = (positions.size() + kFloats - 1) / kFloats;
  sides_.resize(6 * simd::padded(count_));
  larger_.resize(6 * simd::padded(largerCount(count_)));
  const auto boxes = sixArrays(sides_.data(), count_);
  const auto larger = sixArrays(larger_.data(), largerCount(count_));

  simd::Extremes extremes{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  const size_t readable = positions.size() - std::min(positions.size(), simd::kPadding);
  const size_t whole = std::min(readable / kFloats, count_ - 1);
  bool finite = simd::kernels().bound(positions.data(), whole, boxes, larger, extremes);
  for (size_t block = whole; block < count_; ++block) {
    withBlock(positions, block, [&](const float* vertices) {
      finite = simd::kernels().bound(vertices, 1, boxes.from(block), larger, extremes) && finite;
    });
  }
  enlarge(whole / simd::kPadding);
  bounds_ = Eigen::AlignedBox3f(Eigen::Vector3f(extremes.lower.data()), Eigen::Vector3f(extremes.upper.data()))
                .cast<double>();
  return finite;
}

// Those that are not full.
void VertexBlocks::enlarge(size_t first) {
  const auto boxes = sixArrays(sides_.data(), count_);
  const auto larger = sixArrays(larger_.data(), largerCount(count_));
  for (size_t i = first; i < largerCount(count_); ++i) {
    const size_t begin = i * simd::kPadding;
    const size_t end = std::min(count_, begin + simd::kPadding);
    for (size_t axis = 0; axis < 3; ++axis) {
      larger.lower[axis][i] = *std::min_element(boxes.lower[axis] + begin, boxes.lower[axis] + end);
      larger.upper[axis][i] = *std::max_element(boxes.upper[axis] + begin, boxes.upper[axis] + end);
    }
  }
}

simd::BoxArrays<const float> VertexBlocks::arrays() const { return sixArrays(sides_.data(), count_); }
simd::BoxArrays<const float> VertexBlocks::larger() const { return sixArrays(larger_.data(), largerCount(count_)); }

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
