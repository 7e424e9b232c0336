#include "simulation/elastic/bar_model.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>

#include "sweep_guard/common/error.h"

namespace sweep_guard_simulation {

using Eigen::MatrixX3d;
using Eigen::RowVector3d;
using sweep_guard_core::InvalidInput;

namespace {

constexpr int kMaxPivots = 100;

const BarModel::Options& checked(const BarModel::Options& options) {
  if (!(options.step > 0.0)) throw InvalidInput("the time step must be above 0 s");
  if (!(options.damping >= 0.0)) throw InvalidInput("the damping must be 0 1/s or more");
  if (options.iterations < 1) throw InvalidInput("a step needs at least one iteration");
  return options;
}

std::vector<double> lengthsOf(const BarStructure& structure) {
  const auto count = static_cast<std::uint32_t>(structure.rest.rows());
  std::vector<double> lengths;
  for (const auto& [nodes, stiffness] : structure.bars) {
    const std::uint32_t last = std::max(nodes[0], nodes[1]);
    if (last >= count) throw InvalidInput("there is no node " + std::to_string(last) + ", which a bar has");
    if (!(stiffness > 0.0 && std::isfinite(stiffness)))
      throw InvalidInput("the stiffness of a bar must be above 0 N/m");
    lengths.push_back((structure.rest.row(nodes[0]) - structure.rest.row(nodes[1])).norm());
  }
  return lengths;
}

}  // namespace

/// The pressures of a step. They are linear in the displacement of their nodes, so that they are part of the step's
/// linear system. In place of another matrix they take one more right-hand side each.
class BarModel::Yielding {
 public:
  Yielding(const std::vector<Pressure>& pressures, const BarModel& model)
      : pressures_(pressures), before_(model.positions_), forces_(Eigen::VectorXd::Zero(count())) {
    for (const Pressure& pressure : pressures) {
      Eigen::VectorXd shares = Eigen::VectorXd::Zero(before_.rows());
      for (const auto& [node, share] : pressure.shares) shares[node] = model.structure_.fixed[node] ? 0.0 : share;
      answers_.push_back(model.solver_.solve(shares));
    }
    compliance_.resize(count(), count());
    slack_.resize(count());
    for (Eigen::Index i = 0; i < count(); ++i) {
      slack_[i] = 1.0 / of(i).stiffness;
      for (Eigen::Index j = 0; j < count(); ++j)
        compliance_(i, j) = of(i).outward.dot(of(j).outward) * mean(i, answer(j));
    }
  }

  /// Moves the nodes from where they were without the pressures.
  void press(MatrixX3d& positions) {
    if (count() == 0) return;
    Eigen::VectorXd free(count());
    for (Eigen::Index i = 0; i < count(); ++i) {
      free[i] = of(i).force * slack_[i] + mean(i, (positions - before_) * of(i).outward);
    }
    solve(free);
    for (Eigen::Index i = 0; i < count(); ++i) positions -= forces_[i] * answer(i) * of(i).outward.transpose();
  }

  const Eigen::VectorXd& forces() const { return forces_; }

 private:
  Eigen::Index count() const { return static_cast<Eigen::Index>(pressures_.size()); }
  const Pressure& of(Eigen::Index i) const { return pressures_[static_cast<size_t>(i)]; }
  const Eigen::VectorXd& answer(Eigen::Index i) const { return answers_[static_cast<size_t>(i)]; }

  double mean(Eigen::Index i, const Eigen::VectorXd& values) const {
    double sum = 0.0;
    for (const auto& [node, share] : of(i).shares) sum += share * values[node];
    return sum;
  }

  // No pressure pulls: least-index pivoting [Murty 1974].
  void solve(const Eigen::VectorXd& free) {
    const Eigen::MatrixXd matrix = compliance_ + Eigen::MatrixXd(slack_.asDiagonal());
    std::vector<bool> presses(pressures_.size(), true);
    for (int pivot = 0; pivot < kMaxPivots; ++pivot) {
      forces_ = forcesOf(matrix, free, presses);
      const Eigen::VectorXd gaps = matrix * forces_ - free;
      size_t i = 0;
      while (i < presses.size() && (presses[i] ? forces_[index(i)] >= 0.0 : gaps[index(i)] >= 0.0)) ++i;
      if (i == presses.size()) return;
      presses[i] = !presses[i];
    }
    forces_ = forces_.cwiseMax(0.0);
  }

  static Eigen::VectorXd forcesOf(Eigen::MatrixXd matrix, Eigen::VectorXd right, const std::vector<bool>& presses) {
    for (size_t i = 0; i < presses.size(); ++i) {
      if (presses[i]) continue;
      matrix.row(index(i)).setZero();
      matrix(index(i), index(i)) = 1.0;
      right[index(i)] = 0.0;
    }
    return matrix.partialPivLu().solve(right);
  }

