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
#include <limits>
#include <optional>

#include "sweep_guard/guard/guard.h"
#include "sweep_guard/guard/prediction.h"
#include "sweep_guard/monitor/warning.h"

namespace sweep_guard_ros {

/// Converts a stamp; 0 stays 0, "no stamp".
sweep_guard_core::Time fromMsg(const ros::Time& time);
/// Converts a stamp. Times before the epoch become 0; later ones than 32 bits of seconds hold, from the year 2106 on,
/// become the last that they hold.
ros::Time toMsg(sweep_guard_core::Time time);
/// Converts a duration. Longer ones than +-68 years (32 bits of seconds), as Duration::max(), become that.
ros::Duration toMsg(sweep_guard_core::Duration duration);

/// Returns the current time on both clocks.
/// @throws ros::TimeNotInitializedException before ros::Time::init() or a node handle
sweep_guard_core::Instant now();

/// Converts a vector to a message with the fields x, y and z.
template <typename Msg>
Msg vectorMsg(const Eigen::Vector3d& v) {
  Msg msg;
  msg.x = v.x();
  msg.y = v.y();
  msg.z = v.z();
  return msg;
}

/// Converts a pose or a transform [m], and normalizes its quaternion.
/// @throws sweep_guard_core::InvalidInput if a field is NaN, infinite or beyond 1e7 m, or if the norm of the quaternion
///     is not within 0.1 of 1
Eigen::Isometry3d fromMsg(const geometry_msgs::Pose& pose);
Eigen::Isometry3d fromMsg(const geometry_msgs::Transform& transform);
/// Converts a pose [m] to a message with a unit quaternion.
/// @param pose  finite, rotation orthonormal; not checked
geometry_msgs::Pose toMsg(const Eigen::Isometry3d& pose);

/// Converts a mesh [m], in its own frame.
/// @throws sweep_guard_core::InvalidInput if there are more than `max_triangles` triangles or more than three times
///     `max_triangles` vertices, or if TriangleMesh refuses the mesh
sweep_guard_core::TriangleMesh fromMsg(const shape_msgs::Mesh& mesh, size_t max_triangles, bool is_sheet = false);

/// Converts a predicted pose, at the time after its stamp at which it was predicted.
sweep_guard::PredictedPose toMsg(const sweep_guard_core::PredictedPose& pose, sweep_guard_core::Duration age);
/// Converts a predicted pose whose time counts from the stamp of the newest measured pose.
/// @throws sweep_guard_core::InvalidInput as for a pose, or if the covariance has a NaN or an infinity
sweep_guard_core::PredictedPose fromMsg(const sweep_guard::PredictedPose& pose);

/// Makes a message that names a workpiece and these triangles of it, without impacts.
/// @param triangles  indices: ascending, each once
sweep_guard::ObjectContacts toMsg(const sweep_guard_core::Workpiece& workpiece,
                                  const std::vector<std::uint32_t>& triangles);
/// Returns the link of a piece. Empty if the tool has no such piece: it was another tool, before a payload was detached.
std::string linkOf(const sweep_guard_core::Tool& tool, size_t piece);
/// Converts all triangles that the swept volumes meet, also those that the narrow phase ruled out, and the impacts:
/// points [m] and normals in the mesh's frame.
/// @param tool  the one that was swept: names the links (its pieces are not checked)
sweep_guard::ObjectContacts toMsg(const sweep_guard_core::Workpiece& workpiece,
                                  const sweep_guard_core::SweepResult& result, const sweep_guard_core::Tool& tool);
/// Converts what is met as allowed (SweepResult::allowed) in the same way.
sweep_guard::ObjectContacts allowedMsg(const sweep_guard_core::Workpiece& workpiece,
                                       const sweep_guard_core::SweepResult& result, const sweep_guard_core::Tool& tool);
/// Converts the objects that a swept volume meets or that the tool is inside, in the report's order. The caller sets
/// frame, tool and volume. The message's interval is that of the report; times of impact are fractions of it, although
/// the interval of their SweptObject may begin later.
sweep_guard::Contacts toMsg(const sweep_guard_core::SweepReport& report, const sweep_guard_core::Tool& tool);

/// Converts a prediction as of the time when it was made: omits poses up to that time. The caller sets frame, tool and
/// predictor.
/// @param age     age that the newest measured pose had at that time, >= 0
/// @param limits  decide the message's interval
sweep_guard::Prediction toMsg(const sweep_guard_core::Prediction& prediction, sweep_guard_core::Duration age,
                              const sweep_guard_core::WarningLimits& limits);
/// Returns the time from when the prediction was made until the predicted collision [s]; infinite if there is none, NaN
/// if unknown.
double timeToCollision(const sweep_guard::Prediction& prediction);

/// Returns a value that may be missing, as messages have it.
inline double orNan(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

/// Sets level and reasons, and the flags that follow from them.
void setLevel(sweep_guard::Warning& msg, sweep_guard_core::WarningLevel level, std::uint32_t reasons);
/// Converts a warning. The caller sets frame, tool, `tool_link`, counters, `valid_until` and `run_id`.
sweep_guard::Warning toMsg(const sweep_guard_core::Warning& warning);

}  // namespace sweep_guard_ros
