#include "simulation/workpiece_parameters.h"

#include "ros/parameters/parameters.h"

namespace sweep_guard_simulation {
namespace {

constexpr double kDamping = 10.0;  // of an elastic workpiece [1/s]: it neither sways nor creeps back

}  // namespace

Workpiece makeWorkpiece(sweep_guard_ros::ParameterReader& parameters) {
  Workpiece::Options options;
  options.size = parameters.number("size", options.size, {1e-3, 100.0});
  const bool elastic = parameters.flag("elastic", false);
  options.amplitude = parameters.number("amplitude", elastic ? 0.0 : options.amplitude, {0.0, 0.05});
  const int triangles = parameters.integer("triangles", 1600, 6, 1000000);
  const std::string mesh_file = parameters.text("mesh_file", "");
  return mesh_file.empty() ? Workpiece::hull(triangles, options) : Workpiece::fromFile(mesh_file, options);
}

Eigen::Isometry3d placeOf(sweep_guard_ros::ParameterReader& parameters) {
  const Eigen::Vector3d turn = parameters.position("turn", {0.0, 0.0, 0.0});
  return Eigen::Translation3d(parameters.position("position", {0.0, 0.0, 0.3})) *
         Eigen::AngleAxisd(turn.norm(), turn.stableNormalized());
}

std::optional<ElasticWorkpiece> makeElasticWorkpiece(sweep_guard_ros::ParameterReader& parameters,
                                                     const Workpiece& rest, double step, const Eigen::Vector3d& up_M) {
  if (!parameters.flag("elastic", false)) return std::nullopt;
  const std::string group = "elastic_workpiece/";
  ElasticWorkpiece::Options options;
  ElasticMaterial& material = options.material;
  material.youngs_modulus = parameters.number(group + "youngs_modulus", material.youngs_modulus, {1.0, 1e12, "Pa"});
  material.density = parameters.number(group + "density", material.density, {1.0, 1e5, "kg/m^3"});
  material.skin = parameters.number(group + "skin", material.skin, {1e-6, 1.0, "m"});
  material.bedding = parameters.number(group + "bedding", material.bedding, {1.0, 1e12, "N/m^3"});
  material.inner_points = parameters.integer(group + "inner_points", material.inner_points, 0, 100000);
  options.fixed_height = parameters.number(group + "fixed_height", options.fixed_height, {0.0, 1.0});
  options.up_M = up_M;
  options.motion.step = step;
  options.motion.damping = parameters.number(group + "damping", kDamping, {0.0, 1000.0, "1/s"});
  options.motion.iterations = parameters.integer(group + "iterations", options.motion.iterations, 1, 1000);
  return ElasticWorkpiece(rest.positions(0.0), rest.triangles(), options);
}

void setToolOf(const std::string& guard, const std::string& id, ElasticWorkpiece& workpiece) {
  const sweep_guard_ros::Parameters parameters = sweep_guard_ros::loadParameters(ros::NodeHandle(guard));
  sweep_guard_core::ForceLaw law = parameters.interaction.law;
  const auto own = parameters.interaction.stiffness_of.find(id);
  if (own != parameters.interaction.stiffness_of.end()) law.stiffness = own->second;
  workpiece.setTool(*parameters.tool, law);
}

}  // namespace sweep_guard_simulation
