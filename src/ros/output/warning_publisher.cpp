#include "ros/output/warning_publisher.h"

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

WarningPublisher::WarningPublisher(ros::NodeHandle private_node, const LiveParameters& parameters,
                                   const sweep_guard_core::WarningMonitor& monitor)
    : parameters_(parameters),
      monitor_(monitor),
      warning_publisher_(private_node.advertise<sweep_guard::Warning>("warning", 10)),
      reflex_publisher_(private_node.advertise<std_msgs::Bool>("reflex_warning", 10)),
      considered_publisher_(private_node.advertise<std_msgs::Bool>("considered_warning", 10)) {}

void WarningPublisher::warnOfChange() {
  const std::lock_guard lock(mutex_);
  warn(/*only_on_change=*/true);
}

void WarningPublisher::warnInTime() {
  const std::lock_guard lock(mutex_);
  const bool due = std::chrono::steady_clock::now() - warned_ >= kPeriod;
  warn(/*only_on_change=*/!due);
}

void WarningPublisher::repeatReflex() { repeat(reflex_publisher_, &sweep_guard::Warning::reflex); }

void WarningPublisher::repeatConsidered() { repeat(considered_publisher_, &sweep_guard::Warning::considered); }

void WarningPublisher::repeat(const ros::Publisher& publisher, Flag flag) {
  const std::lock_guard lock(mutex_);
  warn(/*only_on_change=*/true);
  publisher.publish(flagMessage(message_.*flag != 0));
}

// Under the lock.
void WarningPublisher::warn(bool only_on_change) {
  const sweep_guard_core::Instant at = now();
  monitor_.warning(at, warning_);
  const bool new_level = static_cast<std::uint8_t>(warning_.level) != message_.level;
  if (only_on_change && !new_level && warning_.reasons == message_.reasons) return;
  const auto parameters = parameters_.get();
  sweep_guard::Warning next = toMsg(warning_);
  if (warning_.tool_piece) next.tool_link = parameters->tool->pieces()[*warning_.tool_piece].link;
  next.header.frame_id = parameters->fixed_frame;
  next.tool = parameters->tool_frame;
  next.sequence = message_.sequence + (new_level ? 1 : 0);
  next.level_counts = message_.level_counts;
  if (new_level) ++next.level_counts[next.level];
  next.valid_until = toMsg(at.stamp + kValid);
  const bool reflex_rises = next.reflex && !message_.reflex;
  const bool considered_rises = next.considered && !message_.considered;
  message_ = next;
  warned_ = at.steady;
  warning_publisher_.publish(next);
  if (reflex_rises) reflex_publisher_.publish(flagMessage(true));
  if (considered_rises) considered_publisher_.publish(flagMessage(true));
}

}  // namespace sweep_guard_ros
