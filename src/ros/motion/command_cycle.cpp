#include "ros/motion/command_cycle.h"

#include <algorithm>
#include <utility>

#include "ros/connection/own_services.h"
#include "ros/motion/motion_status.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Instant;
using sweep_guard_core::Permission;
using sweep_guard_core::PermissionCause;

constexpr sweep_guard_core::Duration kShortest = std::chrono::milliseconds(1);  // step of a pose
constexpr double kLate = 1.5;                                                   // periods after which a command is late

bool sendsSame(const sweep_guard_core::GuardedMotion& a, const sweep_guard_core::GuardedMotion& b) {
  return a.twist_W == b.twist_W && a.scale == b.scale;
}

}  // namespace

CommandCycle::CommandCycle(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                           const MotionParameters& parameters, const CommandCycleSources& sources)
    : parameters_(parameters),
      sources_(sources),
      topic_(node.resolveName(CommandPort::kTopic)),
      period_(parameters.options.command_timeout),
      gaps_(parameters.options.command_timeout, "command_timeout"),
      port_(makeCommandPort(
          {thread_.on(node), parameters, [this](const auto& message, const auto& at) { onCommand(message, at); },
           [this](const std::string& reason) { refuse(reason); }},
          sources.frames, sources.joints)),
      rebase_(advertiseRebase(thread_.on(private_node))) {}

void CommandCycle::onCommand(const CommandPort::Message& message, const sweep_guard_core::Timestamps& timestamps) {
  record_.received(timestamps);
  const sweep_guard_core::Lock lock(mutex_);
  port_->take(message);
  period_.add(timestamps.received);
  gaps_.received(timestamps);
  const Instant at = now();
  if (!command_) sent_ = at.steady;  // the first one after a pause: a pose moves on only from the second one on
  command_ = timestamps;
  halts_ = 0;
  limitNewest(at, Sending::kNew);
}

void CommandCycle::refuse(const std::string& reason) {
  record_.error(reason, /*refused=*/true);
  log_.error("", "command on " + topic_ + " refused: " + reason);
}

CommandCycle::~CommandCycle() { stop(); }

// The port goes before the thread that calls it.
void CommandCycle::stop() {
  port_->stop();
  const sweep_guard_core::Lock lock(mutex_);
  if (command_ && sent_motion_) sendZero(now());
  command_.reset();
}

void CommandCycle::tick() {
  const sweep_guard_core::Lock lock(mutex_);
  update(now());
}

void CommandCycle::publishHold(HoldPublisher& hold) {
  const sweep_guard_core::Lock lock(mutex_);
  const Instant at = now();
  const bool lets_through = letsThrough(at);
  if (!lets_through) update(at);
  hold.publish(lets_through, at.steady);
}

void CommandCycle::update(const Instant& at) {
  if (!command_) return;
  if (at.steady - command_->received > parameters_.options.command_timeout) return halt(at);
  if (!sent_motion_) return;  // refused
  const bool decided_anew = port_->permission(inputs(), *command_, at).permission != permission_;
  const bool late = !port_->isPose() && at.steady - sent_ > kLate * period_.longest();
  const bool repeats = port_->repeats() && at.steady - published_ >= kRepeatPeriod;
  if (decided_anew || late || repeats) limitNewest(at, repeats ? Sending::kRepeated : Sending::kIfChanged);
}

bool CommandCycle::letsThrough(const Instant& at) {
  return port_->permission(inputs(), {at.stamp, at.steady}, at).permission != Permission::kStop;
}

// A command that is late or repeated is limited again at the next tick.
sweep_guard_core::Duration CommandCycle::longestInForce() const {
  const sweep_guard_core::Duration longest = period_.longest();
  const sweep_guard_core::Duration late =
      port_->isPose() ? longest : std::chrono::duration_cast<sweep_guard_core::Duration>(kLate * longest) + kTickPeriod;
  return port_->repeats() ? std::min(late, kRepeatPeriod + kTickPeriod) : late;
}

sweep_guard_core::Duration CommandCycle::period() const {
  const sweep_guard_core::Lock lock(mutex_);
  return longestInForce();
}

std::string CommandCycle::rarity() const {
  const sweep_guard_core::Lock lock(mutex_);
  return gaps_.rarity(std::chrono::steady_clock::now());
}

