#pragma once

#include <string>
#include <vector>

#include "ros/parameters/parameters.h"

namespace sweep_guard_ros {

struct ParameterChange {
  std::string key;
  ParameterValue before;
  ParameterValue after;
};

std::vector<ParameterChange> differences(const Parameters& before, const Parameters& after);

/// Returns whether a parameter differs whose key begins like this.
bool differ(const Parameters& before, const Parameters& after, const std::string& beginning);

/// Returns whether the two need different detectors.
bool detectorsDiffer(const Parameters& before, const Parameters& after);

}  // namespace sweep_guard_ros
