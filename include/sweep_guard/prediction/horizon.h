#pragma once

#include <vector>

#include "sweep_guard/common/time.h"

namespace sweep_guard {

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

/// Number of sweeps that the considered interval, reserve included, takes at its configured step.
size_t consideredSweeps(const HorizonOptions& options);

/// @param age                of the newest pose, >= 0
/// @param considered_sweeps  into how many equal sweeps the considered interval is cut, 1 to consideredSweeps()
Horizon horizon(const HorizonOptions& options, Duration age, size_t considered_sweeps);

}  // namespace sweep_guard
