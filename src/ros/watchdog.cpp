#include "ros/watchdog.h"

#include <ros/console.h>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

const ros::WallDuration kPeriod(0.01);  // how late a silent input may be noticed
const ros::WallDuration kReflexPeriod(0.1);
const ros::WallDuration kConsideredPeriod(1.0);
constexpr auto kClockJump = std::chrono::milliseconds(100);

}  // namespace

Watchdog::Watchdog(const ros::NodeHandle& node, sweep_guard_core::WarningMonitor& monitor, WorkpieceStore& workpieces,
                   WarningPublisher& warnings)
    : monitor_(monitor), workpieces_(workpieces), warnings_(warnings) {
  ros::NodeHandle here = thread_.on(node);
  timer_ = here.createSteadyTimer(kPeriod, [this](const ros::SteadyTimerEvent&) {
    watchClock();
    warnings_.warnInTime();
  });
  reflex_timer_ =
      here.createSteadyTimer(kReflexPeriod, [this](const ros::SteadyTimerEvent&) { warnings_.repeatReflex(); });
  considered_timer_ =
      here.createSteadyTimer(kConsideredPeriod, [this](const ros::SteadyTimerEvent&) { warnings_.repeatConsidered(); });
}

void Watchdog::watchClock() {
  const sweep_guard_core::Time stamp = now().stamp;
  if (stamp + kClockJump < clock_seen_) {
    ROS_WARN("ROS time went back by %.2f s: poses are forgotten, workpieces that may go stale are",
             sweep_guard_core::toSeconds(clock_seen_ - stamp));
    monitor_.timeJumped("time went back");
    workpieces_.timeJumped();
  }
  clock_seen_ = stamp;
}

}  // namespace sweep_guard_ros
