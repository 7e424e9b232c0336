#include "prediction/commanded_motion.h"

namespace sweep_guard_core {
namespace {

constexpr Duration kLeadTime = std::chrono::milliseconds(100);
constexpr Duration kDistrust = std::chrono::seconds(1);
constexpr int kMaxMisled = 3;  // samples in a row

}  // namespace

template <typename Space>
CommandedMotion<Space>::CommandedMotion(const Space& space, const std::shared_ptr<LearnedMotion<Space>>& learned)
    : commands_(space), learner_({learned, &learned->commanded}), errors_(space) {}

template <typename Space>
void CommandedMotion<Space>::command(const Sample& wanted) {
  rate_.reset();
  begin(commands_.add(wanted));
  velocity_.observe(commands_);
}

template <typename Space>
void CommandedMotion<Space>::command(Time stamp, const Vector& velocity) {
  Sample wanted = commands_.newest();
  if (rate_) wanted = Space::displacedSample(wanted, toSeconds(stamp - wanted.stamp) * *rate_);
  wanted.stamp = stamp;
  rate_ = commands_.space().limitedTo(velocity, 1.0);
  begin(commands_.add(wanted));
}

template <typename Space>
void CommandedMotion<Space>::begin(typename MotionTracker<Space>::Step step) {
  if (step != MotionTracker<Space>::Step::kBegins) return;
  leads_.clear();
  unused_until_ = commands_.newest().stamp + kDistrust;
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
  all << regressors, lead(measured), rate_ ? *rate_ : velocity_.value();
  learner_.observe(measured, all);
  PredictedDisplacements<Space> predicted;
  for (size_t i = 0; i < predicted.size(); ++i) predicted[i] = displacementIn(kLearnedHorizons[i]);
  errors_.observe(measured, velocity, predicted);
  misled_ = errors_.misleads(errors) ? misled_ + 1 : 0;
  if (misled_ >= kMaxMisled) unused_until_ = newest_.stamp + kDistrust;
  in_use_ = newest_.stamp >= unused_until_;
}

template <typename Space>
typename Space::Vector CommandedMotion<Space>::lead(const MotionTracker<Space>& measured) {
  const Vector ahead = rate_ ? leadOfVelocities(measured) : Space::displacementOf(newest_, commands_.newest());
  return commands_.space().limitedTo(ahead / toSeconds(kLeadTime), 1.0);
}

template <typename Space>
typename Space::Vector CommandedMotion<Space>::leadOfVelocities(const MotionTracker<Space>& measured) {
  if (measured.step() == MotionTracker<Space>::Step::kBegins) leads_.clear();
  const double since = toSeconds(newest_.stamp - commands_.newest().stamp);
  const Vector ahead = commands_.coordinates() + since * *rate_ - measured.coordinates();
  while (leads_.size() > 1 && leads_[1].stamp <= newest_.stamp - kLeadTime) leads_.pop_front();
  if (leads_.full()) leads_.set_capacity(2 * leads_.capacity());
  leads_.push_back({newest_.stamp, ahead});
  return ahead - leads_.front().ahead;
}

template class CommandedMotion<PoseSpace>;
template class CommandedMotion<JointSpace>;

}  // namespace sweep_guard_core
