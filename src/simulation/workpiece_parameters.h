#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "simulation/elastic/elastic_workpiece.h"
#include "simulation/workpiece.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_simulation {

/// Constructs a workpiece from private parameters of a node: `mesh_file` (empty: a hull), `triangles` (of the hull),
/// `size` and `amplitude` (of an elastic one: 0).
/// @throws sweep_guard_core::Error if a parameter or the file is refused, or the program that reads the file fails
Workpiece makeWorkpiece(sweep_guard_ros::ParameterReader& parameters);

/// Returns X_WM from private parameters: `position` [m] and `turn`, the rotation vector [rad].
Eigen::Isometry3d placeOf(sweep_guard_ros::ParameterReader& parameters);

/// Constructs an elastic workpiece if the private parameter `elastic` is set, from those below `elastic_workpiece/`.
/// @param rest  at time 0
/// @param step  [s] between two positions
/// @param up_M  unit, against which it lies
/// @throws sweep_guard_core::Error if a parameter is refused, or as ElasticWorkpiece
std::optional<ElasticWorkpiece> makeElasticWorkpiece(sweep_guard_ros::ParameterReader& parameters,
                                                     const Workpiece& rest, double step, const Eigen::Vector3d& up_M);

/// Lets the tool of a guard push a workpiece, by the force that the guard publishes.
/// @param guard  name of the guard, whose parameters say what its tool and the force are
/// @param id     of the workpiece
/// @throws sweep_guard_core::Error if a parameter of the guard is refused
void setToolOf(const std::string& guard, const std::string& id, ElasticWorkpiece& workpiece);

}  // namespace sweep_guard_simulation
