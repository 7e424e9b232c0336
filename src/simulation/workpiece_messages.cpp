#include "simulation/workpiece_messages.h"

#include <fmt/format.h>
#include <tf2_eigen/tf2_eigen.h>

#include <utility>

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

visualization_msgs::MarkerArray forceMarkers(const std_msgs::Header& header, const PressedSurface& pressed) {
  const bool there = !pressed.force.isZero(0.0);
  const Eigen::Vector3d end = pressed.point + kLengthPerForce * pressed.force;
  Marker arrow = markerOf(header, Marker::ARROW, there);
  arrow.points = {tf2::toMsg(pressed.point), tf2::toMsg(end)};
  arrow.scale.x = 0.004;
  arrow.scale.y = 0.01;
  arrow.scale.z = 0.015;
  Marker text = markerOf(header, Marker::TEXT_VIEW_FACING, there);
  text.pose.position = tf2::toMsg(Eigen::Vector3d(end + kBeside));
  text.scale.z = 0.01;
  text.text = fmt::format("{:.2f} N\ndent {:.1f} mm", pressed.force.norm(), 1e3 * pressed.dent);
  visualization_msgs::MarkerArray markers;
  markers.markers = {arrow, text};
  return markers;
}

}  // namespace sweep_guard_simulation
