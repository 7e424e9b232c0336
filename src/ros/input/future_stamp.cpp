#include "ros/input/future_stamp.h"

#include <ros/time.h>

#include "common/heartbeat.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

constexpr auto kMaxClockDelay = std::chrono::milliseconds(500);
constexpr double kPause = 0.001;  // [s]

}  // namespace

bool liesInFuture(sweep_guard_core::Timestamps& input) {
  const sweep_guard_core::Time stamp = input.stamp;
  const sweep_guard_core::Instant begin = now();
  const bool begun = begin.stamp != sweep_guard_core::Time();
  const bool may_wait = ros::Time::isSimTime() && (!begun || stamp <= begin.stamp + kMaxClockDelay);
  sweep_guard_core::Instant at = begin;
  while (may_wait && stamp > at.stamp + kFutureTolerance && at.steady < begin.steady + kMaxClockDelay) {
    ros::WallDuration(kPause).sleep();
    sweep_guard_core::beat();
    at = now();
    input.received = at.steady;
  }
  return stamp > at.stamp + kFutureTolerance;
}

}  // namespace sweep_guard_ros
