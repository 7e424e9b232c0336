#include "simulation/elastic/bar_model.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "sweep_guard/common/error.h"

namespace sweep_guard_simulation {

using Eigen::MatrixX3d;
using Eigen::RowVector3d;
using sweep_guard_core::InvalidInput;

namespace {

constexpr int kMaxPivots = 20;
constexpr size_t kMaxAnswers = 32'000'000;  // numbers: 256 MB

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

BarStructure::BarStructure(Eigen::MatrixX3d nodes)
    : rest(std::move(nodes)),
      masses(Eigen::VectorXd::Zero(rest.rows())),
      foundation(Eigen::VectorXd::Zero(rest.rows())),
      fixed(static_cast<size_t>(rest.rows()), false) {}

/// The pressures of a step. They are linear in the displacements of their nodes, so that they are part of the step's
/// linear system; what the nodes answer to them stands in for another matrix.
class BarModel::Yielding {
 public:
  Yielding(const std::vector<Pressure>& pressures, BarModel& model)
      : pressures_(pressures),
        before_(model.positions_),
        slack_(count()),
        compliance_(count(), count()),
        forces_(Eigen::VectorXd::Zero(count())),
        presses_(pressures.size(), true) {
    for (const Pressure& pressure : pressures) answers_.push_back(&model.answerOf(pressure.node));
    for (Eigen::Index i = 0; i < count(); ++i) {
      slack_[i] = 1.0 / of(i).stiffness;
      for (Eigen::Index j = 0; j < count(); ++j) {
        compliance_(i, j) = of(i).outward.dot(of(j).outward) * answer(j)[of(i).node];
      }
    }
    compliance_.diagonal() += slack_;
  }

  /// Moves the nodes from where they were without the pressures.
  void press(MatrixX3d& positions) {
    if (count() == 0) return;
    Eigen::VectorXd free(count());
    for (Eigen::Index i = 0; i < count(); ++i) {
      free[i] = of(i).force * slack_[i] + (positions.row(of(i).node) - before_.row(of(i).node)).dot(of(i).outward);
    }
    solve(free);
    for (Eigen::Index i = 0; i < count(); ++i) {
      if (forces_[i] > 0.0) positions -= answer(i) * (forces_[i] * of(i).outward.transpose());
    }
  }

  const Eigen::VectorXd& forces() const { return forces_; }

 private:
  Eigen::Index count() const { return static_cast<Eigen::Index>(pressures_.size()); }
  const Pressure& of(Eigen::Index i) const { return pressures_[static_cast<size_t>(i)]; }
  const Eigen::VectorXd& answer(Eigen::Index i) const { return *answers_[static_cast<size_t>(i)]; }

  // No pressure pulls: block pivoting [Judice and Pires 1994].
  void solve(const Eigen::VectorXd& free) {
    for (int pivot = 0; pivot < kMaxPivots; ++pivot) {
      forces_ = forcesOf(free);
      const Eigen::VectorXd gaps = compliance_ * forces_ - free;
      bool changed = false;
      for (size_t i = 0; i < presses_.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        if (presses_[i] ? forces_[row] >= 0.0 : gaps[row] >= 0.0) continue;
        presses_[i] = !presses_[i];
        changed = true;
      }
      if (!changed) return;
    }
    forces_ = forces_.cwiseMax(0.0);
  }

  Eigen::VectorXd forcesOf(Eigen::VectorXd right) const {
    Eigen::MatrixXd matrix = compliance_;
    for (size_t i = 0; i < presses_.size(); ++i) {
      if (presses_[i]) continue;
      const auto row = static_cast<Eigen::Index>(i);
      matrix.row(row).setZero();
      matrix.col(row).setZero();
      matrix(row, row) = 1.0;
      right[row] = 0.0;
    }
    return matrix.ldlt().solve(right);
  }

  const std::vector<Pressure>& pressures_;
  const MatrixX3d before_;
  std::vector<const Eigen::VectorXd*> answers_;
  Eigen::VectorXd slack_;       // displacement that takes 1 N off a pressure [m/N]
  Eigen::MatrixXd compliance_;  // distance by which a pressure of 1 N shrinks another one, or itself [m/N]
  Eigen::VectorXd forces_;
  std::vector<bool> presses_;
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
  if (answers_.size() * static_cast<size_t>(positions_.rows()) > kMaxAnswers) answers_.clear();
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

const Eigen::VectorXd& BarModel::answerOf(std::uint32_t node) {
  const auto [answer, first] = answers_.try_emplace(node);
  if (!first) return answer->second;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(positions_.rows());
  if (!structure_.fixed[node]) force[node] = 1.0;
  return answer->second = solver_.solve(force);
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
