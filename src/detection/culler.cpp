#include "detection/culler.h"

#include <algorithm>
#include <array>

namespace sweep_guard_core {
namespace {

template <typename Value>
void fetch(const Value* from, size_t count = 1) {
  constexpr size_t kLine = 64;
  for (size_t i = 0; i < count * sizeof(Value); i += kLine) __builtin_prefetch(reinterpret_cast<const char*>(from) + i);
}

}  // namespace

const std::vector<RemainingTriangle>& Culler::cull(const Submesh& submesh, const simd::Planes& planes) {
  remaining_.clear();
  if (submesh.empty() || whollyBeyond(submesh, planes)) return remaining_;
  findClusters(submesh, planes);
  for (const std::uint32_t block : blocks_) classifyBlock(submesh, planes, block);
  for (const Cluster* cluster : clusters_) cullCluster(submesh.mesh_M(), *cluster);
  return remaining_;
}

bool Culler::leavesAny(const Submesh& submesh, const simd::Planes& planes) {
  if (submesh.empty() || whollyBeyond(submesh, planes)) return false;
  vertex_bits_.resize(std::max(vertex_bits_.size(), submesh.blocks().size() * simd::kBlock));
  bits_.classify(submesh, planes);
  bool any = false;
  bits_.forEachRemaining(submesh, [&](const Cluster& cluster) {
    if (any) return;
    for (const std::uint32_t block : cluster.blocks) {
      if (bits_.firstAsked(block)) classifyBlock(submesh, planes, block);
    }
    any = (classified(submesh.mesh_M().order(), cluster).not_beyond & submesh.mesh_M().existing(cluster)) != 0;
  });
  return any;
}

// Finds the clusters that do not lie wholly beyond one plane, and prefetches their corners and vertices.
void Culler::findClusters(const Submesh& submesh, const simd::Planes& planes) {
  clusters_.clear();
  blocks_.clear();
  vertex_bits_.resize(std::max(vertex_bits_.size(), submesh.blocks().size() * simd::kBlock));
  bits_.classify(submesh, planes);
  bits_.forEachRemaining(submesh, [&](const Cluster& cluster) {
    clusters_.push_back(&cluster);
    fetch(&submesh.mesh_M().order().corners[cluster.number]);
    for (const std::uint32_t block : cluster.blocks) {
      if (!bits_.firstAsked(block)) continue;
      blocks_.push_back(block);
      fetch(submesh.mesh_M().places().data() + submesh.blocks()[block] * kBlockFloats, kBlockFloats);
    }
  });
}

void Culler::classifyBlock(const Submesh& submesh, const simd::Planes& planes, std::uint32_t block) {
  std::uint16_t* const bits = &vertex_bits_[block * simd::kBlock];
  const auto classify = [&](const std::vector<float>& places, std::uint16_t* found) {
    withBlock(places, submesh.blocks()[block],
              [&](const float* vertices) { kernels_->classifyBlock(vertices, planes, found); });
  };
  classify(submesh.mesh_M().places(), bits);
  if (!submesh.isInMotion()) return;
  std::array<std::uint16_t, simd::kBlock> before;
  classify(submesh.mesh_M().placesBefore(), before.data());
  std::transform(before.begin(), before.end(), bits, bits, [](unsigned one, unsigned other) {
    return static_cast<std::uint16_t>((one & other) | ((one | other) & simd::kInsideAll));
  });
}

simd::TriangleBits Culler::classified(const MeshOrder& order, const Cluster& cluster) const {
  const auto bits = [&](size_t i) { return &vertex_bits_[cluster.blocks[i] * simd::kBlock]; };
  return kernels_->classifyTriangles(order.corners[cluster.number], {bits(0), bits(1), bits(2), bits(3)});
}

void Culler::cullCluster(const TriangleMesh& mesh_M, const Cluster& cluster) {
  const MeshOrder& order = mesh_M.order();
  const simd::TriangleBits found = classified(order, cluster);
  for (std::uint64_t left = found.not_beyond & mesh_M.existing(cluster); left != 0; left &= left - 1) {
    const auto i = static_cast<std::uint32_t>(__builtin_ctzll(left));
    const std::uint32_t place = cluster.first + i;
    remaining_.push_back(
        {order.triangle_at.empty() ? place : order.triangle_at[place], (found.corner_inside >> i & 1U) != 0});
  }
}

}  // namespace sweep_guard_core
