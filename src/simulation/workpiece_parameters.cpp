#include "simulation/workpiece_parameters.h"

namespace sweep_guard_simulation {

Workpiece makeWorkpiece(sweep_guard_ros::ParameterReader& parameters) {
  Workpiece::Options options;
  options.size = parameters.number("size", options.size, {1e-3, 100.0});
  options.amplitude = parameters.number("amplitude", options.amplitude, {0.0, 0.05});
  const int triangles = parameters.integer("triangles", 1600, 6, 1000000);
  const std::string mesh_file = parameters.text("mesh_file", "");
  return mesh_file.empty() ? Workpiece::hull(triangles, options) : Workpiece::fromFile(mesh_file, options);
}

}  // namespace sweep_guard_simulation
