#include "sweep_guard/detection/select_detector.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "sweep_guard/common/error.h"
#include "sweep_guard/detection/box_coordinates.h"

namespace sweep_guard {
namespace {

constexpr double kFloatError = 0x1p-22;  // per metre of distance from the box centre; the worst found is 1 to 2e-8

double farthestCorner(const TriangleMesh& mesh, const BoxCoordinates& coordinates,
                      const std::vector<std::uint32_t>& triangles) {
  double squared = 0.0;
  for (const std::uint32_t triangle : triangles) {
    for (const std::uint32_t vertex : mesh.triangles()[triangle]) {
      squared = std::max(squared, coordinates(vertex).squaredNorm());
    }
  }
  return std::sqrt(squared);
}

// The half-space n·p <= d in coordinates scaled to the cube, as OpenGL wants it: what is kept is positive.
Eigen::Vector4d clipPlane(const HalfSpace& clip_B, const Eigen::Vector3d& half_extents) {
  Eigen::Vector4d plane;
  plane << -clip_B.normal().cwiseProduct(half_extents), clip_B.offset();
  return plane / plane.head<3>().norm();
}

}  // namespace

SelectDetector::SelectDetector(const Options& options, ContextFactory make_context)
    : options_(options), make_context_(std::move(make_context)) {
  assert(options_.block >= 1);
  makeSelection();
}

void SelectDetector::makeSelection() {
  gl_.reset();
  gl_ = std::make_unique<GlSelect>(make_context_(), options_.hit_records);
}

Detection SelectDetector::find(const TriangleMesh& mesh_M, const SweptVolume& swept_M,
                               const std::vector<std::uint32_t>* among) {
  const std::vector<std::uint32_t>& candidates = candidatesOf(mesh_M, swept_M, among);
  const BoxCoordinates coordinates(mesh_M, swept_M.box);
  Detection detection;
  const double drawn = std::max(farthestCorner(mesh_M, coordinates, candidates), swept_M.box.half_extents.norm());
  const double inflation = kFloatError * drawn + coordinates.rounding();
  const SweptVolume inflated_M = swept_M.grown(inflation);
  detection.inflation = 2.0 * inflation;  // OpenGL's rounding can let in what is a little farther out, too
  try {
    detection.triangles = select(mesh_M, inflated_M, candidates);
  } catch (const DeviceError&) {
    makeSelection();
    detection.triangles = select(mesh_M, inflated_M, candidates);
  }
  return detection;
}

std::vector<std::uint32_t> SelectDetector::select(const TriangleMesh& mesh_M, const SweptVolume& inflated_M,
                                                  const std::vector<std::uint32_t>& candidates) {
  if (!gl_) makeSelection();
  const BoxCoordinates coordinates(mesh_M, inflated_M.box);
  const Eigen::Vector3d& half_extents = inflated_M.box.half_extents;
  const Eigen::Vector3d canary = inflated_M.interior_B.cwiseQuotient(half_extents);
  std::vector<Eigen::Vector4d> clips;
  for (const HalfSpace& clip_B : inflated_M.clips_B) clips.push_back(clipPlane(clip_B, half_extents));

  const auto hits = [&](const std::vector<std::uint32_t>& triangles, int triangles_per_name) -> const auto& {
    corners_.clear();
    for (const std::uint32_t triangle : triangles) {
      for (const std::uint32_t vertex : mesh_M.triangles()[triangle]) {
        const Eigen::Vector3f corner = coordinates(vertex).cwiseQuotient(half_extents).cast<float>();
        corners_.insert(corners_.end(), corner.begin(), corner.end());
      }
    }
    return gl_->hits({corners_, triangles_per_name, clips, canary});
  };

  std::vector<std::uint32_t> in_blocks;
  for (const std::uint32_t block : hits(candidates, options_.block)) {
    const auto begin = static_cast<size_t>(block) * static_cast<size_t>(options_.block);
    const size_t end = std::min(candidates.size(), begin + static_cast<size_t>(options_.block));
    in_blocks.insert(in_blocks.end(), candidates.begin() + static_cast<std::ptrdiff_t>(begin),
                     candidates.begin() + static_cast<std::ptrdiff_t>(end));
  }
  std::vector<std::uint32_t> triangles;
  if (in_blocks.empty()) return triangles;
  for (const std::uint32_t name : hits(in_blocks, 1)) triangles.push_back(in_blocks[name]);
  return triangles;
}

const std::vector<std::uint32_t>& SelectDetector::candidatesOf(const TriangleMesh& mesh_M, const SweptVolume& swept_M,
                                                               const std::vector<std::uint32_t>* among) {
  if (!options_.cull) return among != nullptr ? *among : allTriangles(mesh_M);
  return among != nullptr ? cull_(mesh_M, swept_M, *among) : cull_(mesh_M, swept_M);
}

const std::vector<std::uint32_t>& SelectDetector::allTriangles(const TriangleMesh& mesh_M) {
  all_.resize(mesh_M.triangles().size());
  std::iota(all_.begin(), all_.end(), 0U);
  return all_;
}

}  // namespace sweep_guard
