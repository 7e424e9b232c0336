#include "ros/guard/watchdog.h"

#include <ros/console.h>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

constexpr auto kWatchPeriod = std::chrono::milliseconds(10);  // largest delay until a silent input is noticed
constexpr auto kReflexPeriod = std::chrono::milliseconds(100);
constexpr auto kConsideredPeriod = std::chrono::seconds(1);

}  // namespace

Watchdog::Watchdog(Frames& frames, sweep_guard_core::WorkpieceStore& workpieces,
                   sweep_guard_core::WarningMonitor& monitor, WarningPublisher& warnings,
                   const std::function<void()>& often)
    : frames_(frames), workpieces_(workpieces), monitor_(monitor), warnings_(warnings) {
  thread_.every(kWatchPeriod, [this, often] {
    checkClock();
    often();
    warnings_.publishIfDue();
  });
  thread_.every(kReflexPeriod, [this] { warnings_.publishReflex(); });
  thread_.every(kConsideredPeriod, [this] { warnings_.publishConsidered(); });
}

void Watchdog::checkClock() {
  const auto jump = clocks_.jump(now().stamp, sweep_guard_core::suspendedTime());
  frames_.checkClock();  // after it: a pose that comes after the jump was reported must not find transforms from before
  if (!jump) return;
  workpieces_.clearStamps();  // first: whoever sees the jump in a warning may send a workpiece with a stamp that counts
  monitor_.timeJumped(*jump);
  ROS_WARN("%s: tool poses are forgotten, workpieces with a timeout are stale", jump->c_str());
}

}  // namespace sweep_guard_ros
