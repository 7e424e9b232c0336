#include "ros/watchdog.h"

#include <ros/console.h>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

const ros::WallDuration kPeriod(0.01);  // largest delay until a silent input is noticed
const ros::WallDuration kReflexPeriod(0.1);
const ros::WallDuration kConsideredPeriod(1.0);
constexpr auto kClockJump = std::chrono::milliseconds(100);

}  // namespace

Watchdog::Watchdog(const ros::NodeHandle& node, sweep_guard_core::WarningMonitor& monitor,
                   sweep_guard_core::WorkpieceStore& workpieces, WarningPublisher& warnings)
    : monitor_(monitor), workpieces_(workpieces), warnings_(warnings) {
  ros::NodeHandle timers = thread_.on(node);
  timer_ = timers.createSteadyTimer(kPeriod, [this](const ros::SteadyTimerEvent&) {
    checkClock();
    warnings_.publishIfDue();
  });
  reflex_timer_ =
      timers.createSteadyTimer(kReflexPeriod, [this](const ros::SteadyTimerEvent&) { warnings_.publishReflex(); });
  considered_timer_ = timers.createSteadyTimer(kConsideredPeriod,
                                               [this](const ros::SteadyTimerEvent&) { warnings_.publishConsidered(); });
}

void Watchdog::checkClock() {
  const sweep_guard_core::Time stamp = now().stamp;
  if (stamp + kClockJump < last_stamp_) {
    ROS_WARN("ROS time went back by %.2f s: tool poses are forgotten, workpieces with a timeout are stale",
             sweep_guard_core::toSeconds(last_stamp_ - stamp));
    monitor_.timeJumped("time went back");
    workpieces_.clearStamps();
  }
  last_stamp_ = stamp;
}

}  // namespace sweep_guard_ros
