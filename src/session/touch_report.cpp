#include "session/touch_report.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <utility>

#include "common/csv.h"

namespace sweep_guard_session {

using Eigen::Vector3d;
using sweep_guard::ObjectTouches;
using sweep_guard_core::csvLine;
using sweep_guard_core::csvNumber;
using sweep_guard_core::TriangleSurface;

namespace {

constexpr std::size_t kMaxWorkpieces = 4;
constexpr std::size_t kMaxTriangles = 30000;

Vector3d middleOf(const TriangleSurface& surface, std::size_t triangle) {
  Vector3d sum = Vector3d::Zero();
  for (const std::uint32_t corner : surface.triangles[triangle]) sum += surface.vertices[corner];
  return sum / 3.0;
}

Vector3d areaOf(const TriangleSurface& surface, std::size_t triangle) {
  const auto& [a, b, c] = surface.triangles[triangle];
  const Vector3d& p = surface.vertices[a];
  return 0.5 * (surface.vertices[b] - p).cross(surface.vertices[c] - p);
}

Vector3d centerOf(const TriangleSurface& surface) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& vertex : surface.vertices) box.extend(vertex);
  return box.center();
}

// Whether the triangles face inwards, of a surface that is closed.
bool isInsideOut(const TriangleSurface& surface) {
  const Vector3d center = centerOf(surface);
  double volume = 0.0;
  for (std::size_t triangle = 0; triangle < surface.triangles.size(); ++triangle)
    volume += areaOf(surface, triangle).dot(middleOf(surface, triangle) - center);
  return volume < 0.0;
}

std::string cornersCsv(const std::string& mesh, const TriangleSurface& surface, std::size_t triangle, bool turned) {
  std::vector<std::string> fields = {mesh, std::to_string(triangle)};
  auto corners = surface.triangles[triangle];
  if (turned) std::swap(corners[1], corners[2]);
  for (const std::uint32_t corner : corners) {
    for (const double coordinate : surface.vertices[corner]) fields.push_back(csvNumber(coordinate));
  }
  return csvLine(fields);
}

}  // namespace

void TouchLog::readShapes(const SessionFiles& files, const SessionTopics& topics) {
  files.forEach({topics.mesh, topics.mesh_vertices}, [this](const rosbag::MessageInstance& message) {
    if (const auto mesh = message.instantiate<sweep_guard::DeformableMesh>()) take(mesh);
    if (const auto vertices = message.instantiate<sweep_guard::MeshVertices>()) take(vertices);
  });
}

// Vertices of another revision, or of a mesh that was replaced, do not fit.
TriangleSurface TouchLog::surfaceOf(const ObjectTouches& touches) const {
  TriangleSurface surface;
  const auto mesh = meshes_.find(touches.mesh_id);
  if (mesh == meshes_.end() || mesh->second->revision != touches.revision) return surface;
  const shape_msgs::Mesh& shape = mesh->second->mesh;
  if (!touches.triangles.empty() && touches.triangles.back() >= shape.triangles.size()) return surface;
  for (const geometry_msgs::Point& p : shape.vertices) surface.vertices.emplace_back(p.x, p.y, p.z);
  const auto newest = vertices_.find(touches.mesh_id);
  const bool deformed = newest != vertices_.end() && newest->second->revision == touches.revision &&
                        newest->second->positions.size() == 3 * surface.vertices.size();
  for (std::size_t i = 0; deformed && i < surface.vertices.size(); ++i)
    surface.vertices[i] = Eigen::Map<const Eigen::Vector3f>(&newest->second->positions[3 * i]).cast<double>();
  for (const shape_msgs::MeshTriangle& triangle : shape.triangles) {
    const auto& corners = triangle.vertex_indices;
    if (*std::max_element(corners.begin(), corners.end()) >= surface.vertices.size()) return {};
    surface.triangles.push_back({corners[0], corners[1], corners[2]});
  }
  return surface;
}

std::string touchesCsv(const sweep_guard::Touches& touches) {
  std::string csv = "mesh,revision,triangle,sweeps,depth_mm\n";
  for (const ObjectTouches& object : touches.objects) {
    for (std::size_t i = 0; i < object.triangles.size(); ++i) {
      csv += csvLine({object.mesh_id, std::to_string(object.revision), std::to_string(object.triangles[i]),
                      std::to_string(object.sweeps[i]), csvNumber(1e3 * static_cast<double>(object.depths[i]))});
    }
  }
  return csv;
}

std::string surfacesCsv(const TouchLog& log) {
  std::string csv = "mesh,triangle,x1,y1,z1,x2,y2,z2,x3,y3,z3\n";
  const auto& objects = log.touches().objects;
  for (std::size_t i = 0; i < std::min(objects.size(), kMaxWorkpieces); ++i) {
    const TriangleSurface surface = log.surfaceOf(objects[i]);
    if (surface.triangles.empty()) continue;
    const bool turned = isInsideOut(surface);
    std::vector<std::uint32_t> triangles = objects[i].triangles;
    if (surface.triangles.size() <= kMaxTriangles) {
      triangles.resize(surface.triangles.size());
      std::iota(triangles.begin(), triangles.end(), 0U);
    }
    for (const std::uint32_t triangle : triangles) csv += cornersCsv(objects[i].mesh_id, surface, triangle, turned);
  }
  return csv;
}

}  // namespace sweep_guard_session
