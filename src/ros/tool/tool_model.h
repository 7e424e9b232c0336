#pragma once

#include <map>
#include <string>
#include <vector>

#include "sweep_guard/geometry/decomposition.h"
#include "sweep_guard/geometry/tool.h"

namespace sweep_guard_ros {

/// What of a robot is the tool.
struct ToolModelOptions {
  std::string frame = "tool";      ///< tool frame: a link; `tool` where there is no such link: the first of links
  std::vector<std::string> links;  ///< that the tool consists of; empty: the frame's link and all that hang on it
  std::map<std::string, double>
      joints;                           ///< positions [rad or m] of joints within the tool; the others are closest to 0
  std::vector<std::string> mesh_roots;  ///< see locateMesh()
  int mesh_depth =
      sweep_guard_core::DecompositionOptions().max_depth;  ///< of its cuts; 0: each mesh is one convex hull
  double padding = 0.0;                                    ///< [m], >= 0; every part is grown by it
};

/// A tool as a robot description has it.
struct ToolModel {
  std::vector<sweep_guard_core::ConvexPiece> parts;  ///< in the tool frame, one or more for each collision of each link
  std::string frame;                                 ///< link whose frame the tool frame is
  std::map<std::string, double> held;  ///< moving joints within the tool, and where they are held [rad or m]
};

/// Makes a tool of the collision geometry of a URDF. Cylinders, boxes and spheres are exact; a mesh is cut into sets of
/// triangles where that pays (see decompose()), each of which is its convex hull. All of them are in metres.
/// @throws sweep_guard_core::InvalidInput, in one line that names link and file and says what to do, if the description or a
///     mesh is missing, malformed or hostile; if a link has no collision geometry (that of its visuals is not taken,
///     nor a link left out); or if a part is degenerate or reaches farther than 100 m
ToolModel loadToolModel(const std::string& urdf, const ToolModelOptions& options);

}  // namespace sweep_guard_ros
