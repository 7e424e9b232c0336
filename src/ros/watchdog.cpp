#include "ros/watchdog.h"

#include <ros/console.h>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

constexpr auto kPeriod = std::chrono::milliseconds(10);  // largest delay until a silent input is noticed
constexpr auto kReflexPeriod = std::chrono::milliseconds(100);
constexpr auto kConsideredPeriod = std::chrono::seconds(1);
constexpr auto kClockJump = std::chrono::milliseconds(100);

}  // namespace

Watchdog::Watchdog(sweep_guard_core::WarningMonitor& monitor, sweep_guard_core::WorkpieceStore& workpieces,
                   WarningPublisher& warnings)
    : monitor_(monitor), workpieces_(workpieces), warnings_(warnings) {
  thread_.every(kPeriod, [this] {
    checkClock();
    warnings_.publishIfDue();
  });
  thread_.every(kReflexPeriod, [this] { warnings_.publishReflex(); });
  thread_.every(kConsideredPeriod, [this] { warnings_.publishConsidered(); });
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
