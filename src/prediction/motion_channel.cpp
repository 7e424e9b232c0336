#include "prediction/motion_channel.h"

#include <utility>

namespace sweep_guard_core {
namespace {

constexpr auto kActivityWindow = std::chrono::milliseconds(120);

}  // namespace

template <typename Space>
MotionChannel<Space>::MotionChannel(const PredictorOptions& options, const Space& space,
                                    std::shared_ptr<LearnedMotion<Space>> learned)
    : tracker_(space),
      velocity_(kActivityWindow),
      extrapolator_(makeExtrapolator(options, space, std::move(learned))),
      errors_(space) {}

template <typename Space>
void MotionChannel<Space>::observe(const typename Space::Sample& sample) {
  tracker_.add(sample);
  velocity_.observe(tracker_);
  extrapolator_->observe(tracker_);
  PredictedDisplacements<Space> predicted;
  for (size_t i = 0; i < predicted.size(); ++i) predicted[i] = displacementIn(kLearnedHorizons[i]);
  errors_.observe(tracker_, velocity_.value(), predicted);
}

template class MotionChannel<PoseSpace>;
template class MotionChannel<JointSpace>;

}  // namespace sweep_guard_core
