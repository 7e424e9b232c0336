#pragma once

#include <array>
#include <optional>
#include <vector>

#include "soundness/body.h"
#include "soundness/cases.h"

namespace sweep_guard_core::soundness {

/// Compares triangles with the exact motion of a tool at 1 025 poses, evenly spaced in time. A triangle is certainly
/// met if one of its points lies in the tool at one pose, by the analytic description of the bodies. It tries the
/// corners, the center, and alternating nearest points of triangle and tool. It skips poses that are too far away, by a
/// bound on the tool's speed.
class SampledSweep {
 public:
  static constexpr int kSteps = 1024;

  /// @param sweep  without a moving frame
  explicit SampledSweep(const SweepCase& sweep);

  /// Returns a lower bound of the distance during the whole motion [m], between the poses too; not positive if triangle
  /// and tool may touch. Empty if a point of the triangle is in the tool at one pose.
  std::optional<Real> distance(const std::array<Eigen::Vector3d, 3>& corners_M) const;

  /// Returns whether a piece of the tool, which must touch nothing, ends inside the triangles, by their winding number.
  bool endsInside(const Triangles& triangles) const;

 private:
  struct Pose {
    Matrix3r R_TM;
    Vector3r p_M;
  };
  // Lower bound of the distance; empty if they meet.
  std::optional<Real> distanceAt(const Pose& pose, const Body& body, const std::array<Vector3r, 3>& corners_M) const;

  const Bodies& tool_;
  std::vector<Pose> poses_;
  Real length_;     // of the path of the tool's origin
  Real angle_;      // of the tool
  Real tolerance_;  // a point less deep than this may be outside
};

/// Returns a tool that moves around a wavy hull of 1 600 triangles and turns by up to half a turn; a random kind of
/// volume.
SweepCase randomWholeSweep(std::uint64_t seed);

}  // namespace sweep_guard_core::soundness
