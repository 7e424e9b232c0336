#include "prediction/velocity.h"

namespace sweep_guard_core {

void follow(PolynomialFit& fit, const PoseTracker& tracker) {
  if (tracker.step() == PoseTracker::Step::kCorrects) {
    fit.replaceNewest(tracker.coordinates());
    return;
  }
  if (tracker.step() == PoseTracker::Step::kBegins) fit.clear();
  fit.add(tracker.newest().stamp, tracker.coordinates());
}

void Velocity::observe(const PoseTracker& tracker) {
  follow(fit_, tracker);
  const Vector6d slope = fit_.curve({1, 1, 1, 1, 1, 1}).slopeAt(tracker.newest().stamp);
  value_ << limited(slope.head<3>(), tracker.maxSpeed()), limited(slope.tail<3>(), tracker.maxTurnRate());
}

}  // namespace sweep_guard_core
