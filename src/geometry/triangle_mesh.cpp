#include "sweep_guard/geometry/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/xyz.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

template <typename Coordinate>
bool usable(Coordinate coordinate) {
  return std::abs(coordinate) <= static_cast<Coordinate>(kMaxCoordinate);  // false for NaN and infinity too
}

[[noreturn]] void refuseVertex(size_t vertex) {
  throw InvalidInput("vertex " + std::to_string(vertex) +
                     " is NaN, infinite or beyond 1e7 m: send finite positions in meters");
}

void checkTriangles(const std::vector<Triangle>& triangles, size_t vertex_count) {
  if (triangles.empty()) throw InvalidInput("the mesh has no triangles: send at least one");
  for (size_t i = 0; i < triangles.size(); ++i) {
    const std::uint32_t largest = *std::max_element(triangles[i].begin(), triangles[i].end());
    if (largest >= vertex_count) {
      throw InvalidInput("triangle " + std::to_string(i) + " names vertex " + std::to_string(largest) + " of " +
                         std::to_string(vertex_count) + ": indices are 0-based and below the number of vertices");
    }
  }
}

struct Edges {
  bool even = true;      // each belongs to an even number of triangles
  bool balanced = true;  // each is passed as often in either direction
};

// An edge is its higher vertex, its lower one (below 2^31: it is not the last), and a bit for the direction.
std::vector<std::uint64_t> sortedEdges(const std::vector<Triangle>& triangles) {
  std::vector<std::uint64_t> edges;
  edges.reserve(3 * triangles.size());
  for (const Triangle& triangle : triangles) {
    for (size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = triangle[i];
      const auto [low, high] = std::minmax(from, triangle[(i + 1) % 3]);
      if (low != high) edges.push_back(std::uint64_t{high} << 32 | std::uint64_t{low} << 1 | (from == low ? 1 : 0));
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

Edges examineEdges(const std::vector<Triangle>& triangles) {
  const std::vector<std::uint64_t> edges = sortedEdges(triangles);
  Edges found;
  for (auto run = edges.begin(); run != edges.end();) {
    const auto upwards = std::upper_bound(run, edges.end(), *run & ~std::uint64_t{1});
    const auto next = std::upper_bound(upwards, edges.end(), *run | 1);
    if ((next - run) % 2 != 0) found.even = false;
    if (next - upwards != upwards - run) found.balanced = false;
    run = next;
  }
  return found;
}

double signedVolume(const std::vector<float>& positions, const std::vector<Triangle>& triangles) {
  const auto at = [&](std::uint32_t i) -> Eigen::Vector3d {
    return Eigen::Map<const Eigen::Vector3f>(&positions[3 * size_t{i}]).cast<double>();
  };
  double six_volumes = 0.0;
  for (const auto& [a, b, c] : triangles) six_volumes += at(a).dot(at(b).cross(at(c)));
  return six_volumes / 6.0;
}

int windingOf(const Edges& edges, const std::vector<float>& positions, const std::vector<Triangle>& triangles) {
  if (!edges.even || !edges.balanced) return 0;
  const double volume = signedVolume(positions, triangles);
  return static_cast<int>(volume > 0.0) - static_cast<int>(volume < 0.0);
}

[[noreturn]] void refuse(const std::vector<float>& positions) {
  const auto bad = std::find_if_not(positions.begin(), positions.end(), usable<float>);
  refuseVertex(static_cast<size_t>(bad - positions.begin()) / 3);
}

Eigen::Vector3d centerOf(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points) box.extend(p);
  return box.center();
}

}  // namespace

TriangleMesh::TriangleMesh(const std::vector<Eigen::Vector3d>& vertices_M, std::vector<Triangle> triangles) {
  checkTriangles(triangles, vertices_M.size());
  for (size_t i = 0; i < vertices_M.size(); ++i) {
    for (const double coordinate : xyz(vertices_M[i])) {
      if (!usable(coordinate)) refuseVertex(i);
    }
  }
  origin_ = centerOf(vertices_M);
  std::vector<float> sent;
  sent.reserve(3 * vertices_M.size());
  for (const Eigen::Vector3d& p : vertices_M) {
    const Eigen::Vector3f kept = (p - origin_).cast<float>();
    sent.insert(sent.end(), kept.data(), kept.data() + 3);
    rounding_ = std::max(rounding_, (p - (origin_ + kept.cast<double>())).norm());
  }
  const Edges edges = examineEdges(triangles);
  const int winding = windingOf(edges, sent, triangles);
  MeshOrder order = orderOf(sent, triangles);
  topology_ = std::make_shared<const Topology>(Topology{std::move(triangles), edges.even, winding, std::move(order)});
  exchange(sent);
}

// Takes the offsets in the sender's order and returns the previous ones in the buffer. Returns false and changes
// nothing if an offset is unusable.
bool TriangleMesh::exchange(std::vector<float>& sent) {
  const std::vector<std::uint32_t>& places = topology_->order.vertex_places;
  if (!places.empty()) {
    spare_.resize(sent.size());
    place(places, sent, spare_);
  }
  std::vector<float>& incoming = places.empty() ? sent : spare_;
  offsets_.swap(incoming);
  if (measure()) return true;
  offsets_.swap(incoming);
  if (!offsets_.empty()) measure();
  return false;
}

bool TriangleMesh::measure() {
  const bool finite = blocks_.measure(offsets_);
  const Eigen::AlignedBox3d& bounds = blocks_.bounds();
  radius_ = bounds.min().cwiseAbs().cwiseMax(bounds.max().cwiseAbs()).norm();
  return finite && usable(bounds.min().minCoeff()) && usable(bounds.max().maxCoeff());
}

void TriangleMesh::checkCount(const std::vector<float>& positions_M) const {
  if (positions_M.size() == 3 * vertexCount()) return;
  throw InvalidInput(std::to_string(positions_M.size()) + " coordinates for " + std::to_string(vertexCount()) +
                     " vertices: send three per vertex of the mesh");
}

void TriangleMesh::deform(std::vector<float>& positions_M) {
  checkCount(positions_M);
  if (!exchange(positions_M)) refuse(positions_M);
  origin_.setZero();
  rounding_ = 0.0;
}

}  // namespace sweep_guard_core
