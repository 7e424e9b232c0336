#pragma once

#include <Eigen/Geometry>
#include <array>
#include <deque>
#include <optional>
#include <vector>

#include "guard/path_in_mesh.h"
#include "guard/predicted_path_request.h"
#include "guard/swept_body.h"
#include "sweep_guard/guard/sweep.h"

namespace sweep_guard_core {

/// What the tool sweeps in a segment of a predicted path, in mesh frame M, whatever the mesh.
struct SweptSegment {
  PathSegment segment;
  Eigen::AlignedBox3d reach_M;           ///< holds every tool point, with every error that counts [m]
  std::vector<SweptBody> bodies;         ///< the tool as a whole, during each sub-motion
  std::vector<PerHalfSpace> deviations;  ///< of the planes of their volumes; empty: SweptPath::measure() has not run
  UncertainPose end_M;                   ///< pose at the end; set by SweptPath::measure()
  std::array<size_t, 2> halves{};        ///< numbers of the halves; 0: SweptPath::halve() has not run
};

/// The sweeps along a predicted path in a mesh frame M: those of the plan, numbered from 0, and the halves of any that
/// were asked for. A half is swept once, however many workpieces ask for it. Keeps its buffers between paths.
class SweptPath {
 public:
  /// @param max_deviations  errors of more standard deviations do not count
  SweptPath(const SweepOptions& options, double max_deviations) : options_(options), max_deviations_(max_deviations) {}

  /// Sweeps the path of a request, unless the last one went the same way: between two calls of forget() requests differ
  /// only in the workpiece.
  /// @param margin  the tool is grown by this [m], >= 0
  void follow(const PredictedPathRequest& request, double margin);
  void forget() { X_WM_.reset(); }

  const Eigen::AlignedBox3d& reach_M() const { return reach_M_; }  ///< of the whole path

  const SweptSegment& operator[](size_t number) const { return segments_[number]; }
  const SweptSegment& measure(size_t number);  ///< computes the deviations of a segment
  /// Sweeps the halves of a segment; returns their numbers in order of time.
  std::array<size_t, 2> halve(size_t number);
  /// Bounds the volumes of a segment; empty if it has several steps.
  std::optional<UncertainStep> uncertainStep(const PathSegment& segment) const;

 private:
  size_t sweep(const PathSegment& segment);

  SweepOptions options_;
  double max_deviations_;
  PathInMesh path_M_;
  std::optional<Eigen::Isometry3d> X_WM_;  // of a frame that rests; empty: the next path is swept in any case
  double margin_ = 0.0;
  const ConvexShape* tool_ = nullptr;  // of the whole tool
  Eigen::AlignedBox3d reach_M_;
  std::deque<SweptSegment> segments_;  // more than `count_` are buffers to use again
  size_t count_ = 0;
  std::vector<Motion> motions_M_;
};

}  // namespace sweep_guard_core
