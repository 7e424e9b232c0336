#pragma once

#include <vector>

#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

/// Sets the length and the steps of the prediction: the reflex interval, up to `reflex`, in small steps, then the
/// considered interval, up to `considered`, in larger ones [P, Sec. 3.2, Fig. 6]. Both are counted from now, not from
/// the newest pose.
struct HorizonOptions {
  Duration reflex = std::chrono::milliseconds(100);           ///< end of the reflex interval, > 0
  Duration reflex_step = std::chrono::milliseconds(10);       ///< nominal length of its sweeps, > 0
  Duration considered = std::chrono::milliseconds(1000);      ///< end of the considered interval, > reflex
  Duration considered_step = std::chrono::milliseconds(100);  ///< nominal length of its sweeps, > 0
  /// Time until the next prediction; the prediction reaches beyond `considered` by this, >= 0.
  Duration reserve = std::chrono::milliseconds(100);
};

/// Holds the end times of the predicted sweeps. The first sweep begins at the newest pose, each other one where the one
/// before ends.
struct Horizon {
  std::vector<Duration> ends;  ///< after the newest pose, ascending
  size_t reflex_sweeps = 0;    ///< number of sweeps, from the first, that end within the reflex interval
};

/// Checks the options.
/// @throws InvalidInput if an option is out of range, or if `reflex` + `reserve` or `considered` + `reserve` is 10000
///     of its steps or longer
void check(const HorizonOptions& options);

/// Returns the number of sweeps from a pose of this age to the end of the reflex interval. Ages beyond the
/// reserve count as the reserve; each sweep may then be longer than the reflex step.
/// @param options  accepted by check()
/// @param age      >= 0 (asserted)
size_t reflexSweeps(const HorizonOptions& options, Duration age);

/// Returns the number of sweeps from the end of the reflex interval to that of the reserve, at the configured step.
/// @param options  accepted by check()
size_t consideredSweeps(const HorizonOptions& options);

/// Computes the ends of the sweeps up to `considered` + `reserve` from now. The steps of each interval are equal, and as
/// long as configured or shorter; for an age beyond the reserve, the reflex steps may be longer.
/// @param options       accepted by check()
/// @param age           of the newest pose, >= 0 (asserted)
/// @param[out] horizon  overwritten; its buffers are used again
void computeHorizon(const HorizonOptions& options, Duration age, Horizon& horizon);

/// Computes the ends of the sweeps up to exactly `end`. Adds no reserve. Those in the reflex interval are those of
/// computeHorizon(); later ones may differ, but their steps are not longer than configured. The last sweep may be
/// shorter than a step.
/// @param end      counted from now, > 0 (asserted); may lie within the reflex interval
/// @param options  accepted by check(), apart from `considered`, which does not count
/// @param age      of the newest pose, >= 0 (asserted)
Horizon horizonUpTo(Duration end, HorizonOptions options, Duration age);

}  // namespace sweep_guard_core
