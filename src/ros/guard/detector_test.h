#pragma once

#include <string>

#include "ros/parameters/parameters.h"
#include "sweep_guard/detection/detector.h"

namespace sweep_guard_ros {

/// Tests a detector, unless `self_test` is none.
/// @param name  for the text
/// @returns why it failed; empty: it passed, or is not tested
std::string testFailure(const Parameters& parameters, const std::string& name, sweep_guard_core::Detector& detector);

}  // namespace sweep_guard_ros
