#include "sweep_guard/detection/cull.h"

#include <algorithm>
#include <array>

namespace sweep_guard {
namespace {

constexpr std::int32_t kBeyond = simd::kInsideAll - 1;

}  // namespace

const std::vector<Survivor>& Cull::operator()(const MeshPart& part, const simd::Planes& planes) {
  survivors_.clear();
  if (part.empty() || whollyBeyond(part.mesh_M(), planes)) return survivors_;
  vertex_bits_.resize(std::max(vertex_bits_.size(), part.mesh_M().blocks().count() * simd::kBlock));
  bits_.classify(part, planes);
  for (const Cluster& cluster : part.clusters()) {
    if (!bits_.beyondOnePlane(cluster)) look(part, cluster, planes);
  }
  if (!part.mesh_M().order().triangle_at.empty()) {
    std::sort(survivors_.begin(), survivors_.end(),
              [](const Survivor& a, const Survivor& b) { return a.triangle < b.triangle; });
  }
  return survivors_;
}

void Cull::look(const MeshPart& part, const Cluster& cluster, const simd::Planes& planes) {
  for (const std::uint32_t block : cluster.blocks) classify(part, block, planes);
  const std::vector<std::uint32_t>& triangle_at = part.mesh_M().order().triangle_at;
  const Triangle* corners = &part.mesh_M().cornerPlaces()[cluster.first];
  std::array<Survivor, kMostTriangles> left;
  size_t count = 0;
  for (std::uint32_t i = 0; i < cluster.count; ++i) {
    const std::int32_t a = vertex_bits_[corners[i][0]];
    const std::int32_t b = vertex_bits_[corners[i][1]];
    const std::int32_t c = vertex_bits_[corners[i][2]];
    left[count] = {cluster.first + i, ((a | b | c) & simd::kInsideAll) != 0};
    count += (a & b & c & kBeyond) == 0 ? 1 : 0;  // no branch: it could not be foretold
  }
  if (!triangle_at.empty()) {
    for (size_t i = 0; i < count; ++i) left[i].triangle = triangle_at[left[i].triangle];
  }
  survivors_.insert(survivors_.end(), left.begin(), left.begin() + static_cast<std::ptrdiff_t>(count));
}

void Cull::classify(const MeshPart& part, std::uint32_t block, const simd::Planes& planes) {
  if (!bits_.firstAsked(block)) return;
  const std::uint32_t number = part.blocks()[block];
  withBlock(part.mesh_M().places(), number, [&](const float* vertices) {
    kernels_->classifyBlock(vertices, planes, &vertex_bits_[number * simd::kBlock]);
  });
}

}  // namespace sweep_guard
