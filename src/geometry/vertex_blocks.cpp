#include "sweep_guard/geometry/vertex_blocks.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace sweep_guard_core {
namespace {

template <typename Number>
simd::BoxArrays<Number> sixArrays(Number* sides, size_t boxes) {
  const size_t stride = simd::padded(boxes);
  return {{sides, sides + stride, sides + 2 * stride}, {sides + 3 * stride, sides + 4 * stride, sides + 5 * stride}};
}

}  // namespace

bool VertexBlocks::measure(const std::vector<float>& positions) {
  assert(!positions.empty() && positions.size() % 3 == 0);
  constexpr float kFar = std::numeric_limits<float>::infinity();
  count_ = (positions.size() + kBlockFloats - 1) / kBlockFloats;
  sides_.resize(6 * simd::padded(count_));
  const auto boxes = sixArrays(sides_.data(), count_);

  simd::Extremes extremes{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  const size_t readable = positions.size() - std::min(positions.size(), simd::kPadding);
  const size_t whole = std::min(readable / kBlockFloats, count_ - 1);
  bool finite = simd::kernels().bound(positions.data(), whole, boxes, extremes);
  for (size_t block = whole; block < count_; ++block) {
    withBlock(positions, block, [&](const float* vertices) {
      finite = simd::kernels().bound(vertices, 1, boxes.from(block), extremes) && finite;
    });
  }
  bounds_ = Eigen::AlignedBox3f(Eigen::Vector3f(extremes.lower.data()), Eigen::Vector3f(extremes.upper.data()))
                .cast<double>();
  return finite;
}

void VertexBlocks::include(const VertexBlocks& others) {
  assert(others.count_ == count_);
  const auto middle = static_cast<std::ptrdiff_t>(sides_.size() / 2);
  const auto lesser = [](float a, float b) { return std::min(a, b); };
  const auto larger = [](float a, float b) { return std::max(a, b); };
  const auto& sides = others.sides_;
  std::transform(sides.begin(), sides.begin() + middle, sides_.begin(), sides_.begin(), lesser);
  std::transform(sides.begin() + middle, sides.end(), sides_.begin() + middle, sides_.begin() + middle, larger);
  bounds_.extend(others.bounds_);
}

simd::BoxArrays<const float> VertexBlocks::arrays() const { return sixArrays(sides_.data(), count_); }

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

}  // namespace sweep_guard_core
