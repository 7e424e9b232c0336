#include "ros/watchdog.h"

#include <ros/console.h>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

const ros::WallDuration kPeriod(0.01);  // largest delay until a silent input is noticed
const ros::WallDuration kReflexPeriod(0.1);
const ros::WallDuration kConsideredPeriod(1.0);

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
  const auto jump = clocks_.jump(now().stamp, suspendedTime());
  if (!jump) return;
  ROS_WARN("%s: tool poses are forgotten, workpieces with a timeout are stale", jump->c_str());
  monitor_.timeJumped(*jump);
  workpieces_.clearStamps();
}

}  // namespace sweep_guard_ros
