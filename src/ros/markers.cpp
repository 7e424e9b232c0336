#include "sweep_guard/ros/markers.h"

#include "sweep_guard/geometry/convex_polytope.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Level;
using visualization_msgs::Marker;

constexpr double kLifetime = 0.5;  // [s]

std_msgs::ColorRGBA color(double r, double g, double b, double alpha) {
  std_msgs::ColorRGBA color;
  color.r = static_cast<float>(r);
  color.g = static_cast<float>(g);
  color.b = static_cast<float>(b);
  color.a = static_cast<float>(alpha);
  return color;
}

std_msgs::ColorRGBA levelColor(Level level, double alpha) {
  switch (level) {
    case Level::kClear:
      return color(0.2, 0.75, 0.3, alpha);
    case Level::kConsidered:
      return color(1.0, 0.7, 0.1, alpha);
    case Level::kReflex:
    case Level::kContact:
      return color(0.95, 0.15, 0.1, alpha);
    case Level::kUnknown:
      break;
  }
  return color(0.55, 0.55, 0.55, alpha);
}

geometry_msgs::Point point(const Eigen::Vector3d& p) {
  geometry_msgs::Point msg;
  msg.x = p.x();
  msg.y = p.y();
  msg.z = p.z();
  return msg;
}

Marker marker(const std::string& ns, int id, int type, const std::string& frame, sweep_guard::Time stamp) {
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

void addFaces(Marker& faces, const sweep_guard::Polygon& polygon) {
  for (size_t i = 2; i < polygon.size(); ++i) {
    for (const size_t corner : {size_t{0}, i - 1, i}) faces.points.push_back(point(polygon[corner]));
  }
}

void addEdges(Marker& edges, const sweep_guard::Polygon& polygon) {
  for (size_t i = 0; i < polygon.size(); ++i) {
    edges.points.push_back(point(polygon[i]));
    edges.points.push_back(point(polygon[(i + 1) % polygon.size()]));
  }
}

// The volumes of one object's sweep, as faces (even id) and edges (odd id) in the frame of the workpiece.
void addSweptVolume(visualization_msgs::MarkerArray& array, const sweep_guard::SweptObject& object, int index,
                    sweep_guard::Time stamp, Level level) {
  Marker faces = marker("swept_volume", 2 * index, Marker::TRIANGLE_LIST, object.workpiece->frame, stamp);
  Marker edges = marker("swept_volume", 2 * index + 1, Marker::LINE_LIST, object.workpiece->frame, stamp);
  faces.color = levelColor(level, 0.25);
  edges.color = levelColor(level, 0.8);
  edges.scale.x = 0.001;
  for (const sweep_guard::SweptVolume& volume_M : object.findings.volumes_M) {
    const auto polygons = sweep_guard::polytopeFaces(volume_M.halfSpaces_B(), volume_M.box.half_extents.norm());
    for (sweep_guard::Polygon polygon : polygons) {
      for (Eigen::Vector3d& p : polygon) p = volume_M.box.X_MB * p;
      addFaces(faces, polygon);
      addEdges(edges, polygon);
    }
  }
  array.markers.push_back(std::move(faces));
  array.markers.push_back(std::move(edges));
}

// The triangles met, a little off the surface on either side: in it they would flicker with whoever draws the
// workpiece.
void addContactTriangles(visualization_msgs::MarkerArray& array, const sweep_guard::SweptObject& object, int index,
                         sweep_guard::Time stamp, double lift) {
  if (object.findings.triangles.empty()) return;
  Marker faces = marker("contact_triangles", 2 * index, Marker::TRIANGLE_LIST, object.workpiece->frame, stamp);
  Marker edges = marker("contact_triangles", 2 * index + 1, Marker::LINE_LIST, object.workpiece->frame, stamp);
  faces.color = color(1.0, 0.15, 0.1, 0.95);
  edges.color = color(1.0, 0.75, 0.7, 0.95);
  edges.scale.x = lift;
  const sweep_guard::TriangleMesh& mesh_M = object.workpiece->mesh_M;
  for (const std::uint32_t triangle : object.findings.triangles) {
    const auto& [a, b, c] = mesh_M.triangles()[triangle];
    const Eigen::Vector3d p = mesh_M.vertex(a);
    const Eigen::Vector3d q = mesh_M.vertex(b);
    const Eigen::Vector3d r = mesh_M.vertex(c);
    const Eigen::Vector3d off = lift * (q - p).cross(r - p).stableNormalized();
    addFaces(faces, {p + off, q + off, r + off});
    addFaces(faces, {p - off, r - off, q - off});
    addEdges(edges, {p + off, q + off, r + off});
    addEdges(edges, {p - off, q - off, r - off});
  }
  array.markers.push_back(std::move(faces));
  array.markers.push_back(std::move(edges));
}

}  // namespace

Markers::Markers(std::string fixed_frame, const sweep_guard::Tool& tool)
    : fixed_frame_(std::move(fixed_frame)), tool_radius_(tool.radius()), tool_length_(tool.length()) {}

visualization_msgs::MarkerArray Markers::draw(const MarkerScene& scene) {
  visualization_msgs::MarkerArray array;
  const Level level = scene.verdict.level;
  if (scene.newest) {
    const sweep_guard::Time stamp = scene.newest->end;
    Marker tool = marker("tool", 0, Marker::CYLINDER, fixed_frame_, stamp);
    tool.pose = toMsg(scene.X_WT * Eigen::Translation3d(0.0, 0.0, -0.5 * tool_length_));
    tool.scale.x = tool.scale.y = 2.0 * tool_radius_;
    tool.scale.z = tool_length_;
    tool.color = level == Level::kUnknown ? levelColor(level, 0.6) : color(0.35, 0.5, 0.9, 0.8);
    array.markers.push_back(tool);

    Marker text = marker("warning_text", 0, Marker::TEXT_VIEW_FACING, fixed_frame_, stamp);
    text.pose = toMsg(scene.X_WT * Eigen::Translation3d(0.0, 0.0, -1.3 * tool_length_));
    text.scale.z = 0.025;
    text.color = levelColor(level, 0.95);
    text.text = scene.verdict.text;
    array.markers.push_back(text);

    int index = 0;
    for (const auto& object : scene.newest->objects) addSweptVolume(array, object, index++, stamp, level);
  }
  if (scene.contact && level == Level::kContact) {
    int index = 0;
    for (const auto& object : scene.contact->objects)
      addContactTriangles(array, object, index++, scene.newest->end, 0.1 * tool_radius_);
  }

  deleteGone(array);
  return array;
}

void Markers::deleteGone(visualization_msgs::MarkerArray& array) {
  std::set<Key> now_shown;
  for (const Marker& drawn : array.markers) now_shown.emplace(drawn.ns, drawn.id);
  for (const auto& [ns, id] : shown_) {
    if (now_shown.count({ns, id}) != 0) continue;
    Marker gone = marker(ns, id, Marker::CUBE, fixed_frame_, {});
    gone.action = Marker::DELETE;
    array.markers.push_back(gone);
  }
  shown_ = std::move(now_shown);
}

}  // namespace sweep_guard_ros
