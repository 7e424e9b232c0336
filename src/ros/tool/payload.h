#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "ros/parameters/parameters.h"
#include "sweep_guard/guard/pose_with_frames.h"

namespace sweep_guard_ros {

/// A workpiece that a link of the tool holds.
struct Payload {
  std::string id;
  std::string link;                                        ///< that holds it
  std::vector<sweep_guard_core::ConvexShape> shapes_M;     ///< convex pieces of the workpiece
  Eigen::Isometry3d X_WM = Eigen::Isometry3d::Identity();  ///< pose of the frame of the workpiece [m]
};

/// Returns the index of the rigid body of the tool that a link belongs to, among PoseWithFrames::bodies; 0 for a rigid tool.
/// @throws sweep_guard_core::InvalidInput naming the links, if the tool has none of this name
size_t bodyWithLink(const Parameters& parameters, const std::string& link);

/// Returns the parameters with the payload as part of the tool: as a link of its id, which moves with the body of the link
/// that holds it.
/// @param pose  the tool now
/// @throws sweep_guard_core::InvalidInput if the tool has no such link, has one of the payload's name, or reaches too far
Parameters withPayload(const Parameters& before, const Payload& payload, const sweep_guard_core::PoseWithFrames& pose);

/// Returns the parameters without a payload that the tool has.
Parameters withoutPayload(const Parameters& before, const std::string& id);

}  // namespace sweep_guard_ros
