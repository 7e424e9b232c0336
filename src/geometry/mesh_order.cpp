#include "sweep_guard/geometry/mesh_order.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <numeric>

#include "sweep_guard/geometry/vertex_blocks.h"

namespace sweep_guard_core {
namespace {

constexpr size_t kFewBlocks = 64;    // of a small mesh
constexpr double kWorthwhile = 0.5;  // largest ratio that justifies renumbering, which costs every deformation a gather

// Inserts two zeros after each of the low 21 bits.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 32U) & 0x1f00000000ffffU;
  bits = (bits | bits << 16U) & 0x1f0000ff0000ffU;
  bits = (bits | bits << 8U) & 0x100f00f00f00f00fU;
  bits = (bits | bits << 4U) & 0x10c30c30c30c30c3U;
  return (bits | bits << 2U) & 0x1249249249249249U;
}

// Returns places along the Z-order curve [Morton 1966] through the bounding box.
std::vector<std::uint32_t> placesAlongCurve(const std::vector<float>& positions, const Eigen::AlignedBox3d& bounds) {
  const double scale = 0x1fffff / std::max(bounds.sizes().maxCoeff(), 1e-30);
  std::vector<std::uint64_t> codes(positions.size() / 3);
  for (size_t i = 0; i < codes.size(); ++i) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const double along = scale * (positions[3 * i + axis] - bounds.min()[static_cast<int>(axis)]);
      codes[i] |= spread(static_cast<std::uint64_t>(along)) << axis;
    }
  }
  std::vector<std::uint32_t> order(codes.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return codes[a] < codes[b]; });
  std::vector<std::uint32_t> places(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) places[order[i]] = i;
  return places;
}

bool muchLess(double number, double than) { return number < kWorthwhile * than; }

double totalSizeOfBlocks(const std::vector<float>& positions) {
  VertexBlocks blocks;
  blocks.measure(positions);
  return blocks.totalSize();
}

bool makesBlocksMuchSmaller(const std::vector<std::uint32_t>& places, const std::vector<float>& positions) {
  std::vector<float> kept(positions.size());
  place(places, positions, kept);
  return muchLess(totalSizeOfBlocks(kept), totalSizeOfBlocks(positions));
}

using Blocks = std::array<std::uint32_t, simd::kClusterBlocks>;
using SmallSet = boost::container::static_vector<std::uint32_t, simd::kClusterBlocks>;

// Returns false and changes nothing if the set would be too large.
template <typename Numbers>
bool addNumbers(SmallSet& set, const Numbers& numbers) {
  const size_t before = set.size();
  for (const std::uint32_t number : numbers) {
    if (std::find(set.begin(), set.end(), number) != set.end()) continue;
    if (set.size() == set.capacity()) {
      set.resize(before);
      return false;
    }
    set.push_back(number);
  }
  return true;
}

// Returns the numbers; the last one fills the rest.
Blocks filled(const SmallSet& set) {
  Blocks filled;
  filled.fill(set.back());
  std::copy(set.begin(), set.end(), filled.begin());
  return filled;
}

template <typename Numbers>
Numbers divided(Numbers numbers, std::uint32_t by) {
  for (std::uint32_t& number : numbers) number /= by;
  return numbers;
}

// Returns the longest cluster from a triangle on, limited by its number of blocks.
Cluster clusterFrom(std::uint32_t first, const std::vector<Triangle>& corners) {
  SmallSet blocks;
  std::uint32_t count = 0;
  while (first + count < corners.size() && count < simd::kCluster &&
         addNumbers(blocks, divided(corners[first + count], simd::kBlock))) {
    ++count;
  }
  return {0, first, count, filled(blocks)};
}

ClusterGroup groupFrom(std::uint32_t first, const std::vector<Cluster>& clusters) {
  SmallSet block_groups;
  std::uint32_t count = 0;
  while (first + count < clusters.size() && count < kClustersTogether &&
         addNumbers(block_groups, divided(clusters[first + count].blocks, kBlocksTogether))) {
    ++count;
  }
  return {first, count, filled(block_groups)};
}

std::vector<ClusterGroup> groupsOf(const std::vector<Cluster>& clusters) {
  std::vector<ClusterGroup> groups;
  for (std::uint32_t at = 0; at < clusters.size(); at += groups.back().count) {
    groups.push_back(groupFrom(at, clusters));
  }
  return groups;
}

simd::ClusterCorners clusterCorners(const Cluster& cluster, const std::vector<Triangle>& corners) {
  simd::ClusterCorners places{};
  for (size_t i = 0; i < cluster.count; ++i) {
    for (size_t k = 0; k < 3; ++k) {
      const std::uint32_t vertex = corners[cluster.first + i][k];
      const auto* const block = std::find(cluster.blocks.begin(), cluster.blocks.end(), vertex / simd::kBlock);
      const auto place = static_cast<size_t>(block - cluster.blocks.begin()) * simd::kBlock + vertex % simd::kBlock;
      places[k][i] = static_cast<std::uint8_t>(place);
    }
  }
  return places;
}

