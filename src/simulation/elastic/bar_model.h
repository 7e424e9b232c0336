#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "simulation/elastic/sparse_solver.h"

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

  /// Makes nodes without masses, springs or bars; all of them may move.
  explicit BarStructure(Eigen::MatrixX3d nodes);
};

/// A force on a node that yields as the node gives way.
struct Pressure {
  std::uint32_t node;
  Eigen::Vector3d outward;  ///< unit; the node is pressed against it
  double force;             ///< with the node where it is at the start of the step [N], >= 0
  double stiffness;         ///< growth of the force per outward displacement of the node [N/m], > 0
};

/// Moves a structure of bars by implicit Euler steps. The stiffness of a bar does not depend on its length or
/// direction, so large rotations and strains, inertia and buckling are included. A step minimizes
///   sum m |x - x_0 - h v_0|^2 / 2 h^2 + sum k (|x_a - x_b| - l)^2 / 2 - f . x
/// by a local/global method [Liu et al. 2013]: alternates between the directions of the bars and one linear
/// system, factorized once, for all positions. Each iteration decreases the sum.
class BarModel {
 public:
  struct Options {
    double step = 1.0 / 60.0;  ///< h [s], > 0; infinity: each step finds the equilibrium, without masses
    double damping = 0.0;      ///< share of the velocity that is lost per time, besides that of the method [1/s], >= 0
    int iterations = 5;        ///< per step, >= 1
  };

  /// @throws sweep_guard_core::InvalidInput if a part of the structure is not held, or an option or a bar is out of
  ///     range, or as SparseSolver
  BarModel(BarStructure structure, const Options& options);

  /// Moves on by a step. The first pressure on a node takes one more right-hand side.
  /// @param loads      on each node [N]
  /// @param pressures  at the positions before the step
  void advance(const Eigen::MatrixX3d& loads, const std::vector<Pressure>& pressures = {});

  const Eigen::MatrixX3d& positions() const { return positions_; }  ///< [m]
  const Eigen::VectorXd& forces() const { return forces_; }         ///< of the pressures of the last step [N]
  void setVelocities(const Eigen::MatrixX3d& velocities) { velocities_ = velocities; }  ///< [m/s]

  const BarStructure& structure() const { return structure_; }
  double elasticEnergy() const;  ///< [J]
  double kineticEnergy() const;  ///< [J]

 private:
  class Yielding;

  const Eigen::VectorXd& answerOf(std::uint32_t node);
  Eigen::SparseMatrix<double> makeMatrix() const;
  Eigen::MatrixX3d heldRight() const;
  void addBars(Eigen::MatrixX3d& right) const;
  void startAhead();

  BarStructure structure_;
  Options options_;
  std::vector<double> lengths_;  // of the bars at rest [m]
  Eigen::VectorXd inertia_;      // m / h^2 [N/m]
  SparseSolver solver_;
  Eigen::MatrixX3d held_;  // forces of the foundation, and of bars to fixed nodes, in the global step [N]
  Eigen::MatrixX3d positions_;
  Eigen::MatrixX3d velocities_;
  Eigen::VectorXd forces_;
  std::map<std::uint32_t, Eigen::VectorXd> answers_;  // of all nodes to 1 N on a node in the global step [m/N]
};

}  // namespace sweep_guard_simulation
