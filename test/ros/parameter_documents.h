#pragma once

#include <string>
#include <vector>

#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_ros {

/// Returns the rows of a table of parameters: key, bold if it may change while the node runs, default, type with unit and
/// range, effect. Neighbors that differ by their keys alone share a row. A parameter without an effect is left out.
std::vector<std::string> parameterRows(const std::vector<ParameterInfo>& infos);

/// Returns the text of config/sweep_guard.yaml.
std::string configurationFile(const std::vector<ParameterInfo>& infos);
/// Returns the text of config/motion_guard.yaml.
std::string motionConfigurationFile(const std::vector<ParameterInfo>& infos);
/// Returns the text of config/black_box.yaml.
std::string blackBoxConfigurationFile(const std::vector<ParameterInfo>& infos);
/// Returns the text of config/haptics.yaml.
std::string hapticsConfigurationFile(const std::vector<ParameterInfo>& infos);

}  // namespace sweep_guard_ros
