#include "ros/output/marker_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/heartbeat.h"
#include "sweep_guard/detection/submesh.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::WarningLevel;
using visualization_msgs::Marker;

constexpr double kLifetime = 0.5;  // [s]

const Eigen::Vector3d kLight(0.48, 0.14, 0.866);  // direction to the light

// rviz's own light leaves the visible side dark.
// @param brightness  0 to 1
std_msgs::ColorRGBA shaded(std_msgs::ColorRGBA color, double brightness) {
  for (float* const component : {&color.r, &color.g, &color.b})
    *component = std::min(1.0F, 1.2F * static_cast<float>(brightness) * *component);
  return color;
}

Eigen::Vector3d normalOf(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r) {
  return (q - p).cross(r - p).stableNormalized();
}

void addShaded(Marker& list, const sweep_guard_core::ConvexShape& shape_T, const Eigen::Matrix3d& R_WT) {
  const sweep_guard_core::TriangleMesh& mesh_T = shape_T.mesh_T();
  for (const auto& [a, b, c] : mesh_T.triangles()) {
    const Eigen::Vector3d p = mesh_T.vertex(a);
    const Eigen::Vector3d normal = normalOf(p, mesh_T.vertex(b), mesh_T.vertex(c));
    const double outward = normal.dot(p - shape_T.moments_T().mean) < 0.0 ? -1.0 : 1.0;
    const double brightness = 0.65 + 0.35 * outward * (R_WT * normal).dot(kLight);
    list.colors.insert(list.colors.end(), 3, shaded(list.color, brightness));
    for (const std::uint32_t corner : {a, b, c}) list.points.push_back(point(mesh_T.vertex(corner)));
  }
}

int markersOf(const sweep_guard_core::Tool& body) {
  int cylinders = 0;
  for (const sweep_guard_core::ConvexPiece& piece : body.pieces())
    cylinders += piece.shape_T.asCylinder() != nullptr ? 1 : 0;
  return cylinders + (static_cast<size_t>(cylinders) < body.pieces().size() ? 1 : 0);
}

// @param id  of its first marker
void addBody(visualization_msgs::MarkerArray& array, const Marker& tool, int id, const sweep_guard_core::Tool& body,
             const Eigen::Isometry3d& X_WB) {
  Marker others = tool;
  others.type = Marker::TRIANGLE_LIST;
  others.pose = toMsg(X_WB);
  for (const sweep_guard_core::ConvexPiece& piece : body.pieces()) {
    if (const auto* const cylinder = piece.shape_T.asCylinder()) {
      Marker drawn = tool;
      drawn.id = id++;
      drawn.type = Marker::CYLINDER;
      drawn.pose = toMsg(X_WB * piece.shape_T.X_TS() * Eigen::Translation3d(0.0, 0.0, -0.5 * cylinder->length));
      drawn.scale.x = drawn.scale.y = 2.0 * cylinder->radius;
      drawn.scale.z = cylinder->length;
      array.markers.push_back(drawn);
      continue;
    }
    addShaded(others, piece.shape_T, X_WB.linear());
  }
  others.id = id;
  if (!others.points.empty()) array.markers.push_back(std::move(others));
}

}  // namespace

std_msgs::ColorRGBA color(double r, double g, double b, double alpha) {
  std_msgs::ColorRGBA color;
  color.r = static_cast<float>(r);
  color.g = static_cast<float>(g);
  color.b = static_cast<float>(b);
  color.a = static_cast<float>(alpha);
  return color;
}

std_msgs::ColorRGBA workpieceColor(double alpha) { return color(0.84, 0.80, 0.74, alpha); }

std_msgs::ColorRGBA rememberedColor(double alpha) { return color(0.20, 0.60, 0.60, alpha); }

std_msgs::ColorRGBA toolColor(double alpha) { return color(0.35, 0.5, 0.9, alpha); }

std_msgs::ColorRGBA levelColor(WarningLevel level, double alpha) {
  const auto& [red, green, blue] = styleOf(level).rgb;
  return color(red / 255.0, green / 255.0, blue / 255.0, alpha);
}

std_msgs::ColorRGBA unlessUnknown(WarningLevel level, const std_msgs::ColorRGBA& color) {
  return level == WarningLevel::kUnknown ? levelColor(level, static_cast<double>(color.a)) : color;
}

geometry_msgs::Point point(const Eigen::Vector3d& p) { return vectorMsg<geometry_msgs::Point>(p); }

