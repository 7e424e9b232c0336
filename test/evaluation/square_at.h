#pragma once

#include "common/rotation_between.h"
#include "evaluation/square_obstacle.h"

namespace sweep_guard_evaluation {

/// Returns a square with this center and normal.
inline SquareObstacle squareAt(const Eigen::Vector3d& center, const Eigen::Vector3d& normal, double half_side) {
  SquareObstacle square;
  square.half_side = half_side;
  square.X_WS.translation() = center;
  square.X_WS.linear() = sweep_guard_core::rotationBetween(Eigen::Vector3d::UnitZ(), normal).toRotationMatrix();
  return square;
}

}  // namespace sweep_guard_evaluation
