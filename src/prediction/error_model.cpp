#include "prediction/error_model.h"

#include "prediction/interpolation.h"

namespace sweep_guard_core {
namespace {

constexpr double kPriorShare = 0.3;      // of the displacement at the current speed: error assumed before any is known
constexpr double kPriorSpeed = 0.02;     // [m/s]; one second at this speed outweighs the assumed error
constexpr double kPriorTurnRate = 0.15;  // [rad/s]; one second at this rate outweighs the assumed error

// Returns squares per axis: along a direction, across it, in rotation.
Eigen::Array3d squares(const Vector6d& error, const Eigen::Vector3d& direction) {
  const double along = error.head<3>().dot(direction);
  const double across = error.head<3>().squaredNorm() - along * along;
  return {along * along, across / 2.0, error.tail<3>().squaredNorm() / 3.0};
}

Eigen::Array3d speedSquares(const Vector6d& velocity) {
  const double speed = velocity.head<3>().squaredNorm();
  return {speed, speed, velocity.tail<3>().squaredNorm()};
}

Vector6d errorOf(const Vector6d& predicted, const Vector6d& moved) {
  const auto pose = [](const Vector6d& moved_by) { return displaced(Eigen::Isometry3d::Identity(), moved_by); };
  return displacement(pose(predicted), pose(moved));
}

}  // namespace

ErrorModel::ErrorStatistics ErrorModel::priorStatistics(double ahead, const Squares& share) {
  const Squares activity = Squares(kPriorSpeed, kPriorSpeed, kPriorTurnRate).square();
  return {ExponentialMovingAverage<Squares>((ahead * share).square() * activity, 1.0),
          ExponentialMovingAverage<Squares>(activity, 1.0)};
}

ErrorModel::ErrorModel() {
  for (const double ahead : kLearnedHorizons) {
    statistics_.push_back(priorStatistics(ahead, Squares::Constant(kPriorShare)));
  }
}

ErrorModel::Shares ErrorModel::shares() const {
  Shares shares;
  for (size_t i = 0; i < shares.size(); ++i) shares[i] = share(i);
  return shares;
}

// Smaller errors than assumed have to be seen again: another operator's profile must not make the guard sure.
void ErrorModel::begin(const Shares& shares) {
  for (size_t i = 0; i < shares.size(); ++i) {
    statistics_[i] = priorStatistics(kLearnedHorizons[i], shares[i].max(kPriorShare));
  }
}

ErrorModel::Squares ErrorModel::share(size_t horizon) const {
  const auto& [errors, activity] = statistics_[horizon];
  return (errors.mean() / activity.mean()).sqrt() / kLearnedHorizons[horizon];
}

// Errors are relative to a speed: the largest of the speed at the pose, that of the motion that followed, and that of
// the predicted motion. The speed at the pose alone would fail when the tool starts from rest.
void ErrorModel::observe(const PoseTracker& tracker, const Vector6d& velocity,
                         const PredictedDisplacements& predicted) {
  const double period = toSeconds(tracker.period());
  if (tracker.step() == PoseTracker::Step::kBegins) targets_.clear();
  if (tracker.step() == PoseTracker::Step::kContinues) speeds_.add(speedSquares(velocity), period);
  activity_ = speedSquares(velocity) + speeds_.mean();
  direction_ = velocity.head<3>().stableNormalized();
  const Features newest{predicted, activity_, direction_};
  if (tracker.step() == PoseTracker::Step::kCorrects) targets_.correctNewest(tracker.newest(), newest);
  if (tracker.step() != PoseTracker::Step::kContinues) return;
  targets_.add(tracker.newest(), newest, [&](const Features& features, size_t i, const Vector6d& moved) {
    statistics_[i].errors.add(squares(errorOf(features.predicted[i], moved), features.direction), period);
    const auto speed = [&](const Vector6d& displacement) { return speedSquares(displacement / kLearnedHorizons[i]); };
    statistics_[i].activity.add(features.activity.max(speed(moved)).max(speed(features.predicted[i])), period);
  });
}

Matrix6d ErrorModel::covariance(double ahead) const {
  const auto relative = interpolateOverHorizons<Squares>(ahead, [this](size_t i) { return share(i); });
  const Squares variance = (relative * ahead).square() * activity_;
  Matrix6d covariance = Matrix6d::Zero();
  covariance.diagonal() << Eigen::Vector3d::Constant(variance[1]), Eigen::Vector3d::Constant(variance[2]);
  covariance.topLeftCorner<3, 3>() += (variance[0] - variance[1]) * direction_ * direction_.transpose();
  return covariance;
}

}  // namespace sweep_guard_core
