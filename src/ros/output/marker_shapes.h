#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/geometry/convex_polytope.h"
#include "sweep_guard/geometry/swept_volume.h"
#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/guard/workpiece.h"
#include "sweep_guard/monitor/warning.h"

namespace sweep_guard_ros {

/// Components and alpha in [0, 1].
std_msgs::ColorRGBA color(double r, double g, double b, double alpha);

/// Clear is green, considered amber, reflex and contact red, unknown grey.
std_msgs::ColorRGBA levelColor(sweep_guard_core::WarningLevel level, double alpha);

/// The colour, or grey of the same alpha while the level is unknown.
std_msgs::ColorRGBA unlessUnknown(sweep_guard_core::WarningLevel level, const std_msgs::ColorRGBA& color);

geometry_msgs::Point point(const Eigen::Vector3d& p);

/// A marker to be added, of scale 1 at the origin of its frame; it lives for 0.5 s.
visualization_msgs::Marker marker(const std::string& ns, int id, int type, const std::string& frame,
                                  sweep_guard_core::Time stamp);

/// A tool in one pose and colour: its cylinders as such, its other parts together as triangles, all without padding.
struct ToolDrawing {
  std::string ns;
  int index;  ///< of several in this namespace: ids are those from index * toolMarkers(tool) on
  std::string frame;
  sweep_guard_core::Time stamp;
  std_msgs::ColorRGBA color;
};
int toolMarkers(const sweep_guard_core::Tool& tool);  ///< number of markers that draw it
void addTool(visualization_msgs::MarkerArray& array, const ToolDrawing& drawing, const sweep_guard_core::Tool& tool,
             const Eigen::Isometry3d& X_WT);

/// How far triangles are lifted off a workpiece, so that they are seen, and are not far from it either, for small tools
/// [m].
double liftOff(const sweep_guard_core::Tool& tool);

/// A surface and the lines on it: two markers with the ids 2 * index and 2 * index + 1.
class Surface {
 public:
  /// @param line_width  [m]
  Surface(const std::string& ns, int index, const std::string& frame, sweep_guard_core::Time stamp, double line_width);

  void paint(const std_msgs::ColorRGBA& faces, const std_msgs::ColorRGBA& edges);

  void add(const sweep_guard_core::Polygon& polygon);
  void add(const sweep_guard_core::SweptVolume& volume_M);
  /// Triangles of a workpiece, off its surface on either side: in it they would flicker with whoever draws the
  /// workpiece.
  /// @param lift  [m]
  void add(const sweep_guard_core::TriangleMesh& mesh_M, const std::vector<std::uint32_t>& triangles, double lift);

  /// Hands the markers over, if there is anything to see.
  void moveInto(visualization_msgs::MarkerArray& array);

 private:
  visualization_msgs::Marker faces_;
  visualization_msgs::Marker edges_;
};

}  // namespace sweep_guard_ros
