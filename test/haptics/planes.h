#pragma once

#include <memory>
#include <vector>

#include "sweep_guard/motion/motion_guard.h"

namespace sweep_guard_core {

/// Returns a tool that is one ball at the origin of its frame.
inline ToolBalls ballTool(double radius) {
  ToolBalls tool;
  tool.revision = 1;
  tool.pieces = {{{Eigen::Vector3d::Zero(), radius}}};
  return tool;
}

/// Returns a plane at rest through a point.
inline SeparatingPlane planeAt(const Eigen::Vector3d& normal_W, const Eigen::Vector3d& point_W) {
  return {0, normal_W.normalized(), point_W, 0.0, 0.0};
}

inline PlaneSet planeSet(std::vector<SeparatingPlane> planes) {
  PlaneSet set;
  set.complete = true;
  set.tool_revision = 1;
  set.planes = std::move(planes);
  return set;
}

}  // namespace sweep_guard_core
