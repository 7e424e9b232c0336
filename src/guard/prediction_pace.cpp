#include "guard/prediction_pace.h"

#include <algorithm>
#include <chrono>

namespace sweep_guard_core {
namespace {

constexpr double kShareIfEachPose = 0.45;  // of the time
constexpr double kShare = 0.2;
constexpr auto kLongestInterval = std::chrono::milliseconds(100);
constexpr auto kMaxCredit = std::chrono::milliseconds(10);

void smooth(Duration& mean, Duration newest) { mean += (newest - mean) / 16; }

}  // namespace

void PredictionPace::received(SteadyTime at) {
  if (at <= newest_pose_) return;
  smooth(pose_interval_, std::min<Duration>(at - newest_pose_, kLongestInterval));
  newest_pose_ = at;
}

void PredictionPace::predicted(SteadyTime begin, Duration took) {
  smooth(took_, took);
  const bool each = took_ <= kShareIfEachPose * pose_interval_;
  interval_ = std::chrono::duration_cast<Duration>(took / (each ? kShareIfEachPose : kShare));
  due_ = std::clamp<SteadyTime>(due_, begin - kMaxCredit, begin + kMaxCredit) + interval_;
}

}  // namespace sweep_guard_core
