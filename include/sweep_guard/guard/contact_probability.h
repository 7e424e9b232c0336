#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sweep_guard/detection/culler.h"
#include "sweep_guard/geometry/swept_volume.h"
#include "sweep_guard/geometry/triangle_mesh.h"
#include "sweep_guard/guard/triangle_set.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

/// A contact that takes more standard deviations is left out of account: its probability is below 0.001.
constexpr double kMaxDeviations = 3.09;

/// Probability that a tool whose path is uncertain meets something that is so many standard deviations of the volume's
/// planes away (Clearance): the Gaussian integral Phi(-deviations), and 0 beyond kMaxDeviations. It is the probability
/// of one plane being wrong by so much: exact for a wall. Only the planes of the volume are looked at, though another
/// direction might separate more: for an edge or a corner it is rather too large. And of several sweeps or triangles
/// the largest counts, not their union.
double contactProbability(double deviations);

/// How far each plane of a swept volume may be off, in the order of halfSpaces_B(): the standard deviation [m], along
/// the plane's normal, of the point of the body that touches it. A point at r from the tool's origin moves along n by
/// n·dx + (r x n)·dtheta. Where the body's side faces the plane, either end of it may come to touch: a bound from above
/// for errors of up to kMaxDeviations, of a hull of points that of the box around it. At least 1e-9 m.
/// @param X_MT        pose of the tool that the covariance is of
/// @param covariance  translation [m], then rotation vector [rad], both along the axes of M
PerHalfSpace planeDeviations(const ConvexShape& shape, const Eigen::Isometry3d& X_MT, const Matrix6d& covariance_M,
                             const SweptVolume& swept_M);

/// What stands between a volume and a mesh.
struct Clearance {
  bool separated = true;  ///< each triangle lies wholly beyond one plane of the volume: nothing is met
  /// How many standard deviations the planes must be moved out to meet it. Negative where the volume meets it as it is:
  /// so many must the tool stay back along one of the planes' normals to be free of it.
  double deviations = 0.0;
};

/// Measures the clearance of an uncertain volume. Keeps its buffers between calls.
class ClearanceMeter {
 public:
  /// Empty if more than kMaxDeviations are needed. Exact to 1e-3 standard deviations; not below -kMaxDeviations.
  /// @param part        of the mesh: no other triangles are looked at
  /// @param deviations  of planeDeviations()
  std::optional<Clearance> measure(const Submesh& part, const SweptVolume& swept_M, const PerHalfSpace& deviations);

  /// The triangles that no plane of the volume measured last separates from it: ascending. The volume meets no others.
  /// Valid until the next call.
  const TriangleSet& notSeparated();

 private:
  struct Candidate {
    size_t number;    // of the candidate
    double at_least;  // deviations
    double at_most;   // deviations
  };
  struct Planes;

  void scoreCorners(const Planes& planes);
  void collectCandidates(const Planes& planes);
  bool reaches(double z, const Candidate& candidate, const Planes& planes) const;
  double outwards(double nearest, const Candidate& candidate, const Planes& planes) const;

  Culler culler_;
  const std::vector<RemainingTriangle>* remaining_ = nullptr;  // of it: within kMaxDeviations of each plane
  std::vector<double> scores_;         // per candidate, corner and plane: deviations that the plane lacks to reach it
  std::vector<Candidate> candidates_;  // ascending by at_least
  TriangleSet not_separated_;
};

}  // namespace sweep_guard_core
