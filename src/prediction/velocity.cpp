#include "sweep_guard/prediction/velocity.h"

namespace sweep_guard {

void follow(PolynomialFit& fit, const MotionTrack& track) {
  if (track.step() == MotionTrack::Step::kCorrects) {
    fit.replaceNewest(track.coordinates());
    return;
  }
  if (track.step() == MotionTrack::Step::kBegins) fit.clear();
  fit.add(track.newest().stamp, track.coordinates());
}

void Velocity::observe(const MotionTrack& track) {
  follow(fit_, track);
  const Vector6d slope = fit_.curve({1, 1, 1, 1, 1, 1}).slopeAt(track.newest().stamp);
  value_ << limited(slope.head<3>(), track.maxSpeed()), limited(slope.tail<3>(), track.maxTurnRate());
}

}  // namespace sweep_guard
