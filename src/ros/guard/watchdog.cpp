#include "ros/guard/watchdog.h"

#include <ros/console.h>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

constexpr auto kWatchPeriod = std::chrono::milliseconds(10);  // largest delay until a silent input is noticed
constexpr auto kReflexPeriod = std::chrono::milliseconds(100);
constexpr auto kConsideredPeriod = std::chrono::seconds(1);

}  // namespace

Watchdog::Watchdog(GuardState& state, const std::function<void()>& often) : state_(state) {
  thread_.every(kWatchPeriod, [this, often] {
    checkClock();
    often();
    state_.warnings.publishIfDue();
  });
  thread_.every(kReflexPeriod, [this] { state_.warnings.publishReflex(); });
  thread_.every(kConsideredPeriod, [this] { state_.warnings.publishConsidered(); });
}

void Watchdog::checkClock() {
  const auto jump = clocks_.jump(now().stamp, sweep_guard_core::suspendedTime());
  // After it: a pose that comes after the jump was reported must not find transforms from before.
  state_.frames.checkClock();
  if (!jump) return;
  // First: whoever sees the jump in a warning may send a workpiece with a stamp that counts.
  state_.workpieces.clearStamps();
  state_.monitor.timeJumped(*jump);
  ROS_WARN("%s: tool poses are forgotten, workpieces with a timeout are stale", jump->c_str());
}

}  // namespace sweep_guard_ros
