#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace sweep_guard_core {

/// Recursive least squares [P, Sec. 3.2]: fits M outputs, each a weighted sum of the same N regressors, one observation
/// at a time. The recursion updates the information matrix, not its inverse: it stays symmetric, an observation can be
/// removed again, and with a prior nothing winds up while the regressors do not change.
template <int N, int M>
class Rls {
 public:
  using Regressors = Eigen::Matrix<double, N, 1>;
  using Outputs = Eigen::Matrix<double, M, 1>;
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, N, N>;
  using Coefficients = Eigen::Matrix<double, Eigen::Dynamic, M, Eigen::ColMajor, N, M>;

  /// Multiplies the weight of all observations.
  /// @param factor  in (0, 1]
  void forget(double factor) {
    information_ *= factor;
    projection_ *= factor;
  }

  /// Adds an observation.
  /// @param weight  a negative weight removes the observation again
  void add(const Regressors& regressors, const Outputs& outputs, double weight = 1.0) {
    information_.noalias() += (weight * regressors) * regressors.transpose();
    projection_.noalias() += weight * regressors * outputs.transpose();
  }

  /// Changes the outputs of an observation of weight 1.
  /// @param change  what they are now, less what they were
  void correct(const Regressors& regressors, const Outputs& change) {
    projection_.noalias() += regressors * change.transpose();
  }

  /// Returns the coefficients that fit best: one column per output.
  /// @param n      number of regressors used, from the first; 1 to N
  /// @param prior  information that every coefficient is 0, >= 0
  Coefficients coefficients(int n = N, double prior = 0.0) const {
    return solver(n, prior).solve(projection_.topRows(n));
  }

  /// Returns the coefficients that fit best: one column per output.
  /// @param prior     information that the coefficients are the expected ones, >= 0
  /// @param expected  coefficients before any observation
  Coefficients coefficients(double prior, const Coefficients& expected) const {
    return solver(N, prior).solve(projection_ + prior * expected);
  }

 private:
  Eigen::LDLT<Square> solver(int n, double prior) const {
    Square information = information_.topLeftCorner(n, n);
    information.diagonal().array() += prior;
    return Eigen::LDLT<Square>(information);
  }

  Eigen::Matrix<double, N, N> information_ = Eigen::Matrix<double, N, N>::Zero();
  Eigen::Matrix<double, N, M> projection_ = Eigen::Matrix<double, N, M>::Zero();
};

}  // namespace sweep_guard_core
