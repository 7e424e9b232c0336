#include "simulation/elastic/sparse_solver.h"

#include "sweep_guard/common/error.h"

#if EIGEN_VERSION_AT_LEAST(3, 4, 0)

#define EIGEN_MPL2_ONLY
#include <Eigen/SparseCholesky>
#endif

namespace sweep_guard_simulation {

struct SparseSolver::Factors {
#if EIGEN_VERSION_AT_LEAST(3, 4, 0)
  explicit Factors(const Eigen::SparseMatrix<double>& matrix) : cholesky(matrix) {}
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> cholesky;
#endif
};

#if EIGEN_VERSION_AT_LEAST(3, 4, 0)

namespace {

constexpr double kSingular = 1e-13;  // of the largest pivot

}  // namespace

SparseSolver::SparseSolver(const Eigen::SparseMatrix<double>& matrix)
    : factors_(std::make_unique<const Factors>(matrix)) {
  const auto pivots = factors_->cholesky.vectorD();
  if (factors_->cholesky.info() != Eigen::Success || !(pivots.minCoeff() > kSingular * pivots.maxCoeff())) {
    throw sweep_guard_core::InvalidInput("the elastic workpiece is not held: fix nodes, or give each node a mass");
  }
}

Eigen::MatrixX3d SparseSolver::solve(const Eigen::MatrixX3d& right) const { return factors_->cholesky.solve(right); }

Eigen::VectorXd SparseSolver::solve(const Eigen::VectorXd& right) const { return factors_->cholesky.solve(right); }

#else

SparseSolver::SparseSolver(const Eigen::SparseMatrix<double>&) {
  throw sweep_guard_core::InvalidInput("an elastic workpiece needs a build with Eigen 3.4 or newer");
}

Eigen::MatrixX3d SparseSolver::solve(const Eigen::MatrixX3d& right) const { return right; }

Eigen::VectorXd SparseSolver::solve(const Eigen::VectorXd& right) const { return right; }

#endif

SparseSolver::~SparseSolver() = default;
SparseSolver::SparseSolver(SparseSolver&&) noexcept = default;
SparseSolver& SparseSolver::operator=(SparseSolver&&) noexcept = default;

}  // namespace sweep_guard_simulation
