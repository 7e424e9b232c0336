#include "sweep_guard/geometry/triangle_mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "common/xyz.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/geometry/grid.h"

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

[[noreturn]] void refuse(const std::vector<float>& positions) {
  const auto bad = std::find_if_not(positions.begin(), positions.end(), usable<float>);
  refuseVertex(static_cast<size_t>(bad - positions.begin()) / 3);
}

Eigen::Vector3d centerOf(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points) box.extend(p);
  return box.center();
}

double halfStep(double coordinate) {
  const auto kept = static_cast<float>(coordinate);
  const float next = std::nextafter(kept, std::numeric_limits<float>::infinity());
  return 0.5 * (static_cast<double>(next) - static_cast<double>(kept));
}

}  // namespace

double float32Rounding(const Eigen::Vector3d& largest) { return largest.unaryExpr(&halfStep).norm(); }

TriangleMesh::TriangleMesh(const std::vector<Eigen::Vector3d>& vertices_M, std::vector<Triangle> triangles,
                           bool is_sheet, double rounded) {
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
  Enclosure enclosure = is_sheet ? Enclosure() : Enclosure(sent, triangles);
  MeshOrder order = orderOf(sent, triangles);
  rounding_ += rounded;
  topology_ = std::make_shared<const Topology>(
      Topology{std::move(triangles), is_sheet, std::move(enclosure), std::move(order)});
  exchange(sent);
}

TriangleMesh::TriangleMesh(const Grid& grid) {
  std::vector<Triangle> triangles = grid.triangles();
  MeshOrder order = sendersOrder(grid.places(), triangles);
  existing_.assign(order.clusters.size(), 0);
  topology_ = std::make_shared<const Topology>(
      Topology{std::move(triangles), /*is_sheet=*/true, Enclosure(), std::move(order)});
  std::vector<float> sent(3 * grid.places(), 0.0F);
  before_ = sent;
  exchange(sent);
  blocks_in_motion_ = blocks_;
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
  return takeBounds(blocks_.bounds()) && finite;
}

bool TriangleMesh::takeBounds(const Eigen::AlignedBox3d& bounds) {
  radius_ = bounds.min().cwiseAbs().cwiseMax(bounds.max().cwiseAbs()).norm();
  return usable(bounds.min().minCoeff()) && usable(bounds.max().maxCoeff());
}

void TriangleMesh::roundTo(const Eigen::AlignedBox3d& bounds) {
  rounding_ = float32Rounding(bounds.min().cwiseAbs().cwiseMax(bounds.max().cwiseAbs()));
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
  roundTo(blocks_.bounds());
}

void TriangleMesh::deform(std::vector<float>& places_M, std::vector<float>& before_M,
                          std::vector<std::uint64_t>& existing) {
  assert(before_M.size() == before_.size() && existing.size() == existing_.size());
  deform(places_M);
  before_.swap(before_M);
  existing_.swap(existing);
  [[maybe_unused]] const bool finite = blocks_in_motion_.measure(before_);
  blocks_in_motion_.include(blocks_);
  const Eigen::AlignedBox3d& bounds = blocks_in_motion_.bounds();
  [[maybe_unused]] const bool in_bounds = takeBounds(bounds);
  assert(finite && in_bounds);
  roundTo(bounds);
}

}  // namespace sweep_guard_core
