#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "evaluation/square_obstacle.h"
#include "sweep_guard/geometry/separation.h"
#include "sweep_guard/guard/sweep.h"
#include "sweep_guard/motion/proximity_finder.h"

namespace sweep_guard_evaluation {

/// A tool, and a square whose frame M may move. Computes what a guard learns of both and, independently of it, how far
/// apart they are and whether they touch.
class LoopScene {
 public:
  /// @param square  in M
  LoopScene(const sweep_guard_core::Tool& tool, const SquareObstacle& square);

  const sweep_guard_core::Tool& tool() const { return tool_; }
  const std::array<Eigen::Vector3d, 4>& corners_M() const { return corners_M_; }
  Eigen::Vector3d normal_M() const;  ///< of the square, unit

  /// Returns the separation of a piece of the tool; its points are in M.
  sweep_guard_core::Separation separationAt(const Eigen::Isometry3d& X_MT, size_t piece) const;
  /// Returns that of the nearest piece.
  sweep_guard_core::Separation separationAt(const Eigen::Isometry3d& X_MT) const;

  /// Returns the first step of a path in which the tool touches the square. It sweeps: between two poses of the path the
  /// tool moves as a sweep_guard_core::Motion. Empty: it does not touch.
  /// @param gaps_M  those of separationAt() at the poses; steps whose ends are farther than kSwept are not swept
  std::optional<size_t> firstContact(const std::vector<Eigen::Isometry3d>& path_MT, const std::vector<double>& gaps);

  /// Returns the planes that a guard publishes at a pose.
  /// @param stamp  later than that of the last call; else call startAgain() first
  const sweep_guard_core::Proximity& proximityAt(const Eigen::Isometry3d& X_WT, const Eigen::Isometry3d& X_WM,
                                                 sweep_guard_core::Time stamp, double reach);
  void startAgain() { finder_.reset(); }

  static constexpr double kSwept = 0.02;  ///< [m] more than a tool point moves in one step

 private:
  sweep_guard_core::Tool tool_;
  sweep_guard_core::Workpieces workpieces_;
  std::array<Eigen::Vector3d, 4> corners_M_;
  std::unique_ptr<sweep_guard_core::Detector> detector_;
  sweep_guard_core::ProximityFinder finder_;
  sweep_guard_core::Proximity proximity_;
};

}  // namespace sweep_guard_evaluation
