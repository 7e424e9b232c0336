#include "sweep_guard/ros/warning_output.h"

#include <std_msgs/Bool.h>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

constexpr auto kPeriod = std::chrono::milliseconds(45);  // with the watchdog's: 20 Hz at least
constexpr auto kValid = std::chrono::milliseconds(200);

std_msgs::Bool flagMessage(bool raised) {
  std_msgs::Bool msg;
  msg.data = raised;
  return msg;
}

}  // namespace

WarningOutput::WarningOutput(ros::NodeHandle private_node, const LiveParameters& parameters,
                             const sweep_guard::Ledger& ledger)
    : parameters_(parameters),
      ledger_(ledger),
      warning_publisher_(private_node.advertise<sweep_guard::Warning>("warning", 10)),
      reflex_publisher_(private_node.advertise<std_msgs::Bool>("reflex_warning", 10)),
      considered_publisher_(private_node.advertise<std_msgs::Bool>("considered_warning", 10)) {}

void WarningOutput::warnOfChange() {
  const std::lock_guard lock(mutex_);
  warn(/*only_on_change=*/true);
}

void WarningOutput::warnInTime() {
  const std::lock_guard lock(mutex_);
  const bool due = std::chrono::steady_clock::now() - warned_ >= kPeriod;
  warn(/*only_on_change=*/!due);
}

void WarningOutput::repeatReflex() { repeat(reflex_publisher_, &sweep_guard::Warning::reflex); }

void WarningOutput::repeatConsidered() { repeat(considered_publisher_, &sweep_guard::Warning::considered); }

void WarningOutput::repeat(const ros::Publisher& publisher, Flag flag) {
  const std::lock_guard lock(mutex_);
  warn(/*only_on_change=*/true);
  publisher.publish(flagMessage(warning_.*flag != 0));
}

// Under the lock.
void WarningOutput::warn(bool only_on_change) {
  const sweep_guard::Instant at = now();
  ledger_.verdict(at, verdict_);
  const bool new_level = static_cast<std::uint8_t>(verdict_.level) != warning_.level;
  if (only_on_change && !new_level && verdict_.reasons == warning_.reasons) return;
  const auto parameters = parameters_.get();
  sweep_guard::Warning next = toMsg(verdict_);
  if (verdict_.tool_part) next.tool_link = parameters->tool->parts()[*verdict_.tool_part].link;
  next.header.frame_id = parameters->fixed_frame;
  next.tool = parameters->tool_frame;
  next.sequence = warning_.sequence + (new_level ? 1 : 0);
  next.level_counts = warning_.level_counts;
  if (new_level) ++next.level_counts[next.level];
  next.valid_until = toMsg(at.stamp + kValid);
  const bool reflex_rises = next.reflex && !warning_.reflex;
  const bool considered_rises = next.considered && !warning_.considered;
  warning_ = next;
  warned_ = at.steady;
  warning_publisher_.publish(next);
  if (reflex_rises) reflex_publisher_.publish(flagMessage(true));
  if (considered_rises) considered_publisher_.publish(flagMessage(true));
}

}  // namespace sweep_guard_ros
