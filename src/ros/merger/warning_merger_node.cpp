#include "ros/merger/warning_merger_node.h"

#include <std_msgs/Bool.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "ros/connection/sole_publisher.h"
#include "ros/merger/heard_warning.h"
#include "ros/output/flush.h"
#include "ros/output/run_id.h"
#include "ros/parameters/finish_reading.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/monitor/reason.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using sweep_guard_core::InvalidInput;
using sweep_guard_core::WarningLevel;
using sweep_guard_core::WarningMerger;

constexpr auto kTickPeriod = std::chrono::milliseconds(10);
constexpr auto kPeriod = std::chrono::milliseconds(45);  // 20 Hz at least, looked at in every tick
constexpr auto kFlagPeriod = std::chrono::milliseconds(100);
constexpr auto kReportPeriod = std::chrono::seconds(1);
constexpr size_t kMaxGuards = 64;

std::vector<std::string> readGuards(ParameterReader& read) {
  std::vector<std::string> guards = read.nodes("guards");
  if (guards.empty() || guards.size() > kMaxGuards) {
    throw InvalidInput("parameter guards has " + std::to_string(guards.size()) +
                       " names: set it to the nodes of 1 to 64 guards, as in [/left/sweep_guard, /right/sweep_guard]");
  }
  return guards;
}

sweep_guard_core::Duration readTimeout(ParameterReader& read) {
  const double longest = sweep_guard_core::toSeconds(sweep_guard_core::kWarningValid);
  return sweep_guard_core::fromSeconds(read.number("timeout", longest, {0.05, longest, "s"}));
}

std_msgs::Bool flag(bool raised) {
  std_msgs::Bool message;
  message.data = raised;
  return message;
}

bool differ(const sweep_guard::Warning& a, const sweep_guard::Warning& b) {
  const auto state = [](const sweep_guard::Warning& warning) {
    return std::tie(warning.level, warning.reasons, warning.held, warning.acknowledged, warning.intended);
  };
  return state(a) != state(b);
}

}  // namespace

WarningMergerNode::WarningMergerNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Process process)
    : WarningMergerNode(node, private_node, process, ParameterReader(private_node)) {}

WarningMergerNode::WarningMergerNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Process process,
                                     ParameterReader read)
    : master_watch_(private_node, [this] { return settings_; }),
      supervisor_(process),
      merger_(readGuards(read), readTimeout(read)),
      newest_(merger_.guards().size()),
      updater_(node, private_node, private_node.getNamespace()),
      peer_watch_(master_watch_.thread(), [this] { return aGuardIsSilent(); }) {
  settings_ = finishReading(read);
  published_.run_id = randomRunId();
  publisher_ = ros::NodeHandle(private_node).advertise<sweep_guard::Warning>("warning", 10);
  reflex_ = ros::NodeHandle(private_node).advertise<std_msgs::Bool>("reflex_warning", 10);
  considered_ = ros::NodeHandle(private_node).advertise<std_msgs::Bool>("considered_warning", 10);
  updater_.setHardwareID("none");
  for (size_t guard = 0; guard < newest_.size(); ++guard) {
    subscribers_.push_back(subscribe(node, guard, merger_.guards()[guard] + "/warning"));
    updater_.add(merger_.guards()[guard], [this, guard](Status& status) { report(status, guard); });
  }
  ticks_.every(kTickPeriod, [this] { publish(); });
  ticks_.every(kFlagPeriod, [this] { publishFlags(); });
  reports_.every(kReportPeriod, [this] { updater_.force_update(); });
}

WarningMergerNode::~WarningMergerNode() {
  ticks_.stop();
  reports_.stop();
  master_watch_.stop();  // its thread uses the supervisor, which is declared after it
  {
    const sweep_guard_core::Lock lock(mutex_);
    ending_ = true;
  }
  publish();
  publishFlags();
  flush();
}

