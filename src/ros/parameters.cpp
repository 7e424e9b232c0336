#include "sweep_guard/ros/parameters.h"

#include <cmath>
#include <limits>

#include "sweep_guard/ros/parameter_reader.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Duration;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Duration duration(double seconds) { return std::isinf(seconds) ? Duration::max() : sweep_guard::fromSeconds(seconds); }

}  // namespace

sweep_guard::Tool Parameters::tool() const { return sweep_guard::Tool::cylinder(tool_radius, tool_length, tool_sides); }

Parameters loadParameters(const ros::NodeHandle& private_node) {
  ParameterReader read(private_node);
  Parameters parameters;
  parameters.fixed_frame = read.name("fixed_frame", "world");
  parameters.tool_source =
      read.choice("tool_source", "topic", {"topic", "tf"}) == "tf" ? ToolSource::kTf : ToolSource::kTopic;
  parameters.tool_frame = read.name("tool_frame", "tool");
  read.choice("tool/type", "cylinder", {"cylinder"});
  parameters.tool_radius = read.number("tool/radius", 0.01, {1e-6, 100.0});
  parameters.tool_length = read.number("tool/length", 0.15, {1e-6, 100.0});
  parameters.tool_sides = read.integer("tool/sides", 32, 3, 1000);
  parameters.detector = read.choice("detector", "select", sweep_guard::detectorNames());
  parameters.cull = read.flag("cull", true);
  parameters.sweep.volume = sweep_guard::volumeKind(read.choice("volume", "obb_planes", {"obb", "obb_planes"}));
  parameters.sweep.max_rotation = read.number("max_rotation_per_sweep", 0.175, {0.01, 0.5});
  parameters.limits.hold_time = duration(read.number("warning/hold_time", 0.5, {0.0, 60.0}));
  parameters.limits.pose_timeout = duration(read.number("timing/pose_timeout", 0.1, {0.01, 2.0}));
  parameters.limits.mesh_timeout = duration(read.number("timing/mesh_timeout", 0.5, {0.01, kInfinity}));
  parameters.marker_rate = read.number("timing/marker_rate", 15.0, {0.1, 100.0});
  parameters.max_triangles = static_cast<size_t>(read.integer("limits/max_triangles", 1000000, 1, 10000000));
  read.number("diagnostic_period", 1.0, {0.0, kInfinity});  // diagnostic_updater leaves it there
  read.warnOfUnread();
  return parameters;
}

}  // namespace sweep_guard_ros
