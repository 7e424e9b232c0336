#include "ros/motion/joint_input.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "ros/input/future_stamp.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::printable;
using sweep_guard_core::Timestamps;

constexpr char kTopic[] = "joint_states";
constexpr std::uint32_t kStatesQueued = 100;  // several nodes may each publish some of the joints
constexpr size_t kMaxStateSize = 1 << 20;
constexpr double kMaxPosition = 1e10;  // [rad or m]: a double resolves 2e-6 rad there

}  // namespace

JointInput::JointInput(const ros::NodeHandle& node, JointSource source, sweep_guard_core::Duration silence)
    : source_(std::move(source)),
      silence_(silence),
      joints_(source_.tree->variables().size()),
      subscriber_(subscribeBounded<sensor_msgs::JointState>(
          thread_.on(node), {kTopic, kStatesQueued, kMaxStateSize},
          [this](const auto& event) { onMessage(event.getPublisherName(), *event.getConstMessage()); },
          [this](const std::string& reason) { refuse(reason); })) {}

void JointInput::onMessage(const std::string& publisher, const sensor_msgs::JointState& msg) try {
  if (source_.names->firstIn(msg) == nullptr) {
    const sweep_guard_core::Lock lock(mutex_);
    return foreign_.note(*source_.names, msg.name);
  }
  Timestamps timestamps{fromMsg(msg.header.stamp), std::chrono::steady_clock::now()};
  if (timestamps.stamp == sweep_guard_core::Time()) throw InvalidInput("stamp is 0: stamp each message");
  if (liesInFuture(timestamps)) throw InvalidInput(kFutureStampText);
  source_.names->find(msg, named_);
  const sweep_guard_core::Lock lock(mutex_);
  for (const auto& each : named_) check(publisher, each, timestamps);
  for (const auto& [variable, position] : named_) joints_[variable] = {position, timestamps, publisher};
  record_.received(timestamps);
} catch (const sweep_guard_core::Error& error) {
  refuse(error.what());
}

void JointInput::check(const std::string& publisher, const sweep_guard_core::JointTimeline::Position& named,
                       const Timestamps& timestamps) {
  const std::string name = "joint '" + printable(source_.names->inMessages(named.variable)) + "'";
  if (!(std::abs(named.value) <= kMaxPosition)) throw InvalidInput(name + ": its position must be finite, within 1e10");
  const Joint& before = joints_[named.variable];
  if (before.publisher.empty() || timestamps.received - before.timestamps.received > silence_) return;
  if (before.publisher != publisher) {
    dispute_ = name + " is published by " + before.publisher + " and " + publisher + ": let one of them";
    disputed_at_ = timestamps.received;
    throw InvalidInput(dispute_);
  }
  if (timestamps.stamp < before.timestamps.stamp) throw InvalidInput(name + ": its stamp is older than the one before");
}

bool JointInput::disputed() const {
  return !dispute_.empty() && std::chrono::steady_clock::now() - disputed_at_ <= silence_;
}

bool JointInput::newest(const sweep_guard_core::PlaneSet& planes, sweep_guard_core::MeasuredJoints& joints) const {
  const auto& variables = source_.tree->variables();
  joints.state.positions.assign(variables.size(), 0.0);
  joints.state.X_WR = planes.X_WT;
  joints.timestamps = {sweep_guard_core::Time::max(), sweep_guard_core::SteadyTime::max()};
  bool heard = false;
  const sweep_guard_core::Lock lock(mutex_);
  for (size_t i = 0; i < planes.joints.size(); ++i) {
    const auto named = [&](const auto& each) { return each.name == planes.joints[i]; };
    const auto variable = std::find_if(variables.begin(), variables.end(), named) - variables.begin();
    if (variable == static_cast<std::ptrdiff_t>(variables.size())) continue;  // JointMotionGuard refuses such planes
    const Joint& joint = joints_[static_cast<size_t>(variable)];
    const bool known = !joint.publisher.empty();
    heard = heard || known;
    joints.state.positions[static_cast<size_t>(variable)] = known ? joint.position : planes.positions[i];
    const Timestamps& measured = known ? joint.timestamps : planes.timestamps;
    joints.timestamps = {std::min(joints.timestamps.stamp, measured.stamp),
                         std::min(joints.timestamps.received, measured.received)};
  }
  return heard && !disputed();
}

void JointInput::report(DiagnosticsLine& line) const {
  const std::string absent = absence();
  line.summary(absent.empty() ? diagnostic_msgs::DiagnosticStatus::OK : diagnostic_msgs::DiagnosticStatus::ERROR,
               absent.empty() ? "received" : absent);
  if (absent.empty() && silent(record_.summary())) line.summary(diagnostic_msgs::DiagnosticStatus::ERROR, "silent");
  line.add("oldest", oldest());
  line.add("topic", subscriber_.getTopic());
  line.add("publishers", subscriber_.getNumPublishers());
  addRecord("joints", record_.summary(), line);
}

std::string JointInput::oldest() const {
  const sweep_guard_core::Lock lock(mutex_);
  const Joint* oldest = nullptr;
  for (const Joint& joint : joints_) {
    if (joint.publisher.empty() || (oldest && joint.timestamps.received >= oldest->timestamps.received)) continue;
    oldest = &joint;
  }
  if (!oldest) return "";
  char text[64];
  std::snprintf(text, sizeof text, "' came %.1f s ago",
                toSeconds(std::chrono::steady_clock::now() - oldest->timestamps.received));
  return "the newest position of joint '" +
         printable(source_.names->inMessages(static_cast<size_t>(oldest - joints_.data()))) + text;
}

std::string JointInput::absence() const {
  {
    const sweep_guard_core::Lock lock(mutex_);
    if (disputed()) return dispute_;
  }
  const sweep_guard_core::InputRecord::Summary record = record_.summary();
  if (record.newest) return "";
  const std::string topic = subscriber_.getTopic();
  if (record.refused > 0) return topic + " refused: " + record.last_error;
  std::vector<std::string> missing;
  for (const auto& variable : source_.tree->variables()) missing.push_back(variable.name);
  const sweep_guard_core::Lock lock(mutex_);
  const std::string others = foreign_.text(missing);
  if (others.empty()) return "nobody publishes the joints of the robot on " + topic;
  return topic + " has none of the joints of the robot, but " + others + ": if they are the same, set tool/joint_names";
}

void JointInput::refuse(const std::string& reason) {
  record_.error(reason, /*refused=*/true);
  log_.error("", "message on " + subscriber_.getTopic() + " refused: " + reason);
}

}  // namespace sweep_guard_ros
