#include "sweep_guard/haptics/passive_device.h"

#include <algorithm>
#include <cmath>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

double largestEnergy(const std::vector<PassivityController>& axes, size_t first) {
  return std::max({axes[first].energy(), axes[first + 1].energy(), axes[first + 2].energy()});
}

}  // namespace

double coningBound(double angle, double interval, const HandLimits& limits) {
  const double longest = limits.max_turn_rate * interval;
  if (longest + angle >= 2.0 * M_PI) return longest + angle;
  const double length =
      std::max(angle, std::min(longest, angle + limits.max_turn_acceleration * interval * interval / 2.0));
  const double rate = interval > 0.0
                          ? std::min(limits.max_turn_rate, angle / interval + limits.max_turn_acceleration * interval)
                          : limits.max_turn_rate;
  const double area = std::min(rate * limits.max_turn_acceleration * interval * interval * interval / 12.0,
                               length * length / (2.0 * M_PI));
  return (1.0 + length / 2.0) * area;
}

PassiveDevice::PassiveDevice(const ForceOptions& force, const HandLimits& limits) : limits_(limits) {
  const bool possible = limits.max_speed > 0.0 && limits.max_acceleration > 0.0 && limits.max_turn_rate > 0.0 &&
                        limits.max_turn_acceleration > 0.0;
  if (!possible) throw InvalidInput("max_speed, max_turn_rate and accelerations of the hand: must be > 0");
  axes_.assign(kTranslation, PassivityController({force.max_force, limits.max_speed, limits.max_acceleration,
                                                  force.period, force.output_delay}));
  if (!(force.max_torque > 0.0)) return;
  axes_.resize(2 * kTranslation, PassivityController({force.max_torque, limits.max_turn_rate,
                                                      limits.max_turn_acceleration, force.period, force.output_delay}));
}

void PassiveDevice::observe(const Hand& hand, const Instant& now) {
  if (newest_ && hand.timestamps.stamp == newest_->timestamps.stamp) return;
  const Eigen::Isometry3d& before_FH = newest_ ? newest_->X_FH : hand.X_FH;
  const Eigen::AngleAxisd turn(hand.X_FH.linear() * before_FH.linear().transpose());
  Eigen::Matrix<double, 2 * kTranslation, 1> motion_D;
  motion_D << hand.R_FD.transpose() * (hand.X_FH.translation() - before_FH.translation()) / hand.scale,
      hand.R_FD.transpose() * (turn.angle() * turn.axis());
  const SteadyTime measured = now.steady - age(hand.timestamps, now);
  const double interval = newest_ ? std::max(0.0, toSeconds(measured - measured_)) : 0.0;
  const double doubt = coningBound(turn.angle(), interval, limits_);
  for (size_t i = 0; i < axes_.size(); ++i) {
    axes_[i].moved(motion_D[static_cast<Eigen::Index>(i)], measured, i < kTranslation ? 0.0 : doubt);
  }
  newest_ = hand;
  measured_ = std::max(measured, measured_);
}

DeviceWrench PassiveDevice::limit(const DeviceWrench& wanted, SteadyTime now) {
  DeviceWrench passive;
  for (size_t i = 0; i < axes_.size(); ++i) {
    const auto axis = static_cast<Eigen::Index>(i % kTranslation);
    const bool turns = i >= kTranslation;
    const double effort = axes_[i].limit(turns ? wanted.torque_D[axis] : wanted.force_D[axis], now);
    (turns ? passive.torque_D : passive.force_D)[axis] = effort;
  }
  return passive;
}

double PassiveDevice::energy() const { return largestEnergy(axes_, 0); }

double PassiveDevice::tolerance() const { return axes_.front().tolerance(); }

double PassiveDevice::turnEnergy() const { return hasTorque() ? largestEnergy(axes_, kTranslation) : 0.0; }

double PassiveDevice::turnTolerance() const { return hasTorque() ? axes_.back().tolerance() : 0.0; }

}  // namespace sweep_guard_core
