#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sweep_guard/detection/box_coordinates.h"
#include "sweep_guard/geometry/swept_volume.h"
#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/geometry/triangle_mesh.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard {

/// A contact that takes more standard deviations is left out of account: its probability is below 0.001.
constexpr double kMostDeviations = 3.09;

/// Probability that a tool whose path is uncertain meets something that its volume would meet if every plane were moved
/// out by this many standard deviations: the Gaussian integral Phi(-deviations), and 0 beyond kMostDeviations. It is
/// the probability of one plane being wrong by so much; that of a wall is exact, that of a corner an upper bound as
/// long as the planes err independently.
double contactProbability(double deviations);

/// How far each plane of a swept volume may be off, in the order of halfSpaces_B(): the standard deviation [m], along
/// the plane's normal, of the tool point that touches it. A point at r from the tool's origin moves along n by n·dx +
/// (r x n)·dtheta. At least 1e-9 m.
/// @param X_MT        pose of the tool that the covariance is of
/// @param covariance  translation [m], then rotation vector [rad], both along the axes of M
std::vector<double> planeDeviations(const Tool& tool, const Eigen::Isometry3d& X_MT, const Matrix6d& covariance_M,
                                    const SweptVolume& swept_M);

/// What stands between a volume and a mesh.
struct Clearance {
  bool separated = true;  ///< each triangle lies wholly beyond one plane of the volume: nothing is met
  double deviations =
      0.0;  ///< how many standard deviations the planes must be moved out to meet it; negative: moved in
};

/// Measures the clearance of an uncertain volume. Keeps its buffers between calls.
class ClearanceMeter {
 public:
  /// Empty if more than kMostDeviations are needed. Exact to 1e-3 standard deviations; not below -kMostDeviations.
  /// @param deviations  of planeDeviations()
  std::optional<Clearance> operator()(const TriangleMesh& mesh_M, const SweptVolume& swept_M,
                                      const std::vector<double>& deviations);

 private:
  struct Candidate {
    std::uint32_t triangle;
    double at_least;  // deviations
    double at_most;   // deviations
  };

  void scoreVertices(const TriangleMesh& mesh_M, const BoxCoordinates& coordinates,
                     const std::vector<HalfSpace>& half_spaces_B, const std::vector<double>& deviations);
  void collectCandidates(const TriangleMesh& mesh_M, size_t planes);
  Polygon within(double z, Polygon polygon_B, const Triangle& triangle, const std::vector<HalfSpace>& half_spaces_B,
                 const std::vector<double>& deviations) const;

  std::vector<double> scores_;         // per vertex and plane: deviations that the plane lacks to reach the vertex
  std::vector<std::uint16_t> beyond_;  // per vertex: one bit for each plane that lacks too many
  std::vector<Candidate> candidates_;
};

}  // namespace sweep_guard
