#include "sweep_guard/detection/cull.h"

#include <algorithm>

namespace sweep_guard {
namespace {

constexpr std::int32_t kLookedInto = 1 << 30;
constexpr std::int32_t kBeyond = simd::kInsideAll - 1;

}  // namespace

const std::vector<Survivor>& Cull::operator()(const MeshPart& part, const simd::Planes& planes) {
  survivors_.clear();
  if (part.empty() || whollyBeyond(part.mesh_M(), planes)) return survivors_;
  vertex_bits_.resize(std::max(vertex_bits_.size(), part.mesh_M().blocks().count() * simd::kBlock));
  block_bits_ = &bits_(part, planes);
  for (const Cluster& cluster : part.clusters()) {
    if (!beyondOnePlane(cluster, *block_bits_)) look(part, cluster, planes);
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
  const size_t before = survivors_.size();
  survivors_.resize(before + cluster.count);
  Survivor* next = survivors_.data() + before;
  for (std::uint32_t i = 0; i < cluster.count; ++i) {
    const std::int32_t a = vertex_bits_[corners[i][0]];
    const std::int32_t b = vertex_bits_[corners[i][1]];
    const std::int32_t c = vertex_bits_[corners[i][2]];
    const std::uint32_t place = cluster.first + i;
    *next = {triangle_at.empty() ? place : triangle_at[place], ((a | b | c) & simd::kInsideAll) != 0};
    next += (a & b & c & kBeyond) == 0 ? 1 : 0;
  }
  survivors_.resize(static_cast<size_t>(next - survivors_.data()));
}

void Cull::classify(const MeshPart& part, std::uint32_t block, const simd::Planes& planes) {
  std::int32_t& bits = (*block_bits_)[block];
  if ((bits & kLookedInto) != 0) return;
  bits |= kLookedInto;
  const std::uint32_t number = part.blocks()[block];
  withBlock(part.mesh_M().places(), number, [&](const float* vertices) {
    simd::kernels().classifyBlock(vertices, planes, &vertex_bits_[number * simd::kBlock]);
  });
}

}  // namespace sweep_guard
