#include "simulation/force_markers.h"

#include <fmt/format.h>
#include <tf2_eigen/tf2_eigen.h>

namespace sweep_guard_simulation {
namespace {

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
