#include "prediction/error_model.h"

namespace sweep_guard_core {
namespace {

constexpr size_t kJudged = 2;        // of kLearnedHorizons: 0.1 s
constexpr double kPriorShare = 0.3;  // of the displacement at the current speed: error assumed before any is known

using Joint = JointSpace::Vector;
using JointSquares = Eigen::Array<double, 1, 1>;

// Returns squares per axis: along a direction, across it, in rotation.
Eigen::Array3d squares(const Vector6d& error, const Eigen::Vector3d& direction) {
  const double along = error.head<3>().dot(direction);
  const double across = error.head<3>().squaredNorm() - along * along;
  return {along * along, across / 2.0, error.tail<3>().squaredNorm() / 3.0};
}
JointSquares squares(const Joint& error, const Joint& /*direction*/) { return error.array().square(); }

Eigen::Array3d speedSquares(const Vector6d& velocity) {
  const double speed = velocity.head<3>().squaredNorm();
  return {speed, speed, velocity.tail<3>().squaredNorm()};
}
JointSquares speedSquares(const Joint& velocity) { return velocity.array().square(); }

Eigen::Array3d activityAt(const PoseSpace::Speeds& speeds) {
  return Eigen::Array3d(speeds[0], speeds[0], speeds[1]).square();
}
JointSquares activityAt(const JointSpace::Speeds& speeds) { return speeds.square(); }

template <typename Space>
typename Space::Vector errorOf(const typename Space::Vector& predicted, const typename Space::Vector& moved) {
  const auto displacedBy = [](const auto& moved_by) { return Space::displacedSample({}, moved_by); };
  return Space::displacementOf(displacedBy(predicted), displacedBy(moved));
}

Matrix6d covarianceOf(const Eigen::Array3d& variance, const Eigen::Vector3d& direction) {
  Matrix6d covariance = Matrix6d::Zero();
  covariance.diagonal() << Eigen::Vector3d::Constant(variance[1]), Eigen::Vector3d::Constant(variance[2]);
  covariance.topLeftCorner<3, 3>() += (variance[0] - variance[1]) * direction * direction.transpose();
  return covariance;
}
Joint covarianceOf(const JointSquares& variance, const Joint& /*direction*/) { return variance.matrix(); }

}  // namespace

// One second at the prior speeds outweighs the assumed errors.
template <typename Space>
ErrorModel<Space>::ErrorModel(const Space& space) {
  const Squares prior_activity = activityAt(space.priorSpeeds());
  for (const double ahead : kLearnedHorizons) {
    const Squares share = Squares::Constant(kPriorShare);
    errors_.emplace_back((ahead * share).square() * prior_activity, 1.0);
    activities_.emplace_back(prior_activity, 1.0);
  }
}

template <typename Space>
typename ErrorModel<Space>::Squares ErrorModel<Space>::share(size_t horizon) const {
  return (errors_[horizon].mean() / activities_[horizon].mean()).sqrt() / kLearnedHorizons[horizon];
}

// Errors are relative to a speed: the largest of the speed at the pose, that of the motion that followed, and that of
// the predicted motion. The speed at the pose alone would fail when the tool starts from rest.
template <typename Space>
void ErrorModel<Space>::observe(const MotionTracker<Space>& tracker, const Vector& velocity,
                                const PredictedDisplacements<Space>& predicted) {
  using Step = typename MotionTracker<Space>::Step;
  const double period = toSeconds(tracker.period());
  if (tracker.step() == Step::kBegins) targets_.clear();
  if (tracker.step() == Step::kContinues) speeds_.add(speedSquares(velocity), period);
  activity_ = speedSquares(velocity) + speeds_.mean();
  direction_ = velocity.template head<Space::kAxes>().stableNormalized();
  const Features newest{predicted, activity_, direction_};
  if (tracker.step() == Step::kCorrects) targets_.correctNewest(tracker.newest(), newest);
  if (tracker.step() != Step::kContinues) return;
  targets_.add(tracker.newest(), newest, [&](const Features& features, size_t i, const Vector& moved) {
    const Squares error = squares(errorOf<Space>(features.predicted[i], moved), features.direction);
    if (i == kJudged) {
      newest_ = error;
      limit_ = 9.0 * (kLearnedHorizons[i] * share(i)).square() * features.activity;
    }
    errors_[i].add(error, period);
    const auto speed = [&](const Vector& displacement) {
      return speedSquares(Vector(displacement / kLearnedHorizons[i]));
    };
    activities_[i].add(features.activity.max(speed(moved)).max(speed(features.predicted[i])), period);
  });
}

template <typename Space>
void ErrorModel<Space>::interrupt() {
  targets_.clear();
  newest_.setZero();
}

template <typename Space>
typename ErrorModel<Space>::Covariance ErrorModel<Space>::covariance(double ahead) const {
  const auto relative = interpolateOverHorizons<Squares>(ahead, [this](size_t i) { return share(i); });
  return covarianceOf((relative * ahead).square() * activity_, direction_);
}

template class ErrorModel<PoseSpace>;
template class ErrorModel<JointSpace>;

}  // namespace sweep_guard_core
