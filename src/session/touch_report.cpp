#include "session/touch_report.h"

#include <fmt/format.h>
#include <rosbag/view.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/csv.h"
#include "recording/bag.h"
#include "recording/gnuplot.h"

namespace sweep_guard_session {

using Eigen::Vector3d;
using sweep_guard::ObjectTouches;
using sweep_guard_core::csvLine;
using sweep_guard_core::csvNumber;
using sweep_guard_recording::gnuplotText;

namespace {

constexpr std::size_t kMaxWorkpieces = 4;
constexpr std::size_t kMaxTriangles = 30000;
constexpr double kUntouched = -0.15;  // on the scale of colors, where the touched are from 0 to 1
constexpr double kWidth = 1300.0;     // all in [pixel]
constexpr double kRowHeight = 480.0;
constexpr double kTitle = 40.0;

using Surface = TouchLog::Surface;

Vector3d middleOf(const Surface& surface, std::size_t triangle) {
  Vector3d sum = Vector3d::Zero();
  for (const std::uint32_t corner : surface.triangles[triangle]) sum += surface.vertices[corner];
  return sum / 3.0;
}

Vector3d areaOf(const Surface& surface, std::size_t triangle) {
  const auto& [a, b, c] = surface.triangles[triangle];
  const Vector3d& p = surface.vertices[a];
  return 0.5 * (surface.vertices[b] - p).cross(surface.vertices[c] - p);
}

Vector3d centerOf(const Surface& surface) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& vertex : surface.vertices) box.extend(vertex);
  return box.center();
}

// The side that was touched: outwards where the surface is closed, whatever its winding.
Vector3d directionOfView(const Surface& surface, const ObjectTouches& touches) {
  const Vector3d center = centerOf(surface);
  double volume = 0.0;
  for (std::size_t triangle = 0; triangle < surface.triangles.size(); ++triangle)
    volume += areaOf(surface, triangle).dot(middleOf(surface, triangle) - center);
  Vector3d normal = Vector3d::Zero();
  for (const std::uint32_t triangle : touches.triangles) normal += areaOf(surface, triangle);
  if (normal.norm() < 1e-12) return Vector3d::UnitZ();
  return (volume < 0.0 ? -1.0 : 1.0) * normal.normalized();
}

// A direction that is a little to the side shows the shape.
std::string viewFrom(const Vector3d& direction) {
  const double tilt = std::acos(std::clamp(direction.z(), -1.0, 1.0)) * 180.0 / M_PI;
  const double turn = std::atan2(direction.x(), -direction.y()) * 180.0 / M_PI;
  return fmt::format("set view {:.1f}, {:.1f}, 1.5\n", std::clamp(tilt + 25.0, 0.0, 180.0),
                     std::fmod(turn + 360.0, 360.0));
}

/// One of the two numbers as a scale of colors.
struct Scale {
  std::string title;
  std::string least;               // text at 0
  std::string largest;             // text at 1
  std::vector<double> of_touched;  // in [0, 1], in the order of the touched triangles; NaN: no color
};

Scale scaleOfSweeps(const ObjectTouches& touches) {
  const std::uint32_t largest = *std::max_element(touches.sweeps.begin(), touches.sweeps.end());
  Scale scale{"sweeps that touched a triangle", "1", std::to_string(largest), {}};
  for (const std::uint32_t sweeps : touches.sweeps)
    scale.of_touched.push_back(largest == 1 ? 0.0 : std::log(sweeps) / std::log(largest));
  return scale;
}

Scale scaleOfDepth(const ObjectTouches& touches) {
  float largest = 0.0F;
  for (const float depth : touches.depths) largest = std::fmax(largest, depth);
  Scale scale{"largest depth [mm]", "0", fmt::format("{:.1f}", 1e3 * static_cast<double>(largest)), {}};
  for (const float depth : touches.depths)
    scale.of_touched.push_back(largest == 0.0F ? 0.0 * static_cast<double>(depth)
                                               : static_cast<double>(depth / largest));
  return scale;
}

// A triangle is a patch of two by two points, of which two are the same.
std::string patch(const Surface& surface, std::size_t triangle, double color) {
  const auto point = [&](std::uint32_t corner) {
    const Vector3d& p = surface.vertices[corner];
    return fmt::format("{:.6g} {:.6g} {:.6g} {:.4g}\n", p.x(), p.y(), p.z(), color);
  };
  const auto& [a, b, c] = surface.triangles[triangle];
  return point(a) + point(b) + '\n' + point(c) + point(c) + "\n\n";
}

