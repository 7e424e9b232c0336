#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace sweep_guard {

/// Recursive least squares [P, Sec. 3.2]: fits M outputs, each a weighted sum of the same N regressors, one observation
/// at a time. It recurs on the information matrix and not on its inverse: nothing winds up where the regressors do not
/// move, symmetry cannot be lost, and an observation can be taken out again.
template <int N, int M>
class Rls {
 public:
  using Regressors = Eigen::Matrix<double, N, 1>;
  using Outputs = Eigen::Matrix<double, M, 1>;
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, N, N>;
  using Coefficients = Eigen::Matrix<double, Eigen::Dynamic, M, Eigen::ColMajor, N, M>;

  /// The best coefficients of the first n regressors, and how far they can be trusted.
  struct Estimate {
    Coefficients coefficients;  ///< n x M
    Square covariance;          ///< n x n, of the coefficients of an output whose observations err by 1
    Outputs variance;           ///< of the observations about the fit; 0 without observations to spare
  };

  /// Multiplies the weight of everything observed so far.
  /// @param factor  in (0, 1]
  void forget(double factor) {
    information_ *= factor;
    projection_ *= factor;
    squares_ *= factor;
    weight_ *= factor;
  }

  /// @param weight  of the observation; negative takes it out again
  void add(const Regressors& regressors, const Outputs& outputs, double weight = 1.0) {
    information_.template selfadjointView<Eigen::Lower>().rankUpdate(regressors, weight);
    projection_.noalias() += weight * regressors * outputs.transpose();
    squares_ += weight * outputs.cwiseAbs2();
    weight_ += weight;
  }

  /// @param n      how many of the regressors take part, 1 to N
  /// @param prior  information that every coefficient is 0, >= 0
  Estimate estimate(int n = N, double prior = 0.0) const {
    Square information = information_.topLeftCorner(n, n).template selfadjointView<Eigen::Lower>();
    information.diagonal().array() += prior;
    const Eigen::LDLT<Square> solver(information);
    Estimate estimate;
    estimate.coefficients = solver.solve(projection_.topRows(n));
    estimate.covariance = solver.solve(Square::Identity(n, n));
    const Outputs explained = estimate.coefficients.cwiseProduct(projection_.topRows(n)).colwise().sum().transpose();
    const double spare = weight_ - n;
    estimate.variance = spare > 0.0 ? Outputs((squares_ - explained).cwiseMax(0.0) / spare) : Outputs(Outputs::Zero());
    return estimate;
  }

  double weight() const { return weight_; }  ///< of all observations together

 private:
  Eigen::Matrix<double, N, N> information_ = Eigen::Matrix<double, N, N>::Zero();  // lower triangle
  Eigen::Matrix<double, N, M> projection_ = Eigen::Matrix<double, N, M>::Zero();
  Outputs squares_ = Outputs::Zero();
  double weight_ = 0.0;
};

}  // namespace sweep_guard
