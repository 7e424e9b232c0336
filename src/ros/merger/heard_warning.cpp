#include "ros/merger/heard_warning.h"

#include <cmath>

#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {

using sweep_guard_core::HeardWarning;
using sweep_guard_core::InvalidInput;

HeardWarning heardFrom(const sweep_guard::Warning& message) {
  if (message.level > sweep_guard::Warning::CONTACT) {
    throw InvalidInput("level " + std::to_string(message.level) + " is unknown: its guard is of another version");
  }
  HeardWarning warning;
  warning.level = static_cast<sweep_guard_core::WarningLevel>(message.level);
  warning.reasons = message.reasons;
  warning.stamp = fromMsg(message.header.stamp);
  if (message.time_to_collision >= ros::Duration(0)) {
    warning.time_to_collision = std::chrono::nanoseconds(message.time_to_collision.toNSec());
  }
  warning.covered_until = fromMsg(message.covered_until);
  warning.valid_until = fromMsg(message.valid_until);
  warning.held = message.held != 0;
  warning.acknowledged = message.acknowledged != 0;
  warning.intended = message.intended != 0;
  if (!std::isnan(message.seen)) warning.seen = message.seen;
  warning.text = sweep_guard_core::printable(message.text);
  warning.received = now();
  return warning;
}

}  // namespace sweep_guard_ros
