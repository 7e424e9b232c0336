#pragma once

#include <string>

#include "sweep_guard/geometry/tool.h"

namespace sweep_guard_ros {

bool hasLink(const sweep_guard_core::Tool& tool, const std::string& link);

/// Returns the links of a tool in words: "it has 'hand', 'finger'".
std::string linksOf(const sweep_guard_core::Tool& tool);

}  // namespace sweep_guard_ros
