#include "prediction/commanded_motion.h"

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

constexpr Duration kDistrust = std::chrono::seconds(1);
constexpr int kMaxMisled = 3;  // samples in a row

}  // namespace

template <typename Space>
CommandedMotion<Space>::CommandedMotion(const Space& space, const std::shared_ptr<LearnedMotion<Space>>& learned)
    : commands_(space),
      windows_{Velocity<Space>(milliseconds(20)), Velocity<Space>(milliseconds(50)), Velocity<Space>(milliseconds(100)),
               Velocity<Space>(milliseconds(200))},
      learner_({learned, &learned->commanded}),
      errors_(space) {}

template <typename Space>
void CommandedMotion<Space>::command(const Sample& wanted) {
  rate_.reset();
  add(wanted);
}

template <typename Space>
void CommandedMotion<Space>::command(Time stamp, const Vector& velocity) {
  Sample wanted = commands_.newest();
  if (rate_) wanted = Space::displacedSample(wanted, toSeconds(stamp - wanted.stamp) * *rate_);
  wanted.stamp = stamp;
  rate_ = commands_.space().limitedTo(velocity, 1.0);
  add(wanted);
}

template <typename Space>
void CommandedMotion<Space>::add(const Sample& wanted) {
  if (commands_.add(wanted) == MotionTracker<Space>::Step::kBegins) unused_until_ = wanted.stamp + kDistrust;
  for (Velocity<Space>& window : windows_) window.observe(commands_);
}

template <typename Space>
void CommandedMotion<Space>::interrupt() {
  commands_.interrupt();
  learner_.interrupt();
  errors_.interrupt();
  misled_ = 0;
  in_use_ = false;
}

template <typename Space>
void CommandedMotion<Space>::observe(const MotionTracker<Space>& measured, const Regressors<Space>& regressors,
                                     const Vector& velocity, const ErrorModel<Space>& errors) {
  newest_ = measured.newest();
  if (commands_.isSilentAt(newest_.stamp)) return interrupt();
  Regressors<Space, kCommandRegressors> all;
  all.template leftCols<kRegressors>() = regressors;
  for (size_t i = 0; i < windows_.size(); ++i)
    all.col(kRegressors + static_cast<Eigen::Index>(i)) = velocityWithin(windows_[i]);
  if (rate_) all.col(kRegressors) = *rate_;
  learner_.observe(measured, all);
  PredictedDisplacements<Space> predicted;
  for (size_t i = 0; i < predicted.size(); ++i) predicted[i] = displacementIn(kLearnedHorizons[i]);
  errors_.observe(measured, velocity, predicted);
  misled_ = errors_.misleads(errors) ? misled_ + 1 : 0;
  if (misled_ >= kMaxMisled) unused_until_ = newest_.stamp + kDistrust;
  in_use_ = newest_.stamp >= unused_until_;
}

// A pose that is sent may be that of another tool. Velocities that are sent turn about the axes of the measured one.
template <typename Space>
typename Space::Vector CommandedMotion<Space>::velocityWithin(const Velocity<Space>& window) const {
  return rate_ ? window.value() : Space::velocityAs(newest_, commands_.newest(), window.value());
}

template class CommandedMotion<PoseSpace>;
template class CommandedMotion<JointSpace>;

}  // namespace sweep_guard_core
