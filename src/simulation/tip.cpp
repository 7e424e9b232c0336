#include "simulation/tip.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/rotation_between.h"

namespace sweep_guard_simulation {
namespace {

using Eigen::Vector3d;
using sweep_guard_core::ConvexPiece;

constexpr int kDirections = 8;  // in opposite pairs
constexpr double kTilt = 1e-3;

}  // namespace

Vector3d frontOf(const sweep_guard_core::Tool& tool, const Vector3d& direction_T) {
  const auto reach = [&](const ConvexPiece& piece) { return piece.shape_T.support(direction_T); };
  const auto front = std::max_element(tool.pieces().begin(), tool.pieces().end(),
                                      [&](const ConvexPiece& a, const ConvexPiece& b) { return reach(a) < reach(b); });
  const auto turned = sweep_guard_core::rotationBetween(Vector3d::UnitZ(), direction_T);
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * M_PI * (i + 0.5) / kDirections;
    const Vector3d tilted(kTilt * std::cos(angle), kTilt * std::sin(angle), 1.0);
    sum += front->shape_T.supportPoint(turned * tilted.normalized());
  }
  return sum / kDirections;
}

Vector3d tipOf(const sweep_guard_core::Tool& tool) { return frontOf(tool, Vector3d::UnitZ()); }

double radialExtent(const sweep_guard_core::Tool& tool) {
  const Vector3d tip = tipOf(tool);
  const Eigen::Vector2d lowest = (tool.bounds_T().min() - tip).head<2>().cwiseAbs();
  const Eigen::Vector2d highest = (tool.bounds_T().max() - tip).head<2>().cwiseAbs();
  return lowest.cwiseMax(highest).norm();
}

}  // namespace sweep_guard_simulation
