#include "ros/input/checked_header.h"

#include "ros/input/future_stamp.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {

using sweep_guard_core::InvalidInput;

void checkHeader(const std_msgs::Header& header) {
  if (header.frame_id.empty()) throw InvalidInput("header.frame_id is empty: name the frame of the vertices");
  if (!sweep_guard_core::isName(header.frame_id))
    throw InvalidInput("header.frame_id has more than 128 or unprintable characters");
  sweep_guard_core::Timestamps timestamps{fromMsg(header.stamp), {}};
  if (liesInFuture(timestamps)) throw InvalidInput(kFutureStampText);
}

}  // namespace sweep_guard_ros
