#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

namespace sweep_guard_simulation {

/// Solves linear equations with one sparse symmetric positive definite matrix and many right-hand sides: factorizes it
/// once as L D L^T.
class SparseSolver {
 public:
  /// @param matrix  its lower triangle is read
  /// @throws sweep_guard_core::InvalidInput if the matrix is singular, or if this was built with an Eigen before 3.4,
  ///     whose sparse Cholesky is under the LGPL
  explicit SparseSolver(const Eigen::SparseMatrix<double>& matrix);
  ~SparseSolver();
  SparseSolver(SparseSolver&&) noexcept;
  SparseSolver& operator=(SparseSolver&&) noexcept;

  Eigen::MatrixX3d solve(const Eigen::MatrixX3d& right) const;
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

 private:
  struct Factors;
  std::unique_ptr<const Factors> factors_;
};

}  // namespace sweep_guard_simulation
