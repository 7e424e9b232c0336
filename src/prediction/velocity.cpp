#include "prediction/velocity.h"

namespace sweep_guard_core {

template <typename Space>
void follow(PolynomialFit<Space::kSize>& fit, const MotionTracker<Space>& tracker) {
  using Step = typename MotionTracker<Space>::Step;
  if (tracker.step() == Step::kCorrects) {
    fit.replaceNewest(tracker.coordinates());
    return;
  }
  if (tracker.step() == Step::kBegins) fit.clear();
  fit.add(tracker.newest().stamp, tracker.coordinates());
}

template <typename Space>
void Velocity<Space>::observe(const MotionTracker<Space>& tracker) {
  follow(fit_, tracker);
  typename PolynomialFit<Space::kSize>::Degrees straight;
  straight.fill(1);
  value_ = tracker.space().limitedTo(fit_.curve(straight).slopeAt(tracker.newest().stamp), 1.0);
}

template void follow(PolynomialFit<PoseSpace::kSize>& fit, const PoseTracker& tracker);
template void follow(PolynomialFit<JointSpace::kSize>& fit, const JointTracker& tracker);
template class Velocity<PoseSpace>;
template class Velocity<JointSpace>;

}  // namespace sweep_guard_core