ros::ServiceServer CommandCycle::advertiseRebase(ros::NodeHandle node) {
  const auto on_call = [this](Trigger::Request& request, Trigger::Response& response) {
    return onRebase(request, response);
  };
  auto options = ros::AdvertiseServiceOptions::create<Trigger>("rebase", on_call, ros::VoidConstPtr(), nullptr);
  return advertiseOwn(node, options);
}

bool CommandCycle::onRebase(Trigger::Request& /*request*/, Trigger::Response& response) {
  response.success = parameters_.command_type == CommandType::kPoseStamped && parameters_.incremental;
  response.message = response.success ? "the next pose moves nothing"
                                      : "command_type is not pose_stamped, or command_mode is not incremental";
  const sweep_guard_core::Lock lock(mutex_);
  if (response.success) port_->rebase();
  return true;
}

sweep_guard_core::MotionInputs CommandCycle::inputs(sweep_guard::Proximity::ConstPtr* planes) const {
  sweep_guard_core::MotionInputs inputs = sources_.guard.inputs(planes);
  if (sources_.tool_pose != nullptr) inputs.pose = sources_.tool_pose->newest();
  return inputs;
}

void CommandCycle::limitNewest(const Instant& at, Sending sending) {
  sweep_guard::Proximity::ConstPtr planes;
  const sweep_guard_core::MotionInputs known = inputs(&planes);
  try {
    const sweep_guard_core::GuardedMotion motion = port_->limit(known, *command_, cycleAt(at));
    if (sending != Sending::kIfChanged || port_->isPose() || !sent_motion_ || !sendsSame(*sent_motion_, motion)) {
      port_->send(motion, /*again=*/sending != Sending::kNew);
      published_ = at.steady;
    }
    sent_motion_ = motion;
    permission_ = motion.decision.permission;
    sweep_guard::MotionStatus status = statusOf(motion, planes.get(), port_->standingLead());
    explain(motion.decision.cause, at, status);
    sources_.status.update(std::move(status));
  } catch (const sweep_guard_core::Error& error) {
    if (sending == Sending::kNew) record_.error(error.what(), /*refused=*/true);
    sendZero(at);
    sources_.status.update(refusedStatus(error.what()));
  }
  sent_ = at.steady;
}

// What is done does not change, but what to do about it is said.
void CommandCycle::explain(PermissionCause cause, const Instant& at, sweep_guard::MotionStatus& status) const {
  std::string why;
  if (cause == PermissionCause::kNoWarning) why = sources_.guard.absence();
  if (cause == PermissionCause::kOldCommand) why = gaps_.tooOld(at);
  const bool no_pose = cause == PermissionCause::kNoPose || cause == PermissionCause::kPoseSilent;
  if (no_pose && sources_.tool_pose != nullptr) why = sources_.tool_pose->standstill();
  if (cause == PermissionCause::kNoJoints) why = sources_.joints->absence();
  if (cause == PermissionCause::kJointsSilent || cause == PermissionCause::kOldJoints)
    why = std::string(textOf(cause)) + ": " + sources_.joints->oldest();
  if (!why.empty()) status.text = "stopped: " + why;
}

CommandPort::Cycle CommandCycle::cycleAt(const Instant& at) const {
  const sweep_guard_core::Duration period = longestInForce();
  return {at, std::clamp(at.steady - sent_, kShortest, period), period};
}

void CommandCycle::sendZero(const Instant& at) {
  port_->sendZero(inputs(), cycleAt(at));
  sent_motion_.reset();
  permission_ = Permission::kStop;
  sent_ = at.steady;
  published_ = at.steady;
}

// At the period that the commands had.
void CommandCycle::halt(const Instant& at) {
  if (halts_ > 0 && at.steady - sent_ < period_.mean()) return;
  sendZero(at);
  sweep_guard::MotionStatus status = idleStatus({Permission::kStop, PermissionCause::kOldCommand});
  explain(PermissionCause::kOldCommand, at, status);
  sources_.status.update(std::move(status));
  ++halts_;
  if (parameters_.halt_messages == 0 || halts_ < parameters_.halt_messages) return;
  command_.reset();
  port_->pause();
}

}  // namespace sweep_guard_ros