std::string patches(const Surface& surface, const ObjectTouches& touches, const Scale& scale) {
  std::vector<double> colors(surface.triangles.size(), kUntouched);
  for (std::size_t i = 0; i < touches.triangles.size(); ++i) {
    if (!std::isnan(scale.of_touched[i])) colors[touches.triangles[i]] = scale.of_touched[i];
  }
  std::string text;
  for (std::size_t i = 0; i < colors.size(); ++i) {
    if (colors.size() <= kMaxTriangles || colors[i] != kUntouched) text += patch(surface, i, colors[i]);
  }
  return text;
}

/// Part of the picture, in shares of its size.
struct Place {
  double left;
  double bottom;
  double height;

  std::string commands() const {
    return fmt::format(
        "set origin {:.3f}, {:.3f}\nset size 0.5, {:.3f}\n"
        "set colorbox user origin {:.3f}, {:.3f} size 0.01, {:.3f}\n",
        left, bottom, height, left + 0.40, bottom + 0.25 * height, 0.5 * height);
  }
};

std::string panel(const Surface& surface, const ObjectTouches& touches, const Scale& scale, const Place& place) {
  const std::string title =
      place.commands() + "set title " + gnuplotText(touches.mesh_id + ": " + scale.title) + " noenhanced\n";
  const std::string data = surface.triangles.empty() ? "" : patches(surface, touches, scale);
  if (data.empty()) {
    return title +
           "set label 1 'not drawn: see touches.csv' at graph 0.5, 0.5 center\nplot [0:1] [0:1] -1 notitle\nunset "
           "label 1\n";
  }
  return fmt::format(
      "{}{}set cbrange [{}:1]\nset cbtics ('none' {}, {} 0, {} 1)\n$patches << EOD\n{}EOD\n"
      "splot $patches using 1:2:3:4 with pm3d notitle\n",
      title, viewFrom(directionOfView(surface, touches)), kUntouched, kUntouched, gnuplotText(scale.least),
      gnuplotText(scale.largest), data);
}

}  // namespace

void TouchLog::readShapes(const std::string& bag, const SessionTopics& topics) {
  const std::vector<std::string> names = {topics.mesh, topics.mesh_vertices};
  sweep_guard_recording::openBag(bag, [&](const rosbag::Bag& open) {
    for (const rosbag::MessageInstance& message : rosbag::View(open, rosbag::TopicQuery(names))) {
      if (const auto mesh = message.instantiate<sweep_guard::DeformableMesh>()) take(mesh);
      if (const auto vertices = message.instantiate<sweep_guard::MeshVertices>()) take(vertices);
    }
  });
}

// Vertices of another revision, or of a mesh that was replaced, do not fit.
Surface TouchLog::surfaceOf(const ObjectTouches& touches) const {
  Surface surface;
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

std::string touchesPlot(const TouchLog& log, const std::string& title, const std::string& path) {
  const auto& objects = log.touches().objects;
  const std::size_t rows = std::clamp<std::size_t>(objects.size(), 1, kMaxWorkpieces);
  const double height = kRowHeight * static_cast<double>(rows) + kTitle;
  std::string script = fmt::format(
      "set terminal pngcairo size {},{} font 'sans,12'\nset output {}\nunset key\nunset tics\nunset border\n"
      "set view equal xyz\nset pm3d depthorder corners2color c1 border lc rgb '#999999' lw 0.2\n"
      "set palette defined ({} '#d6cdbc', -0.001 '#d6cdbc', 0 '#dadaeb', 0.2 '#bcbddc', 0.4 '#9e9ac8', 0.6 '#807dba', "
      "0.8 '#6a51a3', 1 '#4a1486')\nset multiplot title {} noenhanced\n",
      kWidth, height, gnuplotText(path), kUntouched, gnuplotText(title));
  for (std::size_t i = 0; i < std::min(objects.size(), kMaxWorkpieces); ++i) {
    const Surface surface = log.surfaceOf(objects[i]);
    const double row = kRowHeight / height;
    const double bottom = row * static_cast<double>(rows - 1 - i);
    script += panel(surface, objects[i], scaleOfSweeps(objects[i]), {0.0, bottom, row});
    script += panel(surface, objects[i], scaleOfDepth(objects[i]), {0.5, bottom, row});
  }
  if (objects.empty()) {
    script += "set label 'nothing was touched' at graph 0.5, 0.5 center\nplot [0:1] [0:1] -1 notitle\n";
  }
  return script + "unset multiplot\n";
}

}  // namespace sweep_guard_session
