#pragma once

#include <array>
#include <optional>
#include <vector>

#include "soundness/body.h"
#include "soundness/cases.h"

namespace sweep_guard_core::soundness {

/// The exact motion of a tool at 1 025 poses, evenly spaced in time, against triangles: where a point of a triangle
/// lies in the tool at one of them, by the analytic description of its bodies, the triangle is met for certain. Tried
/// are the corners, the centre, and points found by going back and forth between the triangle and the nearest points of
/// the tool. Poses at which the tool is too far away, going by how far it can get in between, are passed over.
class SampledSweep {
 public:
  static constexpr int kSteps = 1024;

  /// @param sweep  without a moving frame
  explicit SampledSweep(const SweepCase& sweep);

  /// Empty if some point of the triangle is in the tool at some pose. Or else how far they are apart at least during
  /// all of the motion, between the poses too; not positive if they may touch [m].
  std::optional<Real> apart(const std::array<Eigen::Vector3d, 3>& corners_M) const;

  /// Whether a part of the tool, which touches nothing, ends inside of these triangles: they wind around it.
  bool endsWithin(const Triangles& triangles) const;

 private:
  struct Pose {
    Matrix3r R_TM;
    Vector3r p_M;
  };
  // How far a body is apart at least; empty if they meet.
  std::optional<Real> apartAt(const Pose& pose, const Body& body, const std::array<Vector3r, 3>& corners_M) const;

  const Bodies& tool_;
  std::vector<Pose> poses_;
  Real way_;    // of the tool's origin
  Real angle_;  // of the tool
  Real slack_;  // what is in the tool by less is not certain
};

/// A tool that moves about a wavy hull of 1 600 triangles, with rotations up to half a turn; swept by any kind of
/// volume.
SweepCase randomWholeSweep(std::uint64_t seed);

}  // namespace sweep_guard_core::soundness
