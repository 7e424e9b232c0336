#include "sweep_guard/prediction/error_model.h"

#include <cmath>

#include "sweep_guard/prediction/interpolation.h"

namespace sweep_guard {
namespace {

constexpr double kMemory = 20.0;     // [s]
constexpr double kPriorShare = 0.3;  // of the way at present speed: what is taken for the error before any is known
constexpr std::array<double, 2> kPriorSpeed = {0.02, 0.15};  // [m/s], [rad/s]: a second at this speed outweighs it

}  // namespace

ErrorModel::ErrorModel() {
  for (size_t kind = 0; kind < records_.size(); ++kind) {
    const double activity = kPriorSpeed[kind] * kPriorSpeed[kind];
    for (size_t i = 0; i < kLearnedAhead.size(); ++i) {
      const double share = kPriorShare * kLearnedAhead[i];
      records_[kind][i] = {share * share * activity, activity};
    }
  }
}

void ErrorModel::observe(const MotionTrack& track, const Vector6d& velocity, const Forecast& forecast) {
  activity_ = activityAt(track, velocity);
  if (track.step() == MotionTrack::Step::kBegins) hindsight_.clear();
  if (track.step() != MotionTrack::Step::kContinues) return;
  const double period = toSeconds(track.period());
  const double fade = std::exp(-period / kMemory);
  hindsight_.add(track.newest(), {forecast, activity_}, [&](const Known& known, size_t i, const Vector6d& moved) {
    const auto pose = [](const Vector6d& moved_to) { return displaced(Eigen::Isometry3d::Identity(), moved_to); };
    const Vector6d error = displacement(pose(known.forecast[i]), pose(moved));
    for (int kind = 0; kind < 2; ++kind) {
      Record& record = records_[static_cast<size_t>(kind)][i];
      record.squares = fade * record.squares + period * error.segment<3>(3 * kind).squaredNorm() / 3.0;
      record.activity = fade * record.activity + period * known.activity[kind];
    }
  });
}

Eigen::Vector2d ErrorModel::activityAt(const MotionTrack& track, const Vector6d& velocity) {
  const Eigen::Vector2d squares(velocity.head<3>().squaredNorm(), velocity.tail<3>().squaredNorm());
  if (track.step() == MotionTrack::Step::kContinues) {
    const double period = toSeconds(track.period());
    const double fade = std::exp(-period / kMemory);
    speed_squares_ = fade * speed_squares_ + period * squares;
    weight_ = fade * weight_ + period;
  }
  return weight_ > 0.0 ? Eigen::Vector2d(squares + speed_squares_ / weight_) : squares;
}

ErrorModel::Variance ErrorModel::variance(double ahead) const {
  const auto of = [&](size_t kind) {
    const double share = overLearnedAhead<double>(ahead, [&](size_t i) {
      const Record& record = records_[kind][i];
      return std::sqrt(record.squares / record.activity) / kLearnedAhead[i];
    });
    return share * share * ahead * ahead * activity_[static_cast<Eigen::Index>(kind)];
  };
  return {of(0), of(1)};
}

}  // namespace sweep_guard
