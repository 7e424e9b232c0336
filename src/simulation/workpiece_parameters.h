#pragma once

#include "simulation/workpiece.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_simulation {

/// Constructs a workpiece from private parameters of a node: `mesh_file` (empty: a hull), `triangles` (of the hull),
/// `size` and `amplitude`.
/// @throws sweep_guard_core::Error if a parameter or the file is refused, or the program that reads the file fails
Workpiece makeWorkpiece(sweep_guard_ros::ParameterReader& parameters);

}  // namespace sweep_guard_simulation