Marker marker(const std::string& ns, int id, int type, const std::string& frame, sweep_guard_core::Time stamp) {
  Marker marker;
  marker.header.frame_id = frame;
  marker.header.stamp = toMsg(stamp);
  marker.ns = ns;
  marker.id = id;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.lifetime = ros::Duration(kLifetime);
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  return marker;
}

void addTool(visualization_msgs::MarkerArray& array, const Marker& tool,
             const std::vector<sweep_guard_core::Tool>& bodies, const std::vector<Eigen::Isometry3d>& X_WB) {
  int markers = 0;
  for (const sweep_guard_core::Tool& body : bodies) markers += markersOf(body);
  int id = tool.id * markers;
  for (size_t i = 0; i < bodies.size(); ++i) {
    addBody(array, tool, id, bodies[i], X_WB[i]);
    id += markersOf(bodies[i]);
  }
}

// Triangles may have either winding.
void addSurface(Marker& list, const sweep_guard_core::TriangleMesh& mesh_M) {
  list.points.reserve(3 * mesh_M.triangles().size());
  list.colors.reserve(mesh_M.triangles().size());
  sweep_guard_core::Submesh(mesh_M).forEachTriangle([&](std::uint32_t i) {
    const auto& [a, b, c] = mesh_M.triangles()[i];
    const std::array corners = {mesh_M.vertex(a), mesh_M.vertex(b), mesh_M.vertex(c)};
    for (const Eigen::Vector3d& corner : corners) list.points.push_back(point(corner));
    const double facing = std::abs(normalOf(corners[0], corners[1], corners[2]).dot(kLight));
    list.colors.push_back(shaded(list.color, 0.5 + 0.5 * facing));
  });
}

double liftOff(const sweep_guard_core::Tool& tool) {
  return std::min(0.001, 0.05 * tool.bounds_T().sizes().minCoeff());
}

SurfaceMarker::SurfaceMarker(const std::string& ns, int index, const std::string& frame, sweep_guard_core::Time stamp,
                             double line_width)
    : faces_(marker(ns, 2 * index, Marker::TRIANGLE_LIST, frame, stamp)),
      edges_(marker(ns, 2 * index + 1, Marker::LINE_LIST, frame, stamp)) {
  edges_.scale.x = line_width;
}

void SurfaceMarker::paint(const std_msgs::ColorRGBA& faces, const std_msgs::ColorRGBA& edges) {
  faces_.color = faces;
  edges_.color = edges;
}

void SurfaceMarker::add(const sweep_guard_core::Polygon& polygon) {
  for (size_t i = 2; i < polygon.size(); ++i) {
    for (const size_t corner : {size_t{0}, i - 1, i}) faces_.points.push_back(point(polygon[corner]));
  }
  for (size_t i = 0; i < polygon.size(); ++i) {
    edges_.points.push_back(point(polygon[i]));
    edges_.points.push_back(point(polygon[(i + 1) % polygon.size()]));
  }
}

void SurfaceMarker::add(const sweep_guard_core::SweptVolume& volume_M) {
  const sweep_guard_core::OrientedBox& box = volume_M.box;
  for (sweep_guard_core::Polygon polygon :
       sweep_guard_core::polytopeFaces(volume_M.halfSpaces_B(), box.half_extents.norm())) {
    for (Eigen::Vector3d& p : polygon) p = box.X_MB * p;
    add(polygon);
  }
}

void SurfaceMarker::add(const sweep_guard_core::TriangleMesh& mesh_M, const std::vector<std::uint32_t>& triangles,
                        double lift) {
  for (const std::uint32_t triangle : triangles) {
    sweep_guard_core::beat();
    const auto& [a, b, c] = mesh_M.triangles()[triangle];
    const Eigen::Vector3d p = mesh_M.vertex(a);
    const Eigen::Vector3d q = mesh_M.vertex(b);
    const Eigen::Vector3d r = mesh_M.vertex(c);
    const Eigen::Vector3d off = lift * normalOf(p, q, r);
    add({p + off, q + off, r + off});
    add({p - off, r - off, q - off});
  }
  faces_.colors.resize(faces_.points.size() / 3, faces_.color);
}

void SurfaceMarker::moveInto(visualization_msgs::MarkerArray& array) {
  if (faces_.points.empty()) return;
  array.markers.push_back(std::move(faces_));
  array.markers.push_back(std::move(edges_));
}

}  // namespace sweep_guard_ros
