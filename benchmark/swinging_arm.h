#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "sweep_guard/kinematics/robot_path.h"

namespace sweep_guard_benchmark {

using namespace sweep_guard_core;

constexpr size_t kLinks = 7;
constexpr size_t kPieces = 20;    // of a link
constexpr double kLength = 0.15;  // of a link [m]

/// A link is a tube of staves around z, in two halves.
inline std::vector<ConvexPiece> piecesOf(const std::string& link) {
  std::vector<ConvexPiece> pieces;
  for (size_t i = 0; i < kPieces; ++i) {
    const double angle = 4.0 * M_PI * static_cast<double>(i) / kPieces;
    const double z = (i < kPieces / 2 ? 0.25 : 0.75) * kLength;
    const Eigen::Isometry3d X = Eigen::Translation3d(0.0, 0.0, z) * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()) *
                                Eigen::Translation3d(0.03, 0.0, 0.0);
    pieces.push_back({link, ConvexShape::box({0.005, 0.012, 0.25 * kLength}).placed(X)});
  }
  return pieces;
}

/// Returns an arm of 7 links in a row.
inline Robot arm() {
  std::vector<JointVariable> variables(kLinks);
  std::vector<TreeLink> links(kLinks);
  std::vector<std::pair<size_t, std::vector<ConvexPiece>>> pieces;
  for (size_t i = 0; i < kLinks; ++i) {
    variables[i].name = "joint" + std::to_string(i);
    links[i].name = "link" + std::to_string(i);
    links[i].type = JointType::kRevolute;
    links[i].variable = i;
    links[i].axis_J = i % 2 == 0 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY();
    if (i > 0) links[i].parent = i - 1;
    if (i > 0) links[i].X_PJ.translation().z() = kLength;
    pieces.emplace_back(i, piecesOf(links[i].name));
  }
  return robotOf({std::move(variables), std::move(links)}, pieces);
}

/// Returns the state at a time [s]. Every joint swings at up to 1 rad/s, each in a time of its own.
inline RobotState stateAt(double t) {
  RobotState state;
  for (size_t i = 0; i < kLinks; ++i) {
    const double rate = 1.0 + 0.2 * static_cast<double>(i);  // [rad/s]
    state.positions.push_back((i % 2 == 0 ? 0.0 : 0.2) + std::sin(rate * t) / rate);
  }
  return state;
}

}  // namespace sweep_guard_benchmark
