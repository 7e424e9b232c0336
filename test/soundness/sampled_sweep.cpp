#include "soundness/sampled_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "soundness/exact_motion.h"
#include "soundness/nearest_point.h"
#include "soundness/positives.h"

namespace sweep_guard_core::soundness {
namespace {

using CornersInReal = std::array<Vector3r, 3>;

}  // namespace

SampledSweep::SampledSweep(const SweepCase& sweep) : tool_(sweep.tool) {
  const ExactMotion motion(sweep.motion);
  for (int i = 0; i <= kSteps; ++i) {
    const Real fraction = static_cast<Real>(i) / kSteps;
    Pose pose;
    pose.p_M = motion.at(fraction, Vector3r::Zero());
    for (int axis = 0; axis < 3; ++axis) {
      pose.R_TM.col(axis) = motion.directionInTool(fraction, Vector3r::Unit(axis));
    }
    poses_.push_back(pose);
  }
  length_ = (poses_.back().p_M - poses_.front().p_M).norm();
  angle_ = static_cast<Real>(sweep.motion.angle()) * (1 + 1e-9L);
  tolerance_ = 1e-12L * static_cast<Real>(extentOf(tool_));
}

std::optional<Real> SampledSweep::distance(const std::array<Eigen::Vector3d, 3>& corners_M) const {
  const CornersInReal corners = {corners_M[0].cast<Real>(), corners_M[1].cast<Real>(), corners_M[2].cast<Real>()};
  const Vector3r center = (corners[0] + corners[1] + corners[2]) / 3;
  Real radius = 0;
  for (const Vector3r& p : corners) radius = std::max(radius, (p - center).norm());
  const Real lever = std::max((center - poses_.front().p_M).norm(), (center - poses_.back().p_M).norm()) + radius;
  const Real step_length =
      (length_ + angle_ * lever) / kSteps;  // bound for any point of the triangle, in the tool frame

  Real least = std::numeric_limits<Real>::infinity();
  for (const Body& body : tool_) {
    for (size_t i = 0; i < poses_.size();) {
      const Pose& pose = poses_[i];
      Real distance = -depth(body, pose.R_TM * (center - pose.p_M)) - radius;
      if (distance <= 4 * step_length) {
        const std::optional<Real> closer = distanceAt(pose, body, corners);
        if (!closer) return std::nullopt;
        distance = *closer;
      }
      // Advances by half of the distance.
      const Real steps = step_length > 0 ? std::min<Real>(distance / (2 * step_length), kSteps + 1) : kSteps + 1;
      const auto whole = std::max<size_t>(1, static_cast<size_t>(std::max<Real>(steps, 0)));
      least = std::min(least, distance - static_cast<Real>(whole) * step_length);
      i += whole;
    }
  }
  return least - tolerance_;
}

bool SampledSweep::endsInside(const Triangles& triangles) const {
  const Pose& end = poses_.back();
  return std::any_of(tool_.begin(), tool_.end(), [&](const Body& body) {
    const Vector3r p = end.p_M + end.R_TM.transpose() * support(body, Vector3r::UnitZ());
    Real solid_angle = 0;  // of each triangle, after van Oosterom and Strackee 1983
    for (size_t i = 0; i < triangles.count(); ++i) {
      CornersInReal seen;
      for (size_t k = 0; k < 3; ++k) seen[k] = (triangles.corners_M[3 * i + k].cast<Real>() - p).normalized();
      const auto& [a, b, c] = seen;
      solid_angle += 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
    }
    return std::abs(solid_angle) > 6;  // 4 pi inside, 0 outside
  });
}

std::optional<Real> SampledSweep::distanceAt(const Pose& pose, const Body& body, const CornersInReal& corners_M) const {
  CornersInReal corners_T;
  Vector3r p = Vector3r::Zero();
  for (size_t i = 0; i < 3; ++i) {
    corners_T[i] = pose.R_TM * (corners_M[i] - pose.p_M);
    if (depth(body, corners_T[i]) > tolerance_) return std::nullopt;
    p += corners_T[i] / 3;
  }
  Real width = 0;
  constexpr int kTimes = 8;
  for (int i = 0; i < kTimes; ++i) {
    if (depth(body, p) > tolerance_) return std::nullopt;
    const Vector3r of_body = nearest(body, p);
    p = nearestOfTriangle(corners_T, of_body);
    // The width of a slab between them.
    const Vector3r across = (p - of_body).normalized();
    const Real triangle = std::min({across.dot(corners_T[0]), across.dot(corners_T[1]), across.dot(corners_T[2])});
    width = std::max(width, triangle - across.dot(support(body, across)));
    if (width > 0.5L * (p - of_body).norm()) return width;
  }
  if (depth(body, p) > tolerance_) return std::nullopt;
  return width;
}

SweepCase randomWholeSweep(std::uint64_t seed) {
  Random random(seed);
  SweepCase sweep;
  const TriangleMesh mesh = wavyHull(/*rings=*/21, /*sectors=*/40, random.uniform(0.0, 6.0));
  for (const Triangle& triangle : mesh.triangles()) {
    for (const std::uint32_t vertex : triangle) sweep.triangles.corners_M.push_back(mesh.vertex(vertex));
  }
  sweep.triangles.welded = true;
  const std::vector<VolumeKind> kinds = volumeKinds();
  sweep.options.volume = kinds[static_cast<size_t>(random.below(static_cast<int>(kinds.size())))];
  const auto flatHull = [](const Body& body) { return body.kind == Body::Kind::kHull && body.facets.empty(); };
  do {
    sweep.tool = randomBodies(random, random.logUniform(0.01, 0.2));
  } while (std::any_of(sweep.tool.begin(), sweep.tool.end(), flatHull));  // depth() does not know them
  constexpr double kRadius = 0.1;
  sweep.motion.X_MT_start = random.pose(kRadius * random.uniform(0.5, 1.6) * random.direction());
  sweep.motion.X_MT_end = sweep.motion.X_MT_start;
  if (random.chance(0.9)) sweep.motion.X_MT_end.translation() += random.logUniform(1e-4, 0.2) * random.direction();
  sweep.motion.X_MT_end.linear() = random.turn(randomAngle(random)) * sweep.motion.X_MT_start.linear();
  return sweep;
}

}  // namespace sweep_guard_core::soundness
