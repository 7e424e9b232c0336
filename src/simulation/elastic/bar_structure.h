#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace sweep_guard_simulation {

/// An elastic bar between two nodes. It has its rest length where the nodes are at rest.
struct Bar {
  std::array<std::uint32_t, 2> nodes;
  double stiffness;  ///< force per elongation [N/m], > 0
};

/// Nodes at rest that bars connect.
struct BarStructure {
  Eigen::MatrixX3d rest;       ///< a row for each node [m]
  Eigen::VectorXd masses;      ///< of the nodes [kg], >= 0
  Eigen::VectorXd foundation;  ///< stiffness of the spring from each node to its place at rest [N/m]; 0: none
  std::vector<bool> fixed;     ///< nodes that do not move
  std::vector<Bar> bars;

  /// Makes nodes without masses, springs or bars, that all may move.
  explicit BarStructure(Eigen::MatrixX3d nodes);
};

}  // namespace sweep_guard_simulation