  static Eigen::Index index(size_t i) { return static_cast<Eigen::Index>(i); }

  const std::vector<Pressure>& pressures_;
  const MatrixX3d before_;
  std::vector<Eigen::VectorXd> answers_;  // displacement of the nodes by a force of 1 N [m/N]
  Eigen::MatrixXd compliance_;            // displacement at a pressure by another one [m/N]
  Eigen::VectorXd slack_;                 // displacement that takes 1 N off a pressure [m/N]
  Eigen::VectorXd forces_;
};

BarModel::BarModel(BarStructure structure, const Options& options)
    : structure_(std::move(structure)),
      options_(checked(options)),
      lengths_(lengthsOf(structure_)),
      inertia_(structure_.masses * ((1.0 / options.step + options.damping) / options.step)),
      solver_(makeMatrix()),
      held_(heldRight()),
      positions_(structure_.rest),
      velocities_(MatrixX3d::Zero(structure_.rest.rows(), 3)) {}

Eigen::SparseMatrix<double> BarModel::makeMatrix() const {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < structure_.rest.rows(); ++i) {
    const bool fixed = structure_.fixed[static_cast<size_t>(i)];
    entries.emplace_back(i, i, fixed ? 1.0 : inertia_[i] + structure_.foundation[i]);
  }
  for (const auto& [nodes, stiffness] : structure_.bars) {
    const auto [a, b] = nodes;
    if (!structure_.fixed[a]) entries.emplace_back(a, a, stiffness);
    if (!structure_.fixed[b]) entries.emplace_back(b, b, stiffness);
    if (!structure_.fixed[a] && !structure_.fixed[b]) entries.emplace_back(std::max(a, b), std::min(a, b), -stiffness);
  }
  Eigen::SparseMatrix<double> matrix(structure_.rest.rows(), structure_.rest.rows());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

MatrixX3d BarModel::heldRight() const {
  MatrixX3d right = structure_.foundation.asDiagonal() * structure_.rest;
  for (const auto& [nodes, stiffness] : structure_.bars) {
    const auto [a, b] = nodes;
    if (structure_.fixed[b]) right.row(a) += stiffness * structure_.rest.row(b);
    if (structure_.fixed[a]) right.row(b) += stiffness * structure_.rest.row(a);
  }
  return right;
}

void BarModel::advance(const MatrixX3d& loads, const std::vector<Pressure>& pressures) {
  const MatrixX3d before = positions_;
  const MatrixX3d constant =
      held_ + loads + inertia_.asDiagonal() * before + (structure_.masses / options_.step).asDiagonal() * velocities_;
  Yielding yielding(pressures, *this);
  startAhead();
  MatrixX3d right;
  for (int i = 0; i < options_.iterations; ++i) {
    right = constant;
    addBars(right);
    positions_ = solver_.solve(right);
    yielding.press(positions_);
  }
  velocities_ = (positions_ - before) / options_.step;
  forces_ = yielding.forces();
}

void BarModel::startAhead() {
  if (std::isinf(options_.step)) return;
  for (Eigen::Index i = 0; i < positions_.rows(); ++i) {
    if (!structure_.fixed[static_cast<size_t>(i)]) positions_.row(i) += options_.step * velocities_.row(i);
  }
}

void BarModel::addBars(MatrixX3d& right) const {
  for (size_t i = 0; i < structure_.bars.size(); ++i) {
    const auto& [nodes, stiffness] = structure_.bars[i];
    const RowVector3d along = positions_.row(nodes[0]) - positions_.row(nodes[1]);
    const double length = along.norm();
    if (!(length > 0.0)) continue;
    const RowVector3d force = stiffness * lengths_[i] / length * along;
    right.row(nodes[0]) += force;
    right.row(nodes[1]) -= force;
  }
  for (size_t i = 0; i < structure_.fixed.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (structure_.fixed[i]) right.row(row) = structure_.rest.row(row);
  }
}

double BarModel::elasticEnergy() const {
  double energy = 0.5 * structure_.foundation.dot((positions_ - structure_.rest).rowwise().squaredNorm());
  for (size_t i = 0; i < structure_.bars.size(); ++i) {
    const auto& [nodes, stiffness] = structure_.bars[i];
    const double length = (positions_.row(nodes[0]) - positions_.row(nodes[1])).norm();
    energy += 0.5 * stiffness * std::pow(length - lengths_[i], 2);
  }
  return energy;
}

double BarModel::kineticEnergy() const { return 0.5 * structure_.masses.dot(velocities_.rowwise().squaredNorm()); }

}  // namespace sweep_guard_simulation
