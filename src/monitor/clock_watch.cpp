#include "monitor/clock_watch.h"

#include <algorithm>

#include "common/number_text.h"

namespace sweep_guard_core {
namespace {

constexpr auto kBack = std::chrono::milliseconds(100);
constexpr auto kSuspended = std::chrono::milliseconds(200);
constexpr auto kPauseOfReading = std::chrono::milliseconds(1);  // between readings of the clocks

}  // namespace

std::optional<std::string> ClockWatch::jump(Time stamp, Duration suspended) {
  std::optional<std::string> jump;
  if (stamp + kBack < stamp_) jump = "time went back by " + inSeconds(stamp_ - stamp);
  const Duration slept = suspended - suspended_.value_or(suspended);
  if (slept > kSuspended) jump = "the machine was suspended for " + inSeconds(slept);
  stamp_ = stamp;
  suspended_ = suspended;
  return jump;
}

Duration readClock(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

// A process that is stopped between two readings would take the pause for a suspend.
Duration suspendedTime(ReadClock read) {
  Duration since_start{};
  Duration running = read(CLOCK_MONOTONIC);
  Duration before{};
  do {
    before = running;
    since_start = read(CLOCK_BOOTTIME);
    running = read(CLOCK_MONOTONIC);
  } while (running - before > kPauseOfReading);
  return std::max(since_start - before, Duration::zero());
}

}  // namespace sweep_guard_core
