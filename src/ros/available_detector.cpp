#include "ros/available_detector.h"

#include <ros/console.h>

#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_ros {

Parameters withAvailableDetector(Parameters parameters) {
  parameters.detector = sweep_guard_core::availableDetector(parameters.detector.name, parameters.detector.options);
  if (parameters.detector.replacesSelect()) {
    ROS_WARN("detector %s instead of select: %s", describe(parameters.detector).c_str(),
             parameters.detector.missing.c_str());
  }
  return parameters;
}

std::string describe(const sweep_guard_core::DetectorChoice& detector) {
  if (detector.name == "select") return "select on " + detector.options.gl_context;
  if (detector.name == "halfspace") return std::string("halfspace on ") + sweep_guard_core::simd::kernels().name;
  return detector.name;
}

}  // namespace sweep_guard_ros
