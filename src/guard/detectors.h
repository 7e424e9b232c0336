#pragma once

#include <memory>
#include <string>

#include "sweep_guard/detection/detector.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

/// The detector of a guard, and the one that it takes for what cameras see: `halfspace`, which alone tests grids in motion, and
/// tests a million triangles in less than a millisecond.
struct Detectors {
  std::unique_ptr<Detector> chosen;
  std::unique_ptr<Detector> of_cameras = makeDetector("halfspace");

  Detector& of(const Workpiece& workpiece) { return workpiece.of_camera ? *of_cameras : *chosen; }
};

}  // namespace sweep_guard_core
