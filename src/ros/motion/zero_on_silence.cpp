#include "ros/motion/zero_on_silence.h"

#include <geometry_msgs/Twist.h>
#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/WrenchStamped.h>

#include <cmath>
#include <utility>

#include "ros/output/flush.h"
#include "ros/parameters/finish_reading.h"

namespace sweep_guard_ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr auto kZeroPeriod = std::chrono::milliseconds(20);
constexpr auto kReportPeriod = std::chrono::seconds(1);
constexpr size_t kMaxCommandSize = 4096;

bool isFinite(const geometry_msgs::Vector3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool isFinite(const geometry_msgs::Twist& twist) { return isFinite(twist.linear) && isFinite(twist.angular); }
bool isFinite(const geometry_msgs::TwistStamped& command) { return isFinite(command.twist); }
bool isFinite(const geometry_msgs::WrenchStamped& command) {
  return isFinite(command.wrench.force) && isFinite(command.wrench.torque);
}

template <typename Msg>
Msg zero() {
  Msg stamped;
  stamped.header.stamp = ros::Time::now();
  return stamped;
}

template <>
geometry_msgs::Twist zero() {
  return {};
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

ZeroOnSilence::ZeroOnSilence(const ros::NodeHandle& node, const ros::NodeHandle& private_node)
    : ZeroOnSilence(node, private_node, ParameterReader(private_node)) {}

ZeroOnSilence::ZeroOnSilence(const ros::NodeHandle& node, const ros::NodeHandle& private_node, ParameterReader read)
    : master_watch_(private_node, [this] { return settings_; }),
      timeout_(sweep_guard_core::fromSeconds(read.number("timeout", 0.1, {0.01, 1.0, "s"}))),
      gaps_(timeout_, "timeout"),
      updater_(node, private_node, private_node.getNamespace()),
      supervisor_(Process::kOwn) {
  const std::string type = read.choice("command_type", "twist", {"twist", "twist_stamped", "wrench_stamped"});
  settings_ = finishReading(read);
  updater_.setHardwareID("none");
  updater_.add("commands", [this](Status& status) { report(status); });
  zeros_.every(kZeroPeriod, [this] { sendZeroIfSilent(); });
  reports_.every(kReportPeriod, [this] { updater_.force_update(); });
  if (type == "twist") relay<geometry_msgs::Twist>(node);
  if (type == "twist_stamped") relay<geometry_msgs::TwistStamped>(node);
  if (type == "wrench_stamped") relay<geometry_msgs::WrenchStamped>(node);
  output_watch_.emplace(output_.getTopic());
}

ZeroOnSilence::~ZeroOnSilence() {
  stopping_ = true;
  input_.shutdown();
  reports_.stop();
  master_watch_.stop();  // its thread uses the supervisor, which is declared after it
  zeros_.stop();
  const sweep_guard_core::Lock lock(mutex_);
  send_zero_();
  flush();
}

void ZeroOnSilence::start() {
  zeros_.start(supervisor_, {"zeros"});
  commands_.start(supervisor_, {"commands"});
  reports_.start(supervisor_, {"reports", sweep_guard_core::Stage::kOther, /*watched=*/false});
  output_watch_->start(supervisor_);
  master_watch_.start(supervisor_);
  supervisor_.start();
}

template <typename Msg>
void ZeroOnSilence::relay(const ros::NodeHandle& node) {
  output_ = ros::NodeHandle(node).advertise<Msg>("output", 1);
  send_zero_ = [this] { output_.publish(zero<Msg>()); };
  input_ = subscribeBounded<Msg>(
      commands_.on(node), {"command", 1, kMaxCommandSize},
      [this](const ros::MessageEvent<const Msg>& event) { pass<Msg>(event.getConstMessage()); },
      [this](const std::string& reason) { refuse(reason); });
}

template <typename Msg>
void ZeroOnSilence::pass(const boost::shared_ptr<const Msg>& command) {
  if (!isFinite(*command)) return refuse("command is not finite");
  const sweep_guard_core::Lock lock(mutex_);
  if (stopping_) return;
  const sweep_guard_core::SteadyTime received = std::chrono::steady_clock::now();
  newest_ = received;
  gaps_.received({sweep_guard_core::Time(), received});
  output_.publish(command);
  ++passed_;
}

void ZeroOnSilence::refuse(const std::string& reason) {
  log_.error("refused", reason + ": zero is sent instead");
  const sweep_guard_core::Lock lock(mutex_);
  if (stopping_) return;
  send_zero_();
  last_refusal_ = reason;
}

void ZeroOnSilence::sendZeroIfSilent() {
  const sweep_guard_core::Lock lock(mutex_);
  if (sweep_guard_core::isSilent(newest_, timeout_, std::chrono::steady_clock::now())) send_zero_();
}

void ZeroOnSilence::report(Status& status) {
  const std::vector<std::string> others = output_watch_->otherPublishers();
  const sweep_guard_core::Lock lock(mutex_);
  const sweep_guard_core::SteadyTime now = std::chrono::steady_clock::now();
  const bool silent = sweep_guard_core::isSilent(newest_, timeout_, now);
  const std::string rarity = gaps_.rarity(now);
  status.summary(silent ? DiagnosticStatus::WARN : DiagnosticStatus::OK,
                 silent ? "no command: zero is sent" : "passed on");
  if (!rarity.empty()) status.summary(DiagnosticStatus::WARN, "zero is sent in between: " + rarity);
  if (output_.getNumSubscribers() == 0)
    status.mergeSummary(DiagnosticStatus::WARN, "no subscriber on " + output_.getTopic());
  if (input_.getNumPublishers() > 1) {
    status.mergeSummary(DiagnosticStatus::ERROR, "several publishers on " + input_.getTopic());
  }
  if (!others.empty()) {
    status.mergeSummary(DiagnosticStatus::ERROR, "several publishers on " + output_.getTopic() + ": " + joined(others));
  }
  if (!last_refusal_.empty())
    status.mergeSummary(DiagnosticStatus::ERROR, "refused: " + std::exchange(last_refusal_, ""));
  status.add("command", input_.getTopic());
  status.add("output", output_.getTopic());
  status.add("passed on", passed_);
}

}  // namespace sweep_guard_ros
