#include "ros/output/warning_publisher.h"

#include <std_msgs/Bool.h>

#include "common/stage_clock.h"
#include "ros/output/flush.h"
#include "ros/output/run_id.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::InStage;
using sweep_guard_core::Stage;

constexpr auto kPeriod = std::chrono::milliseconds(45);  // 20 Hz at least, polled every 10 ms

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
      considered_publisher_(private_node.advertise<std_msgs::Bool>("considered_warning", 10)) {
  message_.run_id = randomRunId();
}

void WarningPublisher::publishIfChanged() {
  const sweep_guard_core::Lock lock(mutex_);
  publish(/*only_if_changed=*/true);
}

void WarningPublisher::publishIfDue() {
  const sweep_guard_core::Lock lock(mutex_);
  const bool due = std::chrono::steady_clock::now() - published_ >= kPeriod;
  publish(/*only_if_changed=*/!due);
}

void WarningPublisher::publishFinal() {
  {
    const sweep_guard_core::Lock lock(mutex_);
    publish(/*only_if_changed=*/false);
  }
  publishReflex();
  publishConsidered();
  flush();
}

void WarningPublisher::publishReflex() { publishFlag(reflex_publisher_, &sweep_guard::Warning::reflex); }

void WarningPublisher::publishConsidered() { publishFlag(considered_publisher_, &sweep_guard::Warning::considered); }

void WarningPublisher::publishFlag(const ros::Publisher& publisher, Flag flag) {
  const sweep_guard_core::Lock lock(mutex_);
  publish(/*only_if_changed=*/true);
  publisher.publish(flagMessage(message_.*flag != 0));
}

// Called under the lock.
void WarningPublisher::publish(bool only_if_changed) {
  const InStage monitoring(Stage::kMonitor);
  const sweep_guard_core::Instant at = now();
  monitor_.warning(at, warning_);
  const bool new_level = static_cast<std::uint8_t>(warning_.level) != message_.level;
  const bool changed =
      new_level || warning_.reasons != message_.reasons || warning_.held_since.has_value() != (message_.held != 0) ||
      warning_.acknowledged != (message_.acknowledged != 0) || warning_.intended != (message_.intended != 0);
  if (only_if_changed && !changed) return;
  const InStage publishing(Stage::kPublish);
  const auto parameters = parameters_.get();
  sweep_guard::Warning next = toMsg(warning_);
  if (warning_.tool_piece) next.tool_link = linkOf(*parameters->tool, *warning_.tool_piece);
  next.header.frame_id = parameters->fixed_frame;
  next.tool = parameters->tool_frame;
  next.sequence = message_.sequence + (new_level ? 1 : 0);
  next.level_counts = message_.level_counts;
  next.run_id = message_.run_id;
  if (new_level) ++next.level_counts[next.level];
  next.valid_until = toMsg(at.stamp + sweep_guard_core::kWarningValid);
  const bool reflex_rises = next.reflex && !message_.reflex;
  const bool considered_rises = next.considered && !message_.considered;
  message_ = next;
  published_ = at.steady;
  warning_publisher_.publish(next);
  if (reflex_rises) reflex_publisher_.publish(flagMessage(true));
  if (considered_rises) considered_publisher_.publish(flagMessage(true));
}

}  // namespace sweep_guard_ros
