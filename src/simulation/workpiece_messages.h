#pragma once

#include <std_msgs/Header.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "simulation/elastic/elastic_workpiece.h"
#include "simulation/workpiece.h"
#include "sweep_guard/DeformableMesh.h"
#include "sweep_guard/MeshVertices.h"
#include "sweep_guard/geometry/triangle_mesh.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_simulation {

/// Returns a mesh as revision 1. The caller sets header and id.
/// @param positions  of the vertices: x0 y0 z0 x1 ... [m]
sweep_guard::DeformableMesh meshMessage(const std::vector<float>& positions,
                                        const std::vector<sweep_guard_core::Triangle>& triangles);

/// Returns vertices of the same revision. The caller sets header and id.
sweep_guard::MeshVertices verticesMessage(std::vector<float> positions);

/// Returns an arrow from the point, 0.05 m long per N, with the numbers beside it in words. Without a force
/// they are deleted.
/// @param point  where the force acts [m]
/// @param force  of an elastic workpiece on the tool [N]
/// @param dent   in the workpiece [m]
visualization_msgs::MarkerArray forceMarkers(const std_msgs::Header& header, const Eigen::Vector3d& point,
                                             const Eigen::Vector3d& force, double dent);

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
