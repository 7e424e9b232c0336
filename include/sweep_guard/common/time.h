#pragma once

#include <algorithm>
#include <chrono>

namespace sweep_guard_core {

using Duration = std::chrono::nanoseconds;

/// The clock that stamps poses and meshes (ROS time in the node). It may stop and jump. The core does not read it: it
/// gets readings as values.
struct StampClock {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<StampClock, Duration>;
};

/// A stamp in nanoseconds since the epoch of the clock: 1970 UTC, or time 0 of a simulation. 0 means "no stamp".
using Time = StampClock::time_point;

/// A reading of a clock that never jumps; its epoch is arbitrary. It stands still while the machine is suspended, so an
/// age need not show that: after a suspend, call WarningMonitor::timeJumped().
using SteadyTime = std::chrono::time_point<std::chrono::steady_clock, Duration>;

/// One moment on both clocks. Ages are computed on both and the larger one counts: neither a stopped StampClock nor a
/// late message can make a stamp look fresh.
struct Instant {
  Time stamp;
  SteadyTime steady;
};

/// Holds the times when the sender stamped an input and when it was received.
struct Timestamps {
  Time stamp;
  SteadyTime received;
};

/// Returns the age on the clock on which it is larger. A missing stamp counts as the clock's epoch, so it is very old
/// except early in a simulation.
constexpr Duration age(const Timestamps& input, const Instant& now) {
  return std::max(now.stamp - input.stamp, now.steady - input.received);
}

/// Returns whether the age is larger than `timeout`; Duration::max() never times out.
constexpr bool stale(const Timestamps& input, const Instant& now, Duration timeout) {
  return timeout != Duration::max() && age(input, now) > timeout;
}

constexpr double toSeconds(Duration duration) { return std::chrono::duration<double>(duration).count(); }

/// Rounds to the nearest nanosecond.
/// @param seconds  finite, within +-290 years [s]; not checked
inline Duration fromSeconds(double seconds) {
  return std::chrono::round<Duration>(std::chrono::duration<double>(seconds));
}

}  // namespace sweep_guard_core