void WarningMergerNode::start() {
  thread_.start(supervisor_, {"guards", sweep_guard_core::Stage::kReceive, /*watched=*/true, /*loses_latched=*/false});
  ticks_.start(supervisor_, {"ticks"});
  reports_.start(supervisor_, {"reports", sweep_guard_core::Stage::kPublish});
  master_watch_.start(supervisor_);
  supervisor_.start();
}

BoundedSubscriber WarningMergerNode::subscribe(const ros::NodeHandle& node, size_t guard, const std::string& topic) {
  return subscribeToSole<sweep_guard::Warning>(
      thread_.on(node), topic, sweep_guard_core::kWarningValid,
      [this, guard](const sweep_guard::Warning& message) { hear(guard, message); },
      [this, topic](const std::string& reason) { log_.error(topic, "message on " + topic + " refused: " + reason); });
}

void WarningMergerNode::hear(size_t guard, const sweep_guard::Warning& message) {
  sweep_guard_core::HeardWarning warning = heardFrom(message);
  {
    const sweep_guard_core::Lock lock(mutex_);
    merger_.hear(guard, std::move(warning));
    newest_[guard] = message;
  }
  publish();
}

void WarningMergerNode::publish() {
  const sweep_guard_core::Lock lock(mutex_);
  const sweep_guard_core::Instant at = now();
  sweep_guard::Warning next = merged(at);
  if (!differ(next, published_) && at.steady - published_at_ < kPeriod) return;
  next.sequence = published_.sequence;
  next.level_counts = published_.level_counts;
  next.run_id = published_.run_id;
  if (next.level != published_.level) {
    ++next.sequence;
    ++next.level_counts[next.level];
  }
  const bool reflex_rises = next.reflex && !published_.reflex;
  const bool considered_rises = next.considered && !published_.considered;
  published_ = next;
  published_at_ = at.steady;
  publisher_.publish(next);
  if (reflex_rises) reflex_.publish(flag(true));
  if (considered_rises) considered_.publish(flag(true));
}

void WarningMergerNode::publishFlags() {
  const sweep_guard_core::Lock lock(mutex_);
  reflex_.publish(flag(published_.reflex != 0));
  considered_.publish(flag(published_.considered != 0));
}

// Called under the lock.
sweep_guard::Warning WarningMergerNode::merged(const sweep_guard_core::Instant& now) const {
  const sweep_guard_core::MergedWarning all = merger_.merged(now);
  sweep_guard::Warning message = all.leader && !ending_ ? newest_[*all.leader] : sweep_guard::Warning();
  message.valid_until = toMsg(all.valid_until);
  if (ending_) {
    setLevel(message, WarningLevel::kUnknown, sweep_guard_core::kDisabled);
    message.time_to_collision = ros::Duration(-1.0);
    message.text = "UNKNOWN: the merger ends";
    return message;
  }
  setLevel(message, all.level, all.reasons);
  message.time_to_collision = all.time_to_collision ? toMsg(*all.time_to_collision) : ros::Duration(-1.0);
  message.covered_until = toMsg(all.covered_until);
  message.acknowledged = all.acknowledged;
  message.intended = all.intended;
  message.seen = orNan(all.seen);
  message.text = all.text;
  return message;
}

bool WarningMergerNode::aGuardIsSilent() const {
  const sweep_guard_core::Lock lock(mutex_);
  const sweep_guard_core::Instant at = now();
  for (size_t guard = 0; guard < newest_.size(); ++guard) {
    if (!merger_.silence(guard, at).empty()) return true;
  }
  return false;
}

void WarningMergerNode::report(Status& status, size_t guard) {
  const sweep_guard_core::Lock lock(mutex_);
  const std::string silence = merger_.silence(guard, now());
  const auto level = static_cast<WarningLevel>(newest_[guard].level);
  status.summary(silence.empty() ? DiagnosticStatus::OK : DiagnosticStatus::ERROR,
                 silence.empty() ? styleOf(level).name : silence);
  status.add("topic", subscribers_[guard].getTopic());
  status.add("publishers", subscribers_[guard].getNumPublishers());
  status.add("text", sweep_guard_core::printable(newest_[guard].text));
}

}  // namespace sweep_guard_ros
