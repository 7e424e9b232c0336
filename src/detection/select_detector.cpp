#include "detection/select_detector.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "detection/box_coordinates.h"
#include "detection/float_planes.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr double kSelectError =
    0x1p-22;  // per meter of distance from the center of the box; the largest found is 1 to 2e-8

// Converts the half-space n·p <= d to a plane in coordinates scaled to the cube; OpenGL keeps the positive side.
Eigen::Vector4d clipPlane(const HalfSpace& clip_B, const Eigen::Vector3d& half_extents) {
  Eigen::Vector4d plane;
  plane << -clip_B.normal().cwiseProduct(half_extents), clip_B.offset();
  return plane / plane.head<3>().norm();
}

}  // namespace

SelectDetector::SelectDetector(const DetectorOptions& options, ContextFactory make_context, size_t hit_records)
    : options_(options), make_context_(std::move(make_context)), hit_records_(hit_records) {
  assert(options_.triangles_per_name >= 1);
  makeSelection();
}

void SelectDetector::makeSelection() {
  gl_.reset();
  gl_ = std::make_unique<GlSelect>(make_context_(), hit_records_);
}

void SelectDetector::find(const Submesh& submesh, const SweptVolume& swept_M, Detection& detection) {
  const std::vector<RemainingTriangle>& remaining =
      options_.cull ? culler_.cull(submesh, floatPlanes(submesh.mesh_M(), swept_M)) : all(submesh);
  collectCorners(submesh.mesh_M(), swept_M.box, remaining);
  names_.clear();
  if (!corners_B_.empty()) {  // without triangles in doubt, OpenGL is not used
    const double inflation = computeInflation(submesh.mesh_M(), swept_M.box);
    detection.inflation = 2.0 * inflation;  // OpenGL's rounding can add triangles as far outside of the inflated volume
    const SweptVolume inflated_M = swept_M.grown(inflation);
    try {
      select(inflated_M);
    } catch (const DeviceError&) {
      makeSelection();
      select(inflated_M);
    }
  }
  std::uint32_t number = 0;  // among the triangles in doubt
  auto name = names_.begin();
  for (const RemainingTriangle& candidate : remaining) {
    const bool hit = !candidate.met && name != names_.end() && *name == number;
    if (candidate.met || hit) detection.triangles.push_back(candidate.triangle);
    if (hit) ++name;
    if (!candidate.met) ++number;
  }
}

// Collects the corners of the triangles in doubt.
void SelectDetector::collectCorners(const TriangleMesh& mesh_M, const OrientedBox& box_M,
                                    const std::vector<RemainingTriangle>& remaining) {
  const BoxCoordinates coordinates(mesh_M, box_M);
  corners_B_.clear();
  for (const RemainingTriangle& candidate : remaining) {
    if (candidate.met) continue;
    for (const std::uint32_t vertex : mesh_M.triangles()[candidate.triangle])
      corners_B_.push_back(coordinates.position(vertex));
  }
}

double SelectDetector::computeInflation(const TriangleMesh& mesh_M, const OrientedBox& box_M) const {
  double squared = box_M.half_extents.squaredNorm();
  for (const Eigen::Vector3d& corner : corners_B_) squared = std::max(squared, corner.squaredNorm());
  return kSelectError * std::sqrt(squared) + BoxCoordinates(mesh_M, box_M).rounding();
}

// Finds the triangles that hit, counted among those in doubt: first in blocks, then one by one.
void SelectDetector::select(const SweptVolume& inflated_M) {
  if (!gl_) makeSelection();
  const Eigen::Vector3d& half_extents = inflated_M.box.half_extents;
  const Eigen::Vector3d canary = inflated_M.interior_B.cwiseQuotient(half_extents);
  clips_.clear();
  for (const HalfSpace& clip_B : inflated_M.clips_B) clips_.push_back(clipPlane(clip_B, half_extents));
  corners_.clear();
  for (const Eigen::Vector3d& corner_B : corners_B_) {
    const Eigen::Vector3f corner = corner_B.cwiseQuotient(half_extents).cast<float>();
    corners_.insert(corners_.end(), corner.data(), corner.data() + 3);
  }

  if (options_.triangles_per_name == 1) {
    names_ = gl_->hits({corners_, 1, clips_, canary});
    return;
  }
  for (auto* triangles : {&in_blocks_, &names_})
    triangles->reserve(corners_.capacity() / 9);  // both grow with the corners
  in_blocks_.clear();
  const auto count = static_cast<std::uint32_t>(corners_B_.size() / 3);
  const auto block = static_cast<std::uint32_t>(options_.triangles_per_name);
  for (const std::uint32_t name : gl_->hits({corners_, options_.triangles_per_name, clips_, canary})) {
    for (std::uint32_t i = name * block; i < std::min(count, (name + 1) * block); ++i) in_blocks_.push_back(i);
  }
  names_.clear();
  if (in_blocks_.empty()) return;
  for (size_t i = 0; i < in_blocks_.size(); ++i) {  // moves corners forward only: blocks ascend
    std::copy_n(corners_.begin() + 9 * static_cast<std::ptrdiff_t>(in_blocks_[i]), 9,
                corners_.begin() + 9 * static_cast<std::ptrdiff_t>(i));
  }
  corners_.resize(9 * in_blocks_.size());
  for (const std::uint32_t name : gl_->hits({corners_, 1, clips_, canary})) names_.push_back(in_blocks_[name]);
}

const std::vector<RemainingTriangle>& SelectDetector::all(const Submesh& submesh) {
  all_.clear();
  submesh.forEachTriangle([&](std::uint32_t triangle) { all_.push_back({triangle, false}); });
  return all_;
}

}  // namespace sweep_guard_core
