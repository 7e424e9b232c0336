#include "ros/motion/motion_guard_node.h"

#include <ros/console.h>

#include "ros/output/flush.h"

namespace sweep_guard_ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr auto kHoldPeriod = std::chrono::milliseconds(20);
constexpr auto kStatusPeriod = std::chrono::milliseconds(10);
constexpr auto kDiagnosticsPeriod = std::chrono::seconds(1);
constexpr size_t kMaxTransforms = 64 << 20;  // size of a message [bytes]

}  // namespace

MotionGuardNode::MotionGuardNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Process process)
    : parameters_(loadMotionParameters(private_node)),
      master_watch_(private_node, [this] { return parameters_.settings; }),
      supervisor_(process),
      frames_(node, kMaxTransforms, [](const std::string& /*parent*/, const std::string& /*child*/) {}),
      guard_(node, parameters_.guard, parameters_.tool),
      tool_pose_(isOfJoints(parameters_.command_type)
                     ? nullptr
                     : std::make_unique<ToolPoseInput>(node, parameters_.tool, frames_)),
      joints_(tool_pose_ ? nullptr
                         : std::make_unique<JointInput>(node, parameters_.joint_source, parameters_.options.silence)),
      status_(private_node, parameters_.tool.fixed_frame),
      hold_(private_node),
      cycle_(node, private_node, parameters_, {guard_, tool_pose_.get(), joints_.get(), frames_, status_}),
      output_watch_(cycle_.port().guardedTopic()),
      updater_(node, private_node, private_node.getNamespace()) {
  updater_.setHardwareID("none");
  updater_.add("motion", [this](DiagnosticsLine& line) { motion(line); });
  updater_.add("command", [this](DiagnosticsLine& line) { command(line); });
  updater_.add("output", [this](DiagnosticsLine& line) { output(line); });
  updater_.add("guard", [this](DiagnosticsLine& line) { guard_.report(line); });
  if (tool_pose_)
    updater_.add("tool pose", [this](DiagnosticsLine& line) { reportPose(*tool_pose_, "tool pose", line); });
  if (joints_) updater_.add("joints", [this](DiagnosticsLine& line) { joints_->report(line); });
  ticks_.every(CommandCycle::kTickPeriod, [this] { cycle_.tick(); });
  ticks_.every(kHoldPeriod, [this] { cycle_.publishHold(hold_); });
  ticks_.every(kHoldPeriod, [this] { frames_.checkClock(); });
  ticks_.every(kStatusPeriod, [this] { status_.publishIfDue(); });
  reports_.every(kDiagnosticsPeriod, [this] { updater_.force_update(); });
}

// Not in the constructor: where one thread cannot be started, the destructor ends the others.
void MotionGuardNode::start() {
  frames_.start(supervisor_);
  guard_.start(supervisor_);
  if (tool_pose_) tool_pose_->start(supervisor_);
  if (joints_) joints_->start(supervisor_);
  cycle_.start(supervisor_);
  ticks_.start(supervisor_, {"ticks", sweep_guard_core::Stage::kPublish});
  reports_.start(supervisor_, {"reports", sweep_guard_core::Stage::kPublish});
  output_watch_.start(supervisor_);
  master_watch_.start(supervisor_);
  supervisor_.start();
  ROS_INFO("guarding the motion of %s'%s' in '%s': commands from %s, guarded ones to %s, planes from %s",
           joints_ ? "the links below " : "", parameters_.tool.frame.c_str(), parameters_.tool.fixed_frame.c_str(),
           cycle_.port().commandTopic().c_str(), cycle_.port().guardedTopic().c_str(), parameters_.guard.c_str());
}

MotionGuardNode::~MotionGuardNode() {
  ticks_.stop();
  cycle_.stop();
  flush();  // the zero first
  hold_.hold();
  flush();
  reports_.stop();
  master_watch_.stop();  // its thread uses the supervisor, which is declared after it
}

void MotionGuardNode::motion(DiagnosticsLine& line) const {
  const sweep_guard::MotionStatus newest = status_.newest();
  const bool stopped =
      newest.code == sweep_guard::MotionStatus::HALT_FOR_COLLISION || newest.code == sweep_guard::MotionStatus::INVALID;
  line.summary(stopped ? DiagnosticStatus::WARN : DiagnosticStatus::OK, newest.text);
  line.add("code", static_cast<int>(newest.code));
  line.addf("scale", "%.3f", newest.scale);
  line.addf("age of planes [s]", "%.3f", newest.planes_age);
  for (const auto& [cause, count] : status_.counts()) line.add("began: " + cause, count);
}

void MotionGuardNode::command(DiagnosticsLine& line) const {
  const CommandPort& port = cycle_.port();
  const sweep_guard_core::InputRecord::Summary record = cycle_.record().summary();
  line.summary(DiagnosticStatus::OK, silent(record) ? "no command now" : "received");
  const std::string rarity = cycle_.rarity();
  if (!rarity.empty()) line.summary(DiagnosticStatus::WARN, rarity);
  if (port.commandPublishers() == 0) line.summary(DiagnosticStatus::WARN, "no publisher on " + port.commandTopic());
  if (port.commandPublishers() > 1) {
    line.summary(DiagnosticStatus::WARN, "several publishers on " + port.commandTopic() + ": use a multiplexer");
  }
  line.add("topic", port.commandTopic());
  line.add("publishers", port.commandPublishers());
  line.addf("period that is counted on [s]", "%.4f", sweep_guard_core::toSeconds(cycle_.period()));
  addRecord("command", record, line);
}

void MotionGuardNode::output(DiagnosticsLine& line) const {
  const CommandPort& port = cycle_.port();
  reportOutput(output_watch_, port.guardedSubscribers(), "motion_guard", "nothing is moved", line);
}

}  // namespace sweep_guard_ros
