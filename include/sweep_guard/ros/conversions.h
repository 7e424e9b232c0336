#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Transform.h>
#include <ros/time.h>
#include <sweep_guard/Contacts.h>
#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/MeshVertices.h>
#include <sweep_guard/ObjectContacts.h>
#include <sweep_guard/Prediction.h>
#include <sweep_guard/Warning.h>

#include <Eigen/Geometry>

#include "sweep_guard/guard/guard.h"
#include "sweep_guard/guard/prediction.h"
#include "sweep_guard/monitor/warning.h"

namespace sweep_guard_ros {

sweep_guard_core::Time fromMsg(const ros::Time& time);
ros::Time toMsg(sweep_guard_core::Time time);  ///< times before the epoch become 0
ros::Duration toMsg(sweep_guard_core::Duration duration);

/// Now on both clocks.
sweep_guard_core::Instant now();

/// @throws sweep_guard_core::InvalidInput if a field is NaN, infinite or beyond 1e7 m, or if the quaternion's norm is off by
/// more
///         than 0.1. A smaller deviation is normalised away.
Eigen::Isometry3d fromMsg(const geometry_msgs::Pose& pose);
Eigen::Isometry3d fromMsg(const geometry_msgs::Transform& transform);
geometry_msgs::Pose toMsg(const Eigen::Isometry3d& pose);

/// @throws sweep_guard_core::InvalidInput if there are more than `max_triangles`, or the mesh itself is invalid
sweep_guard_core::TriangleMesh fromMsg(const shape_msgs::Mesh& mesh, size_t max_triangles);

/// @param triangles  of the workpiece: ascending, each once
sweep_guard::ObjectContacts toMsg(const sweep_guard_core::Workpiece& workpiece,
                                  const std::vector<std::uint32_t>& triangles);
sweep_guard::ObjectContacts toMsg(const sweep_guard_core::Workpiece& workpiece,
                                  const sweep_guard_core::SweepResult& result, const sweep_guard_core::Tool& tool);
/// The objects met, in the report's order; header, tool and volume are the sender's.
sweep_guard::Contacts toMsg(const sweep_guard_core::SweepReport& report, const sweep_guard_core::Tool& tool);

/// What is expected, told at a moment: poses that lie before it are left out. Frame, tool and predictor are the
/// sender's.
/// @param age  of the pose that the prediction begins at, at that moment
sweep_guard::Prediction toMsg(const sweep_guard_core::Prediction& prediction, sweep_guard_core::Duration age,
                              const sweep_guard_core::WarningLimits& limits);
/// Seconds until the predicted collision; infinite if there is none, NaN if that is not known.
double timeToCollision(const sweep_guard::Prediction& prediction);

/// WarningLevel, reasons and what follows from them; frame, tool and counters are the sender's.
sweep_guard::Warning toMsg(const sweep_guard_core::Warning& warning);

}  // namespace sweep_guard_ros
