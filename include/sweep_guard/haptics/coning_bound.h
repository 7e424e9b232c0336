#pragma once

namespace sweep_guard_core {

/// How a hand turns, about all axes together.
struct TurnLimits {
  double max_rate;          ///< [rad/s], > 0
  double max_acceleration;  ///< [rad/s^2], > 0
};

/// Returns by how much [rad] the integral of the turn rate over an interval may differ from the rotation vector between the
/// orientations at its ends: turns do not commute, and a hand that goes around a cone turns although it ends as it began.
/// The rotation vector r follows r' = w - r x w / 2 + ... [Bortz 1971]. To first order the difference is the area between
/// the path of r and its chord: at most length^2 / (2 pi), and at most rate * acceleration * interval^3 / 12, because w turns
/// no faster than the acceleration allows. The terms that follow are bounded by a factor of 1 + length / 2: checked by random
/// motions, not proven. Where the hand may have turned all around, nothing is known but the longest way.
/// @param angle     of the rotation between the ends, in [0, pi] [rad]
/// @param interval  >= 0 [s]
double coningBound(double angle, double interval, const TurnLimits& limits);

}  // namespace sweep_guard_core