std::vector<Cluster> clustersOf(const std::vector<Triangle>& corners) {
  std::vector<Cluster> clusters;
  for (std::uint32_t at = 0; at < corners.size(); at += clusters.back().count) {
    clusters.push_back(clusterFrom(at, corners));
    clusters.back().number = static_cast<std::uint32_t>(clusters.size() - 1);
  }
  return clusters;
}

std::vector<Triangle> placed(const std::vector<std::uint32_t>& places, std::vector<Triangle> triangles) {
  if (places.empty()) return triangles;
  for (Triangle& triangle : triangles) {
    for (std::uint32_t& vertex : triangle) vertex = places[vertex];
  }
  return triangles;
}

std::vector<std::uint32_t> byFirstVertex(const std::vector<Triangle>& corners) {
  std::vector<std::uint32_t> order(corners.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto first = [&](std::uint32_t i) { return *std::min_element(corners[i].begin(), corners[i].end()); };
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return first(a) < first(b); });
  return order;
}

bool hasMuchFewer(const std::vector<Cluster>& clusters, const std::vector<Cluster>& others) {
  return muchLess(static_cast<double>(clusters.size()), static_cast<double>(others.size()));
}

void addCorners(const std::vector<Triangle>& corners, MeshOrder& order) {
  order.corners.reserve(order.clusters.size());
  for (const Cluster& cluster : order.clusters) order.corners.push_back(clusterCorners(cluster, corners));
  order.groups = groupsOf(order.clusters);
}

void addBlocks(size_t vertices, MeshOrder& order) {
  order.blocks.resize((vertices + simd::kBlock - 1) / simd::kBlock);
  std::iota(order.blocks.begin(), order.blocks.end(), 0U);
}

// Orders the triangles, whose corners are at these places.
MeshOrder orderAt(std::vector<std::uint32_t> vertex_places, const std::vector<Triangle>& triangles) {
  MeshOrder order;
  order.vertex_places = std::move(vertex_places);
  std::vector<Triangle> corners = placed(order.vertex_places, triangles);
  order.clusters = clustersOf(corners);

  const std::vector<std::uint32_t> sorted = byFirstVertex(corners);
  std::vector<Triangle> in_order;
  in_order.reserve(sorted.size());
  for (const std::uint32_t triangle : sorted) in_order.push_back(corners[triangle]);
  std::vector<Cluster> clusters = clustersOf(in_order);
  if (hasMuchFewer(clusters, order.clusters)) {
    order.triangle_at = sorted;
    order.clusters = std::move(clusters);
    corners = std::move(in_order);
  }
  addCorners(corners, order);
  return order;
}

// Renumbers the vertices if that makes the boxes much smaller. In a small mesh no box is small, whatever the order, but
// renumbering may take much fewer clusters.
MeshOrder betterOrder(const std::vector<float>& positions, const std::vector<Triangle>& triangles) {
  VertexBlocks blocks;
  blocks.measure(positions);
  if (blocks.count() < 2) return orderAt({}, triangles);
  std::vector<std::uint32_t> places = placesAlongCurve(positions, blocks.bounds());
  if (makesBlocksMuchSmaller(places, positions)) return orderAt(std::move(places), triangles);
  MeshOrder as_sent = orderAt({}, triangles);
  if (blocks.count() > kFewBlocks) return as_sent;
  MeshOrder along_curve = orderAt(std::move(places), triangles);
  return hasMuchFewer(along_curve.clusters, as_sent.clusters) ? along_curve : as_sent;
}

}  // namespace

MeshOrder orderOf(const std::vector<float>& positions, const std::vector<Triangle>& triangles) {
  MeshOrder order = betterOrder(positions, triangles);
  addBlocks(positions.size() / 3, order);
  return order;
}

MeshOrder sendersOrder(size_t vertices, const std::vector<Triangle>& triangles) {
  MeshOrder order;
  order.clusters = clustersOf(triangles);
  addCorners(triangles, order);
  addBlocks(vertices, order);
  return order;
}

void place(const std::vector<std::uint32_t>& places, const std::vector<float>& sent, std::vector<float>& kept) {
  const float* position = sent.data();
  for (const std::uint32_t kept_as : places) {
    float* const to = kept.data() + 3 * static_cast<size_t>(kept_as);
    for (size_t axis = 0; axis < 3; ++axis) to[axis] = *position++;
  }
}

}  // namespace sweep_guard_core
