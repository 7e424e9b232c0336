#include "ros/output/known_surfaces.h"

#include "sweep_guard/monitor/reason.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {

bool KnownSurfaces::complete(const sweep_guard_core::SweepReport& report,
                             const sweep_guard_core::Workpieces& unplaced) {
  monitor_.warning(now(), warning_);
  return report.complete() && unplaced.empty() && (warning_.reasons & sweep_guard_core::kSurfacesMissing) == 0;
}

}  // namespace sweep_guard_ros
