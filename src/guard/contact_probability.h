#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "detection/culler.h"
#include "guard/intended_contact.h"
#include "guard/triangle_set.h"
#include "sweep_guard/geometry/swept_volume.h"
#include "sweep_guard/geometry/triangle_mesh.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

/// Contacts at more standard deviations are always ignored: their probability is below 0.001.
constexpr double kMaxDeviations = 3.09;

/// Returns the probability that a tool on an uncertain path meets something that is `deviations` standard deviations
/// from the volume's planes (Clearance): the Gaussian integral Phi(-deviations), and 0 beyond kMaxDeviations. This is
/// the probability that one plane errs by that much, which is exact for a wall. For an edge or a corner it is too
/// large, for only the planes of the volume are used, though another direction might separate more. Of several sweeps
/// or triangles the largest probability counts, not that of their union.
double contactProbability(double deviations);

/// Computes how much each plane of a swept volume may err, in the order of halfSpaces_B(): the standard deviation [m],
/// along the plane's normal, of the body's point that touches the plane. A point at r from the tool's origin moves
/// along n by n·dx + (r x n)·dtheta. If a side of the body faces the plane, either of its ends may touch: returns an
/// upper bound for errors of up to kMaxDeviations; for a hull of points, that of the box around the hull. At least 1e-9
/// m.
/// @param X_MT        pose of the tool that errs
/// @param covariance  of its error: translation [m], then rotation vector [rad], both along the axes of M
PerHalfSpace planeDeviations(const ConvexShape& shape, const Eigen::Isometry3d& X_MT, const Matrix6d& covariance_M,
                             const SweptVolume& swept_M);

/// The clearance between a volume and a mesh.
struct Clearance {
  bool separated = true;  ///< each triangle lies wholly beyond one plane of the volume, so none is met
  /// Number of standard deviations by which the planes must be moved out to meet the mesh. Negative if the volume meets
  /// it: the tool must stay back by as many along one of the planes' normals to be free.
  double deviations = 0.0;
};

/// Measures the clearance of an uncertain volume. Keeps its buffers between calls.
class ClearanceMeter {
 public:
  /// @param max_deviations  larger clearances are not measured; at most kMaxDeviations
  explicit ClearanceMeter(double max_deviations = kMaxDeviations, const simd::Kernels& kernels = simd::kernels());

  /// Returns empty if the clearance exceeds the largest one to measure. Exact to 1e-3 standard deviations; at least
  /// -kMaxDeviations. Looks first at the block of vertices that may be nearest, so that few triangles are compared.
  /// @param submesh      other triangles are not tested
  /// @param deviations   from planeDeviations()
  /// @param intended     triangles that are not tested either; null: none
  /// @param at_most      >= 0; larger clearances are not measured either, unless there is a triangle that no plane
  ///     separates
  std::optional<Clearance> measure(const Submesh& submesh, const SweptVolume& swept_M, const PerHalfSpace& deviations,
                                   IntendedTriangles* intended = nullptr, double at_most = kMaxDeviations);

  /// Returns whether measure() would find a clearance. Takes a fraction of its time.
  bool isNear(const Submesh& submesh, const SweptVolume& swept_M, const PerHalfSpace& deviations,
              IntendedTriangles* intended = nullptr);

  /// Returns true if isNear() would, and also if a vertex is near that belongs to no triangle of the submesh. Takes a
  /// fraction of its time.
  bool mayBeNear(const Submesh& submesh, const SweptVolume& swept_M, const PerHalfSpace& deviations);

  /// Returns whether single planes of the volume, moved out by some deviations, separate each triangle from it: then measure()
  /// finds nothing up to so many, and neither does it with more planes. Takes a fraction of its time.
  /// @param by  >= 0
  bool isSeparated(const Submesh& submesh, const SweptVolume& swept_M, const PerHalfSpace& deviations, double by);

  /// Returns the triangles that no plane of the volume separates from it: each once, in no particular order. The volume meets no
  /// other triangles. Valid until the next call.
  const std::vector<std::uint32_t>& notSeparated(const Submesh& submesh, const SweptVolume& swept_M);

 private:
  struct NearTriangle {
    std::uint32_t triangle;
    double at_least;  // deviations
    double at_most;   // deviations
  };
  struct Planes;
  using Corners = std::array<Eigen::Vector3d, 3>;  // relative to the origin of the mesh

  double reachOfVertices(const Submesh& submesh, const SweptVolume& swept_M, const PerHalfSpace& sigmas, double at_most,
                         double enough);
  const std::vector<RemainingTriangle>& within(double reach, const Submesh& submesh, const SweptVolume& swept_M,
                                               PerHalfSpace sigmas);
  void collectCandidates(const std::vector<RemainingTriangle>& remaining, double reach, const Planes& planes,
                         IntendedTriangles* intended);
  std::optional<Clearance> nearestWithin(double reach, const Planes& planes) const;
  static bool reaches(double z, const Corners& corners, const Planes& planes);
  static double deviationsTo(double nearest, const NearTriangle& candidate, const Planes& planes);

  double max_deviations_;
  const simd::Kernels* kernels_;
  Culler culler_;
  std::vector<float> scores_;  // of blocks
  std::vector<std::uint32_t> near_blocks_;
  std::vector<NearTriangle> candidates_;  // ascending by at_least
  std::vector<std::uint32_t> not_separated_;
};

}  // namespace sweep_guard_core
