#include "simulation/workpiece_messages.h"

#include <fmt/format.h>
#include <tf2_eigen/tf2_eigen.h>

#include <utility>

#include "ros/parameters/parameters.h"

namespace sweep_guard_simulation {
namespace {

constexpr std::uint32_t kRevision = 1;

using visualization_msgs::Marker;

constexpr double kLengthPerForce = 0.05;          // [m/N]
const Eigen::Vector3d kBeside(-0.05, 0.0, 0.01);  // place of the words [m]

Marker markerOf(const std_msgs::Header& header, int type, bool there) {
  Marker marker;
  marker.header = header;
  marker.ns = "force";
  marker.id = type;
  marker.type = type;
  marker.action = there ? Marker::ADD : Marker::DELETE;
  marker.pose.orientation.w = 1.0;
  marker.color.r = marker.color.a = 1.0F;
  marker.color.g = 0.85F;
  marker.color.b = 0.2F;
  return marker;
}

constexpr double kDamping = 10.0;  // of an elastic workpiece [1/s]: it neither sways nor creeps back

}  // namespace

sweep_guard::DeformableMesh meshMessage(const std::vector<float>& positions,
                                        const std::vector<sweep_guard_core::Triangle>& triangles) {
  sweep_guard::DeformableMesh message;
  message.revision = kRevision;
  for (size_t i = 0; i < positions.size(); i += 3) {
    message.mesh.vertices.push_back(
        tf2::toMsg(Eigen::Vector3d(Eigen::Map<const Eigen::Vector3f>(&positions[i]).cast<double>())));
  }
  for (const auto& [a, b, c] : triangles) {
    message.mesh.triangles.emplace_back().vertex_indices = {a, b, c};
  }
  return message;
}

sweep_guard::MeshVertices verticesMessage(std::vector<float> positions) {
  sweep_guard::MeshVertices message;
  message.revision = kRevision;
  message.positions = std::move(positions);
  return message;
}

visualization_msgs::MarkerArray forceMarkers(const std_msgs::Header& header, const Eigen::Vector3d& point,
                                             const Eigen::Vector3d& force, double dent) {
  const bool there = !force.isZero(0.0);
  const Eigen::Vector3d end = point + kLengthPerForce * force;
  Marker arrow = markerOf(header, Marker::ARROW, there);
  arrow.points = {tf2::toMsg(point), tf2::toMsg(end)};
  arrow.scale.x = 0.004;
  arrow.scale.y = 0.01;
  arrow.scale.z = 0.015;
  Marker text = markerOf(header, Marker::TEXT_VIEW_FACING, there);
  text.pose.position = tf2::toMsg(Eigen::Vector3d(end + kBeside));
  text.scale.z = 0.01;
  text.text = fmt::format("{:.2f} N\ndent {:.1f} mm", force.norm(), 1e3 * dent);
  visualization_msgs::MarkerArray markers;
  markers.markers = {arrow, text};
  return markers;
}

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
  workpiece.setTool(*parameters.tool, parameters.interaction.lawOf(id));
}

}  // namespace sweep_guard_simulation
