#pragma once

#include "simulation/workpiece.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_simulation {

/// The workpiece that a node's private parameters `mesh_file` (empty: a hull), `triangles` (of the hull), `size` and
/// `amplitude` describe.
/// @throws sweep_guard_core::Error if a parameter or the file is refused, or the file's reader cannot be run
Workpiece makeWorkpiece(sweep_guard_ros::ParameterReader& parameters);

}  // namespace sweep_guard_simulation
