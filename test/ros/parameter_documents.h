#pragma once

#include <string>
#include <vector>

#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_ros {

/// Returns the rows of doc/interface.md's table of parameters: key, default, type with unit and range, whether it
/// changes while the guard runs, effect. A parameter without an effect is left out.
std::vector<std::string> parameterRows(const std::vector<ParameterInfo>& infos);

/// Returns the same rows without whether they change, for a node whose parameters never do.
std::vector<std::string> fixedParameterRows(const std::vector<ParameterInfo>& infos);

/// Returns the text of config/sweep_guard.yaml.
std::string configurationFile(const std::vector<ParameterInfo>& infos);
/// Returns the text of config/motion_guard.yaml.
std::string motionConfigurationFile(const std::vector<ParameterInfo>& infos);
/// Returns the text of config/black_box.yaml.
std::string blackBoxConfigurationFile(const std::vector<ParameterInfo>& infos);
/// Returns the text of config/haptics.yaml.
std::string hapticsConfigurationFile(const std::vector<ParameterInfo>& infos);

}  // namespace sweep_guard_ros
