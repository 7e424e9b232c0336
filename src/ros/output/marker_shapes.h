#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/geometry/half_space.h"
#include "sweep_guard/geometry/swept_volume.h"
#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/guard/workpiece.h"
#include "sweep_guard/monitor/warning.h"

namespace sweep_guard_ros {

/// Makes a color. Components and alpha are in [0, 1].
std_msgs::ColorRGBA color(double r, double g, double b, double alpha);

std_msgs::ColorRGBA workpieceColor(double alpha);
std_msgs::ColorRGBA rememberedColor(double alpha);  ///< of surfaces that the robot hides from a camera
std_msgs::ColorRGBA toolColor(double alpha);

/// Returns the color of a level (kLevelStyles) with this alpha.
std_msgs::ColorRGBA levelColor(sweep_guard_core::WarningLevel level, double alpha);

/// Returns the color, or gray of the same alpha while the level is unknown.
std_msgs::ColorRGBA unlessUnknown(sweep_guard_core::WarningLevel level, const std_msgs::ColorRGBA& color);

geometry_msgs::Point point(const Eigen::Vector3d& p);

/// Makes a marker of action ADD and scale 1 at the origin of its frame, which lives for 0.5 s.
visualization_msgs::Marker marker(const std::string& ns, int id, int type, const std::string& frame,
                                  sweep_guard_core::Time stamp);

/// Adds the markers of a tool in one pose and color: for each body, one marker for each cylinder and one for the triangles
/// of all other pieces, without padding.
/// @param tool  a marker whose namespace, frame, stamp and color all have. Its id is the index of the tool in the
///              namespace: ids begin at this times the number of markers of all bodies
/// @param X_WB  pose of each body
void addTool(visualization_msgs::MarkerArray& array, const visualization_msgs::Marker& tool,
             const std::vector<sweep_guard_core::Tool>& bodies, const std::vector<Eigen::Isometry3d>& X_WB);

/// Adds the triangles of a workpiece to a list of triangles, shaded in its color.
void addSurface(visualization_msgs::Marker& list, const sweep_guard_core::TriangleMesh& mesh_M);

/// Returns the distance [m] between a workpiece and the triangles drawn on it: enough to see them, small for a small
/// tool.
double liftOff(const sweep_guard_core::Tool& tool);

/// Draws a surface and its edges as two markers with the ids 2 * index and 2 * index + 1.
class SurfaceMarker {
 public:
  /// @param line_width  [m]
  SurfaceMarker(const std::string& ns, int index, const std::string& frame, sweep_guard_core::Time stamp,
                double line_width);

  void paint(const std_msgs::ColorRGBA& faces, const std_msgs::ColorRGBA& edges);

  void add(const sweep_guard_core::Polygon& polygon);
  void add(const sweep_guard_core::SweptVolume& volume_M);
  /// Adds triangles of a workpiece on both sides of its surface: in the surface they would flicker. Each has the color of
  /// paint(), to be called before: rviz shades what has one color in all, so that one side would be dark.
  /// @param lift  [m]
  void add(const sweep_guard_core::TriangleMesh& mesh_M, const std::vector<std::uint32_t>& triangles, double lift);

  /// Moves the markers into the array, if there are any faces.
  void moveInto(visualization_msgs::MarkerArray& array);

 private:
  visualization_msgs::Marker faces_;
  visualization_msgs::Marker edges_;
};

}  // namespace sweep_guard_ros
