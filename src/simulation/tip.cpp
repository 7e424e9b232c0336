#include "simulation/tip.h"

#include <algorithm>
#include <cmath>

namespace sweep_guard_simulation {
namespace {

using Eigen::Vector3d;
using sweep_guard_core::ConvexPiece;

constexpr int kDirections = 8;  // in opposite pairs
constexpr double kTilt = 1e-3;

}  // namespace

Vector3d tipOf(const sweep_guard_core::Tool& tool) {
  const auto reach = [](const ConvexPiece& piece) { return piece.shape_T.support(Vector3d::UnitZ()); };
  const auto front = std::max_element(tool.pieces().begin(), tool.pieces().end(),
                                      [&](const ConvexPiece& a, const ConvexPiece& b) { return reach(a) < reach(b); });
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * M_PI * (i + 0.5) / kDirections;
    sum += front->shape_T.supportPoint(Vector3d(kTilt * std::cos(angle), kTilt * std::sin(angle), 1.0).normalized());
  }
  return sum / kDirections;
}

double radialExtent(const sweep_guard_core::Tool& tool) {
  const Vector3d tip = tipOf(tool);
  const Eigen::Vector2d lowest = (tool.bounds_T().min() - tip).head<2>().cwiseAbs();
  const Eigen::Vector2d highest = (tool.bounds_T().max() - tip).head<2>().cwiseAbs();
  return lowest.cwiseMax(highest).norm();
}

}  // namespace sweep_guard_simulation
