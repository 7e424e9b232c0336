#pragma once

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ros/tool/link_geometry.h"
#include "sweep_guard/geometry/decomposition.h"
#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/kinematics/joint_plan.h"
#include "sweep_guard/kinematics/robot_path.h"

namespace sweep_guard_ros {

/// Selects the tool from a robot.
struct ToolModelOptions {
  /// Link of the tool frame, maybe with a prefix before a slash. `tool` without such a link: the first of `links`.
  std::string frame = "tool";
  bool of_root = false;                  ///< `tool` without such a link is the root of the robot, whatever `links` has
  std::vector<std::string> links;        ///< links of the tool; empty: the frame's link and all links below it
  std::map<std::string, double> joints;  ///< positions [rad or m] of joints within the tool; others: closest to 0
  LinkGeometry geometry = LinkGeometry::kCollision;
  std::vector<std::string> mesh_roots;  ///< see locateMesh()
  /// Largest number of successive cuts of a mesh; 0: each mesh is one convex hull.
  int mesh_depth = sweep_guard_core::DecompositionOptions().max_depth;
  double padding = 0.0;  ///< every piece is grown by this [m], >= 0
};

/// Holds the links of a tool as bodies that joints move.
struct RobotModel {
  sweep_guard_core::Robot robot;
  std::vector<double> positions;  ///< of each variable [rad or m]: as ToolModelOptions::joints
  Eigen::Isometry3d X_TR;         ///< pose of the robot's root in the tool frame, which no joint moves [m]
  sweep_guard_core::JointsBesideTree beside = {};  ///< joints that `robot` does not have
};

/// Says what a link of a tool is made of.
struct LinkShape {
  std::string link;
  bool is_visual;  ///< made of its visual geometry, not of its collision geometry
  size_t pieces;   ///< convex ones
};

/// Holds a tool from a robot description.
struct ToolModel {
  std::vector<sweep_guard_core::ConvexPiece> pieces;  ///< in the tool frame, at least one per geometry of each link
  std::string frame;                                  ///< link whose frame is the tool frame
  std::vector<LinkShape> shapes;                      ///< of each link
  std::map<std::string, double> joints;               ///< positions [rad or m] of the moving joints within the tool
  std::shared_ptr<const RobotModel> robot;            ///< null if joints of the tool move its frame
  std::string why_no_robot;                           ///< why it is null
};

/// Makes a tool from the geometry of links of a URDF, in meters. Cylinders, boxes and spheres are exact. A mesh is
/// decomposed into sets of triangles (see decompose()), and each set is replaced by its convex hull.
/// @throws sweep_guard_core::InvalidInput, in one line that names link and file and says what to do, if the description
///     or a mesh is missing, malformed or hostile; if a link has no geometry of the kind asked for (no link is omitted), or
///     several in one element; or if a piece is degenerate or reaches farther than 100 m
ToolModel loadToolModel(const std::string& urdf, const ToolModelOptions& options);

/// Makes convex pieces of all links that joints move and that have a shape, each link in its own frame, by its name.
/// @param options  only `geometry`, `mesh_roots`, `mesh_depth` and `padding` count
/// @throws sweep_guard_core::InvalidInput as loadToolModel()
std::map<std::string, std::vector<sweep_guard_core::ConvexPiece>> loadLinks(const std::string& urdf,
                                                                            const ToolModelOptions& options);

/// Returns the links below a frame and the joints that move them; its root is the link of the frame.
/// @param frame  a link, maybe with a prefix before a slash
/// @throws sweep_guard_core::InvalidInput as loadToolModel()
sweep_guard_core::KinematicTree loadTree(const std::string& urdf, const std::string& frame);

/// Returns the pieces of all bodies in their order, in the tool frame, at RobotModel::positions.
std::vector<sweep_guard_core::ConvexPiece> piecesByBody(const RobotModel& model);

}  // namespace sweep_guard_ros
