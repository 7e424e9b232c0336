#pragma once

#include <chrono>

namespace sweep_guard_core {

using Duration = std::chrono::nanoseconds;

/// The clock that stamps poses and meshes (ROS time in the node). It may stop and jump; it is read by the shell and
/// handed down as a value, so that the core never waits and a test needs no time.
struct StampClock {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<StampClock, Duration>;
};

/// A stamp, in integer nanoseconds since the epoch of the stamps; 0 means "no stamp".
using Time = StampClock::time_point;

/// A reading of a clock that never stops or jumps.
using SteadyTime = std::chrono::time_point<std::chrono::steady_clock, Duration>;

/// One moment on both clocks. An age is taken on both and the larger counts: a stamp cannot look fresh because its
/// clock stopped, nor because the message came late.
struct Instant {
  Time stamp;
  SteadyTime steady;
};

constexpr double toSeconds(Duration duration) { return std::chrono::duration<double>(duration).count(); }

/// @param seconds  finite, within +-290 years [s]
inline Duration fromSeconds(double seconds) {
  return std::chrono::round<Duration>(std::chrono::duration<double>(seconds));
}

}  // namespace sweep_guard_core
