#include "ros/prediction_pace.h"

#include <algorithm>
#include <chrono>

namespace sweep_guard_ros {
namespace {

constexpr double kShareIfEachPose = 0.45;  // of the time
constexpr double kShare = 0.28;
constexpr int kSmoothed = 16;  // poses
constexpr auto kLongestInterval = std::chrono::milliseconds(100);
constexpr auto kKept = std::chrono::milliseconds(10);

}  // namespace

void PredictionPace::received(SteadyTime at) {
  const Duration since = std::min<Duration>(at - newest_pose_, kLongestInterval);
  pose_interval_ += (since - pose_interval_) / kSmoothed;
  newest_pose_ = at;
}

void PredictionPace::predicted(SteadyTime begin, Duration took) {
  const bool each = took <= kShareIfEachPose * pose_interval_;
  interval_ = std::chrono::duration_cast<Duration>(took / (each ? kShareIfEachPose : kShare));
  due_ = std::clamp<SteadyTime>(due_, begin - kKept, begin + kKept) + interval_;
}

}  // namespace sweep_guard_ros
