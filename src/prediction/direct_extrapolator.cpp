#include "prediction/direct_extrapolator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace sweep_guard_core {
namespace {

constexpr std::array<int, 5> kWindows = {50, 120, 300, 800, 20};  // [ms]
constexpr double kCenterTime = 6.0;                               // [s]

constexpr int kModerate = 1;        // window of 120 ms: what fast motion is measured by
constexpr int kSmooth = 2;          // window of 300 ms
constexpr double kMaxSpeed = 2.5;   // largest speed that counts, relative to the mean speed
constexpr double kSlowSpeed = 0.3;  // half of the saturated speed is reached here, relative to the mean speed

constexpr int kScaled = kWindows.size();
constexpr int kSaturated = kScaled + 1;
constexpr int kReturn = kScaled + 2;
static_assert(kReturn + 1 == kRegressors);

}  // namespace

template <typename Space>
DirectExtrapolator<Space>::DirectExtrapolator(const std::shared_ptr<LearnedMotion<Space>>& learned)
    : learner_({learned, &learned->measured}) {
  for (const int milliseconds : kWindows) windows_.emplace_back(std::chrono::milliseconds(milliseconds));
}

template <typename Space>
void DirectExtrapolator<Space>::measure(const MotionTracker<Space>& tracker) {
  for (size_t i = 0; i < windows_.size(); ++i) {
    windows_[i].observe(tracker);
    regressors_.col(static_cast<Eigen::Index>(i)) = windows_[i].value();
  }
  average(tracker);
  regressors_.col(kReturn) = (tracker.coordinates() - center_) / kCenterTime;
  scale();
}

template <typename Space>
void DirectExtrapolator<Space>::average(const MotionTracker<Space>& tracker) {
  if (tracker.step() == MotionTracker<Space>::Step::kBegins) center_ = tracker.coordinates();
  if (tracker.step() != MotionTracker<Space>::Step::kContinues) return;
  const double period = toSeconds(tracker.period());
  center_ += (1.0 - std::exp(-period / kCenterTime)) * (tracker.coordinates() - center_);
  typename Space::Speeds squares;
  for (int i = 0; i < Space::kGroups; ++i)
    squares[i] = regressors_.col(kModerate).template segment<Space::kAxes>(i * Space::kAxes).squaredNorm();
  speeds_.add(squares, period);
}

template <typename Space>
void DirectExtrapolator<Space>::scale() {
  const typename Space::Speeds mean = speeds_.mean().sqrt();
  for (int i = 0; i < Space::kGroups; ++i) {
    auto values = regressors_.template middleRows<Space::kAxes>(i * Space::kAxes);
    if (mean[i] == 0.0) {
      values.col(kScaled).setZero();
      values.col(kSaturated).setZero();
      continue;
    }
    values.col(kScaled) = std::min(values.col(kModerate).norm() / mean[i], kMaxSpeed) * values.col(kModerate);
    values.col(kSaturated) = values.col(kSmooth) / (values.col(kSmooth).norm() / mean[i] + kSlowSpeed);
  }
}

template <typename Space>
void DirectExtrapolator<Space>::observe(const MotionTracker<Space>& tracker) {
  measure(tracker);
  learner_.observe(tracker, regressors_);
}

template class DirectExtrapolator<PoseSpace>;
template class DirectExtrapolator<JointSpace>;

}  // namespace sweep_guard_core
