#include "sweep_guard/haptics/force_renderer.h"

#include <algorithm>
#include <cmath>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

double fade(Duration silent, const ForceOptions& options) {
  return std::clamp(1.0 - toSeconds(silent - options.silence) / toSeconds(options.ramp), 0.0, 1.0);
}

constexpr double kVelocityTime = 0.01;  // time constant of the low-pass [s]
constexpr double kMaxPause = 0.1;       // between poses that a velocity is measured from [s]
constexpr double kDelayTime = 1.0;      // in which a long delay is forgotten [s]

Eigen::Vector3d clampedTo(const Eigen::Vector3d& vector, double length) {
  const double norm = vector.norm();
  return norm > length ? Eigen::Vector3d(vector * (length / norm)) : vector;
}

// At the device, without the stiffness that a delay takes.
double dampingAtDevice(const ForceOptions& options) {
  return (options.law.damping + options.law.cue_damping) * options.force_scale * options.position_scale;
}

void require(bool holds, const char* what) {
  if (!holds) throw InvalidInput(what);
}

void requireUsable(const ForceOptions& options) {
  sweep_guard_core::requireUsable(options.law);
  require(options.position_scale > 0.0 && options.force_scale > 0.0, "position_scale and force_scale: must be > 0");
  require(options.max_force > 0.0 && options.max_force_rate > 0.0, "max_force and its rate: must be > 0");
  require(options.max_torque >= 0.0 && options.max_torque_rate > 0.0, "max_torque: must be >= 0, and its rate > 0");
  require(options.period > Duration::zero() && options.output_delay >= Duration::zero(), "period: must be > 0 s");
  require(options.device_turn_damping > 0.0, "device_turn_damping: must be > 0");
  require(options.device_damping > dampingAtDevice(options),
          "device_damping: must be above the damping and the cue's damping together, times force_scale and "
          "position_scale");
}

}  // namespace

ForcePermission decideForce(const ForceInputs& inputs, const Instant& now, const ForceOptions& options) {
  const MotionInputs& known = inputs.known;
  if (!known.warning) return {0.0, PermissionCause::kNoWarning};
  if (now.steady - known.warning->received > options.warning_silence) return {0.0, PermissionCause::kWarningSilent};
  if (!known.warning->knows()) return {0.0, PermissionCause::kUnknown};
  if (!known.pose) return {0.0, PermissionCause::kNoPose};
  if (now.stamp - known.pose->timestamps.stamp > options.pose_age) return {0.0, PermissionCause::kOldPose};
  if (!known.planes) return {0.0, PermissionCause::kNoPlanes};
  if (now.stamp > known.planes->valid_until) return {0.0, PermissionCause::kPlanesExpired};
  if (!known.planes->complete) return {0.0, PermissionCause::kIncomplete};
  if (!known.toolIsKnown()) return {0.0, PermissionCause::kNoTool};
  if (known.jointsMoveTool() && !inputs.placed) return {0.0, PermissionCause::kMovingJoints};
  const bool placed_long_ago = inputs.placed && now.stamp - inputs.placed->timestamps.stamp > options.pose_age;
  if (placed_long_ago) return {0.0, PermissionCause::kOldJoints};

  ForcePermission permission{1.0, PermissionCause::kGuarded};
  const auto fadeWith = [&](const Timestamps& input, PermissionCause cause) {
    const double gain = fade(now.steady - input.received, options);
    if (gain < permission.gain) permission = {gain, cause};
  };
  fadeWith(known.pose->timestamps, PermissionCause::kPoseSilent);
  fadeWith(known.planes->timestamps, PermissionCause::kPlanesSilent);
  if (inputs.placed) fadeWith(inputs.placed->timestamps, PermissionCause::kJointsSilent);
  if (inputs.device) fadeWith(*inputs.device, PermissionCause::kDeviceSilent);
  return permission;
}

double maxStiffness(const SampledDevice& device, double delay) {
  return std::max(0.0, device.damping - device.virtual_damping) / (device.period / 2 + delay);
}

double dampingWithLever(double damping, double turn_damping, double lever) {
  return 1.0 / (1.0 / damping + lever * lever / turn_damping);
}

ForceRenderer::ForceRenderer(const ForceOptions& options) : options_(options) { requireUsable(options_); }

