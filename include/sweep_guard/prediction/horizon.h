#pragma once

#include <vector>

#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

/// How far and how finely is looked ahead: the reflex interval in small steps, then the considered interval in larger
/// ones [P, Sec. 3.2, Fig. 6]. Counted from now, not from the newest pose.
struct HorizonOptions {
  Duration reflex = std::chrono::milliseconds(100);           ///< end of the reflex interval, > 0
  Duration reflex_step = std::chrono::milliseconds(10);       ///< > 0
  Duration considered = std::chrono::milliseconds(1000);      ///< end of the considered interval, > reflex
  Duration considered_step = std::chrono::milliseconds(100);  ///< > 0
  /// How long a prediction must serve until the next one comes: it looks so much farther than `considered`; >= 0.
  Duration reserve = std::chrono::milliseconds(100);
};

/// Ends of the predicted sweeps. They follow on each other and begin at the newest pose: nothing is left out.
struct Horizon {
  std::vector<Duration> ends;  ///< after the newest pose, ascending
  size_t reflex_sweeps = 0;    ///< the first so many end within the reflex interval
};

/// @throws InvalidInput if an option is out of range, or if an interval takes more than 10000 sweeps
void check(const HorizonOptions& options);

/// Number of sweeps that the reflex interval takes from a pose of this age on. From a pose that is older than the
/// reserve they are as many as from one of that age, and longer than the reflex step.
/// @param age  >= 0
size_t reflexSweeps(const HorizonOptions& options, Duration age);

/// Number of sweeps that the considered interval, reserve included, takes at its configured step.
size_t consideredSweeps(const HorizonOptions& options);

/// At the configured steps, or equal ones a little shorter.
/// @param age  of the newest pose, >= 0
/// @param[out] horizon  what was in it is replaced
void horizon(const HorizonOptions& options, Duration age, Horizon& horizon);
Horizon horizon(const HorizonOptions& options, Duration age);

/// The same steps up to any end.
/// @param end  after now, > 0
Horizon horizonUpTo(Duration end, HorizonOptions options, Duration age);

}  // namespace sweep_guard_core
