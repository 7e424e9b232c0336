#include "ros/available_detector.h"

#include <ros/console.h>

namespace sweep_guard_ros {

Parameters withAvailableDetector(Parameters parameters) {
  parameters.detector = sweep_guard_core::availableDetector(parameters.detector.name, parameters.detector.options);
  if (parameters.detector.replacesSelect()) {
    ROS_WARN("detector %s instead of select: %s", describe(parameters.detector).c_str(),
             parameters.detector.missing.c_str());
  }
  return parameters;
}

}  // namespace sweep_guard_ros
