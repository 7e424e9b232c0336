#include "ros/clock_watch.h"

#include <algorithm>
#include <cstdio>

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Duration;

constexpr auto kBack = std::chrono::milliseconds(100);
constexpr auto kSuspended = std::chrono::milliseconds(200);
constexpr auto kPauseOfReading = std::chrono::milliseconds(1);  // between readings of the clocks

std::string inSeconds(const char* text, Duration duration) {
  char message[80];
  std::snprintf(message, sizeof message, text, sweep_guard_core::toSeconds(duration));
  return message;
}

}  // namespace

std::optional<std::string> ClockWatch::jump(sweep_guard_core::Time stamp, Duration suspended) {
  std::optional<std::string> jump;
  if (stamp + kBack < stamp_) jump = inSeconds("time went back by %.2f s", stamp_ - stamp);
  const Duration slept = suspended - suspended_.value_or(suspended);
  if (slept > kSuspended) jump = inSeconds("the machine was suspended for %.2f s", slept);
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

}  // namespace sweep_guard_ros