RenderedForce ForceRenderer::render(const ForceInputs& inputs, const DeviceWrench& sent, const Instant& now) {
  const double period = toSeconds(rendered_ ? std::min(now.steady - *rendered_, 2 * options_.period) : options_.period);
  rendered_ = now.steady;
  RenderedForce rendered;
  rendered.permission = decideForce(inputs, now, options_);
  const DeviceWrench before = faded_ ? unfaded_ : sent;
  if (inputs.known.pose) {
    measureVelocity(*inputs.known.pose);
    measureDelay(inputs.known.pose->timestamps, now);
  }
  if (!(rendered.permission.gain > 0.0)) {
    faded_ = false;
    return rendered;
  }
  const MotionInputs& known = inputs.known;
  const PiecePoses poses{known.pose->X_WT, inputs.placed ? inputs.placed->tool : nullptr};
  const ToolForce force = finder_.find(*known.planes, *known.tool, poses, twist_W_, options_.law);
  DeviceWrench wanted = atDevice(force, inputs.R_WD);
  rendered.depth = force.depth;
  rendered.delay = fromSeconds(delay_) + options_.output_delay;
  rendered.stiffness_gain = stiffnessGain(wanted);
  wanted.force_D *= rendered.stiffness_gain;
  wanted.torque_D *= rendered.stiffness_gain;
  unfaded_ = clamped(wanted, rendered.permission.gain < 1.0 ? before : sent, period);
  faded_ = rendered.permission.gain < 1.0;
  rendered.wrench = {rendered.permission.gain * unfaded_.force_D, rendered.permission.gain * unfaded_.torque_D};
  return rendered;
}

void ForceRenderer::measureVelocity(const MotionInputs::ToolPose& pose) {
  const StampedPose sample{pose.timestamps.stamp, pose.X_WT};
  const double interval = newest_ ? toSeconds(sample.stamp - newest_->stamp) : -1.0;
  if (interval == 0.0) return;
  if (interval < 0.0 || interval > kMaxPause) {
    twist_W_ = {};
  } else {
    const double weight = 1.0 - std::exp(-interval / kVelocityTime);
    const Eigen::AngleAxisd turn(sample.X_WT.linear() * newest_->X_WT.linear().transpose());
    twist_W_.v_W += weight * ((sample.X_WT.translation() - newest_->X_WT.translation()) / interval - twist_W_.v_W);
    twist_W_.w_W += weight * (turn.angle() / interval * turn.axis() - twist_W_.w_W);
  }
  newest_ = sample;
}

void ForceRenderer::measureDelay(const Timestamps& pose, const Instant& now) {
  const double kept = std::exp(-toSeconds(options_.period) / kDelayTime);
  const Duration counted = std::min(age(pose, now), options_.pose_age);  // an older pose makes no force
  delay_ = std::max(toSeconds(counted), kept * delay_);
}

double ForceRenderer::stiffnessGain(const DeviceWrench& stiff) const {
  const double stiffness = options_.law.stiffness * options_.force_scale * options_.position_scale;
  const SampledDevice device{options_.device_damping, dampingAtDevice(options_), toSeconds(options_.period)};
  const double delay = delay_ + toSeconds(options_.output_delay);
  const double most = maxStiffness(device, delay);
  const double gain = stiffness > most ? most / stiffness : 1.0;
  const double force = stiff.force_D.norm();
  if (!(options_.max_torque > 0.0) || !(force > 0.0)) return gain;
  const double damping =
      dampingWithLever(options_.device_damping, options_.device_turn_damping, stiff.torque_D.norm() / force);
  return std::min(gain, damping / (stiffness * (device.period / 2 + delay) + device.virtual_damping));
}

// A lever at the device is that at the tool / position_scale.
DeviceWrench ForceRenderer::atDevice(const ToolForce& force, const Eigen::Matrix3d& R_WD) const {
  return {options_.force_scale * (R_WD.transpose() * force.force_W),
          options_.force_scale / options_.position_scale * (R_WD.transpose() * force.torque_W)};
}

DeviceWrench ForceRenderer::clamped(const DeviceWrench& wanted, const DeviceWrench& before, double period) const {
  const Eigen::Vector3d force_D = clampedTo(wanted.force_D, options_.max_force);
  const Eigen::Vector3d torque_D = clampedTo(wanted.torque_D, options_.max_torque);
  return {before.force_D + clampedTo(force_D - before.force_D, options_.max_force_rate * period),
          before.torque_D + clampedTo(torque_D - before.torque_D, options_.max_torque_rate * period)};
}

}  // namespace sweep_guard_core
