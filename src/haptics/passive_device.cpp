#include "sweep_guard/haptics/passive_device.h"

#include <algorithm>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr size_t kTranslation = 3;

}  // namespace

PassiveDevice::PassiveDevice(const ForceOptions& force, const Options& options) {
  const bool possible = options.max_speed > 0.0 && options.max_acceleration > 0.0 && options.max_turn_rate > 0.0 &&
                        options.max_turn_acceleration > 0.0;
  if (!possible) throw InvalidInput("max_speed, max_turn_rate and accelerations of the hand: must be > 0");
  axes_.assign(kTranslation, PassivityController({force.max_force, options.max_speed, options.max_acceleration,
                                                  force.period, force.output_delay}));
  if (!(force.max_torque > 0.0)) return;
  axes_.resize(2 * kTranslation,
               PassivityController({force.max_torque, options.max_turn_rate, options.max_turn_acceleration,
                                    force.period, force.output_delay}));
}

void PassiveDevice::observe(const Hand& hand, const Instant& now) {
  if (newest_ && hand.timestamps.stamp == newest_->timestamps.stamp) return;
  const Eigen::Isometry3d& before_FH = newest_ ? newest_->X_FH : hand.X_FH;
  const Eigen::AngleAxisd turn(hand.X_FH.linear() * before_FH.linear().transpose());
  Eigen::Matrix<double, 2 * kTranslation, 1> motion_D;
  motion_D << hand.R_FD.transpose() * (hand.X_FH.translation() - before_FH.translation()) / hand.scale,
      hand.R_FD.transpose() * (turn.angle() * turn.axis());
  const SteadyTime measured = now.steady - age(hand.timestamps, now);
  for (size_t i = 0; i < axes_.size(); ++i) axes_[i].moved(motion_D[static_cast<Eigen::Index>(i)], measured);
  newest_ = hand;
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

double PassiveDevice::energy() const { return std::max({axes_[0].energy(), axes_[1].energy(), axes_[2].energy()}); }

double PassiveDevice::tolerance() const { return axes_[0].tolerance(); }

}  // namespace sweep_guard_core
