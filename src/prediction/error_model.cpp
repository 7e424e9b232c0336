#include "sweep_guard/prediction/error_model.h"

#include <cmath>

#include "sweep_guard/prediction/interpolation.h"

namespace sweep_guard {
namespace {

constexpr double kMemory = 20.0;         // [s]
constexpr double kPriorShare = 0.3;      // of the way at present speed: what is taken for the error before any is known
constexpr double kPriorSpeed = 0.02;     // [m/s] a second at this speed outweighs it
constexpr double kPriorTurnRate = 0.15;  // [rad/s] likewise

// Per axis: along a direction, across it, in rotation.
Eigen::Array3d squares(const Vector6d& error, const Eigen::Vector3d& direction) {
  const double along = error.head<3>().dot(direction);
  const double across = error.head<3>().squaredNorm() - along * along;
  return {along * along, across / 2.0, error.tail<3>().squaredNorm() / 3.0};
}

Vector6d errorOf(const Vector6d& forecast, const Vector6d& moved) {
  const auto pose = [](const Vector6d& way) { return displaced(Eigen::Isometry3d::Identity(), way); };
  return displacement(pose(forecast), pose(moved));
}

}  // namespace

ErrorModel::ErrorModel() {
  const double speed = kPriorSpeed * kPriorSpeed;
  const Eigen::Array3d activity(speed, speed, kPriorTurnRate * kPriorTurnRate);
  for (size_t i = 0; i < records_.size(); ++i) {
    const double share = kPriorShare * kLearnedAhead[i];
    records_[i] = {share * share * activity, activity};
  }
}

void ErrorModel::observe(const MotionTrack& track, const Vector6d& velocity, const Forecast& forecast) {
  activity_ = activityAt(track, velocity);
  direction_ = velocity.head<3>().stableNormalized();
  if (track.step() == MotionTrack::Step::kBegins) hindsight_.clear();
  if (track.step() != MotionTrack::Step::kContinues) return;
  const double period = toSeconds(track.period());
  const double fade = std::exp(-period / kMemory);
  const Known newest{forecast, activity_, direction_};
  hindsight_.add(track.newest(), newest, [&](const Known& known, size_t i, const Vector6d& moved) {
    Record& record = records_[i];
    record.errors = fade * record.errors + period * squares(errorOf(known.forecast[i], moved), known.direction);
    record.activity = fade * record.activity + period * known.activity;
  });
}

Eigen::Array3d ErrorModel::activityAt(const MotionTrack& track, const Vector6d& velocity) {
  const double speed = velocity.head<3>().squaredNorm();
  const Eigen::Array3d now(speed, speed, velocity.tail<3>().squaredNorm());
  if (track.step() == MotionTrack::Step::kContinues) {
    const double period = toSeconds(track.period());
    const double fade = std::exp(-period / kMemory);
    speeds_ = fade * speeds_ + period * now;
    weight_ = fade * weight_ + period;
  }
  return weight_ > 0.0 ? Eigen::Array3d(now + speeds_ / weight_) : now;
}

Matrix6d ErrorModel::covariance(double ahead) const {
  const auto share = overLearnedAhead<Eigen::Array3d>(ahead, [&](size_t i) -> Eigen::Array3d {
    return (records_[i].errors / records_[i].activity).sqrt() / kLearnedAhead[i];
  });
  const Eigen::Array3d variance = (share * ahead).square() * activity_;
  Matrix6d covariance = Matrix6d::Zero();
  covariance.diagonal() << Eigen::Vector3d::Constant(variance[1]), Eigen::Vector3d::Constant(variance[2]);
  covariance.topLeftCorner<3, 3>() += (variance[0] - variance[1]) * direction_ * direction_.transpose();
  return covariance;
}

}  // namespace sweep_guard
