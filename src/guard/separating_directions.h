#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "sweep_guard/detection/time_of_impact.h"
#include "sweep_guard/geometry/convex_shape.h"
#include "sweep_guard/geometry/motion.h"
#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_core {

/// Directions that separated a convex piece of the tool from triangles. Tries all of them on a batch of triangles: the piece
/// is evaluated once for each direction, the triangles on the processor's vector units.
class SeparatingDirections {
 public:
  /// Begins a motion, before all other calls. The directions of the one before stay.
  /// @param sub_motions  as for timeOfImpact(); must outlive the calls of add() that follow, like the shape
  /// @param margin       [m], >= 0
  void begin(const ConvexShape& shape_T, const std::vector<Motion>& sub_motions, double margin);

  /// Adds a unit direction from a triangle to the piece; beyond simd::kMaxDirections it replaces the oldest.
  void add(const Eigen::Vector3d& direction_M);

  /// Puts a triangle into the batch.
  /// @param place  below simd::kBatch
  void load(std::size_t place, const MovingTriangle& triangle_M, bool moved);

  /// Tries the directions on the triangles of the batch. Places without a triangle have unspecified results.
  void separate();

  /// Returns whether a direction proves that the piece is farther than the margin from the triangle: anywhere in the hull
  /// of its poses, from the hull of the triangle before and after its motion.
  bool separated(std::size_t place) const { return gaps_.gap[place] > rounding_[place]; }

  /// Returns the direction with the largest gap; zero if there is none.
  Eigen::Vector3d best_M(std::size_t place) const;

 private:
  double leastAlong(const Eigen::Vector3d& direction_M) const;
  void set(std::size_t i, const Eigen::Vector3d& direction_M);

  const ConvexShape* shape_T_ = nullptr;
  const std::vector<Motion>* sub_motions_ = nullptr;
  double margin_ = 0.0;                                 // with the deviation of arcs
  Eigen::Vector3d origin_M_ = Eigen::Vector3d::Zero();  // of the positions in the batch
  double rounding_of_poses_ = 0.0;
  simd::Directions directions_;
  std::size_t oldest_ = 0;
  simd::TriangleBatch batch_ = {};
  simd::BatchGaps gaps_ = {};
  std::array<double, simd::kBatch> rounding_ = {};
};

}  // namespace sweep_guard_core
