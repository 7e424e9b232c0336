#include "prediction/motion_regressors.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sweep_guard_core {
namespace {

constexpr std::array<int, 5> kWindows = {50, 120, 300, 800, 20};  // [ms]
constexpr double kCenterTime = 6.0;                               // [s]

constexpr double kProfileTime = 1.0;  // mean speeds of a profile count as those of so many seconds at most

constexpr int kModerate = 1;        // window of 120 ms: what fast motion is measured by
constexpr int kSmooth = 2;          // window of 300 ms
constexpr double kMaxSpeed = 2.5;   // largest speed that counts, relative to the mean speed
constexpr double kSlowSpeed = 0.3;  // half of the saturated speed is reached here, relative to the mean speed

enum Column : Eigen::Index { kScaled = kWindows.size(), kSaturated, kReturn, kColumns };
static_assert(kColumns == DisplacementRegression::kVelocities);

}  // namespace

std::vector<std::string> MotionRegressors::names() {
  std::vector<std::string> names;
  for (const int milliseconds : kWindows) names.push_back(std::to_string(milliseconds) + "ms");
  for (const char* const name : {"times_speed", "saturated", "return"}) names.emplace_back(name);
  return names;
}

MotionRegressors::MotionRegressors() {
  for (const int milliseconds : kWindows) windows_.emplace_back(std::chrono::milliseconds(milliseconds));
}

void MotionRegressors::observe(const PoseTracker& tracker) {
  for (size_t i = 0; i < windows_.size(); ++i) {
    windows_[i].observe(tracker);
    values_.col(static_cast<Eigen::Index>(i)) = windows_[i].value();
  }
  average(tracker);
  values_.col(kReturn) = (tracker.coordinates() - center_) / kCenterTime;
  scale();
}

void MotionRegressors::begin(const Speeds& speeds) {
  speeds_ = ExponentialMovingAverage<Eigen::Array2d>(speeds.squares, std::min(speeds.time, kProfileTime));
}

void MotionRegressors::average(const PoseTracker& tracker) {
  if (tracker.step() == PoseTracker::Step::kBegins) center_ = tracker.coordinates();
  if (tracker.step() != PoseTracker::Step::kContinues) return;
  const double period = toSeconds(tracker.period());
  center_ += (1.0 - std::exp(-period / kCenterTime)) * (tracker.coordinates() - center_);
  const Vector6d velocity = values_.col(kModerate);
  speeds_.add({velocity.head<3>().squaredNorm(), velocity.tail<3>().squaredNorm()}, period);
}

void MotionRegressors::scale() {
  const Eigen::Array2d mean = speeds_.mean().sqrt();
  for (const Eigen::Index i : {0, 1}) {
    auto values = values_.middleRows<3>(3 * i);
    if (mean[i] == 0.0) {
      values.col(kScaled).setZero();
      values.col(kSaturated).setZero();
      continue;
    }
    values.col(kScaled) = std::min(values.col(kModerate).norm() / mean[i], kMaxSpeed) * values.col(kModerate);
    values.col(kSaturated) = values.col(kSmooth) / (values.col(kSmooth).norm() / mean[i] + kSlowSpeed);
  }
}

}  // namespace sweep_guard_core
