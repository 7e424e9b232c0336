#include "ros/scene/scene_file.h"

#include <ros/names.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>

#include "scene/primitives.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/ros/tool/mesh_file.h"

namespace sweep_guard_ros {
namespace {

using std::filesystem::path;
using sweep_guard_core::InvalidInput;
using sweep_guard_core::printable;
using sweep_guard_core::SceneObject;
using sweep_guard_core::TriangleSurface;

constexpr double kMaxPlace = 1e6;  // [m]
constexpr double kMaxAngle = 6.3;  // [rad]; a full turn: whoever says more means degrees
constexpr size_t kMaxObjects = 1000;
constexpr std::uintmax_t kMaxSceneFile = 1U << 20U;

[[noreturn]] void refuse(const YAML::Node& node, const std::string& what) {
  throw InvalidInput("line " + std::to_string(node.Mark().line + 1) + ": " + what);
}

template <typename Value>
Value as(const YAML::Node& node, const std::string& wanted) {
  try {
    return node.as<Value>();
  } catch (const YAML::Exception&) {
    refuse(node, "must be " + wanted);
  }
}

template <size_t kCount>
std::array<double, kCount> numbers(const YAML::Node& node, const std::string& wanted) {
  const auto read = as<std::vector<double>>(node, wanted);
  std::array<double, kCount> numbers{};
  if (read.size() != kCount) refuse(node, "must be " + wanted);
  std::copy(read.begin(), read.end(), numbers.begin());
  for (const double number : numbers) {
    if (!(std::abs(number) <= kMaxPlace)) refuse(node, "must be " + wanted + ", each within +-1e6");
  }
  return numbers;
}

Eigen::Vector3d vectorOf(const YAML::Node& node, const char* wanted) {
  if (!node) return Eigen::Vector3d::Zero();
  return Eigen::Vector3d(numbers<3>(node, wanted).data());
}

Eigen::Vector3d scaleOf(const YAML::Node& node) {
  if (!node) return Eigen::Vector3d::Ones();
  const std::string wanted = "a scale, or [x, y, z]";
  Eigen::Vector3d scale = node.IsSequence() ? Eigen::Vector3d(numbers<3>(node, wanted).data())
                                            : Eigen::Vector3d::Constant(as<double>(node, wanted));
  if (!(scale.cwiseAbs().minCoeff() >= 1e-6 && scale.cwiseAbs().maxCoeff() <= 1e6))
    refuse(node, "must be " + wanted + ", within 1e-6 and 1e6");
  return scale;
}

path meshPath(const std::string& name, const path& folder) {
  if (name.find("://") != std::string::npos) return locateMesh(name, {"/"});
  return folder / name;
}

using ReadShape = std::function<TriangleSurface(const YAML::Node&, const path& folder)>;

TriangleSurface readBox(const YAML::Node& node, const path& /*folder*/) {
  const auto [x, y, z] = numbers<3>(node, "[x, y, z], the lengths of its edges [m]");
  return sweep_guard_core::boxPrimitive({x, y, z});
}

TriangleSurface readCylinder(const YAML::Node& node, const path& /*folder*/) {
  const auto [radius, height] = numbers<2>(node, "[radius, height] [m]");
  return sweep_guard_core::cylinderPrimitive(radius, height);
}

TriangleSurface readSphere(const YAML::Node& node, const path& /*folder*/) {
  return sweep_guard_core::spherePrimitive(as<double>(node, "a radius [m]"));
}

TriangleSurface readFloor(const YAML::Node& node, const path& /*folder*/) {
  TriangleSurface surface = sweep_guard_core::floorPrimitive();
  const auto top = as<double>(node, "the z of its top [m]");
  for (Eigen::Vector3d& vertex : surface.vertices) vertex.z() += top;
  return surface;
}

TriangleSurface readMeshShape(const YAML::Node& node, const path& folder) {
  return readMesh(meshPath(as<std::string>(node, "the name of a mesh file"), folder), /*follow_link=*/true);
}

const std::map<std::string, ReadShape>& shapes() {
  static const std::map<std::string, ReadShape> kShapes = {{"box", readBox},
                                                           {"cylinder", readCylinder},
                                                           {"floor", readFloor},
                                                           {"mesh", readMeshShape},
                                                           {"sphere", readSphere}};
  return kShapes;
}

std::string shapeIn(const YAML::Node& object) {
  static const std::set<std::string> kPlace = {"frame", "position", "rpy", "scale", "open"};
  std::string shape;
  for (const auto& entry : object) {
    const auto name = as<std::string>(entry.first, "a name");
    if (kPlace.count(name) != 0) continue;
    if (shapes().count(name) == 0)
      refuse(entry.first,
             "'" + printable(name) +
                 "' is unknown: give box, cylinder, floor, mesh or sphere, and frame, position, rpy, scale, open");
    if (!shape.empty()) refuse(entry.first, "has two shapes: give each workpiece one, or another id");
    shape = name;
  }
  if (shape.empty()) refuse(object, "has no shape: give it a box, cylinder, floor, mesh or sphere");
  if (shape != "mesh" && object["scale"])
    refuse(object["scale"], "only a mesh has a scale: give the sizes of the others as they are");
  return shape;
}

void place(const YAML::Node& object, TriangleSurface& surface) {
  const Eigen::Vector3d position = vectorOf(object["position"], "a position [x, y, z] [m]");
  const char* const angles = "the angles [roll, pitch, yaw] [rad], each within a turn";
  const Eigen::Vector3d rpy = vectorOf(object["rpy"], angles);
  if (rpy.cwiseAbs().maxCoeff() > kMaxAngle) refuse(object["rpy"], std::string("must be ") + angles);
  const Eigen::Vector3d scale = scaleOf(object["scale"]);
  const Eigen::Matrix3d R =
      (Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  for (Eigen::Vector3d& vertex : surface.vertices) vertex = R * scale.cwiseProduct(vertex) + position;
}

SceneObject readObject(const std::string& id, const YAML::Node& object, const path& folder) {
  if (!sweep_guard_core::isName(id)) refuse(object, "its id is empty, or has more than 128 or unprintable characters");
  if (!object.IsMap()) refuse(object, "must be a group, as in {box: [1.2, 0.8, 0.05], frame: base_link}");
  const std::string shape = shapeIn(object);
  SceneObject read;
  read.id = id;
  read.frame = object["frame"] ? as<std::string>(object["frame"], "the name of a frame") : "world";
  read.open = object["open"] && as<bool>(object["open"], "true or false");
  read.surface_M = shapes().at(shape)(object[shape], folder);
  place(object, read.surface_M);
  return read;
}

EnvironmentTopic readTopic(const YAML::Node& entry) {
  EnvironmentTopic topic;
  if (!entry.IsMap()) refuse(entry, "must be a group, as in {topic: /obstacles}");
  for (const auto& [key, value] : entry.as<std::map<std::string, YAML::Node>>()) {
    if (key == "topic") {
      topic.topic = as<std::string>(value, "the name of a topic");
    } else if (key == "id") {
      topic.id = as<std::string>(value, "an id");
    } else if (key == "frame") {
      topic.frame = as<std::string>(value, "the name of a frame");
    } else if (key == "namespaces") {
      const auto names = as<std::vector<std::string>>(value, "a list of namespaces of markers");
      topic.namespaces.insert(names.begin(), names.end());
    } else if (key == "hold") {
      topic.holds = as<bool>(value, "true or false");
    } else if (key == "stream") {
      topic.streams = as<bool>(value, "true or false");
    } else if (key == "service") {
      topic.service = as<std::string>(value, "the name of a service");
    } else {
      refuse(value,
             "'" + printable(key) + "' is unknown: give topic, and maybe id, frame, namespaces, hold, stream, service");
    }
  }
  std::string error;
  if (topic.topic.empty() || !ros::names::validate(topic.topic, error)) refuse(entry, "names no topic: " + error);
  return topic;
}

std::vector<EnvironmentTopic> readTopics(const YAML::Node& list) {
  std::vector<EnvironmentTopic> topics;
  std::set<std::string> names;
  if (!list.IsSequence()) refuse(list, "must be a list of topics, as in [{topic: /obstacles}]");
  for (const auto& entry : list) {
    topics.push_back(readTopic(entry));
    if (!names.insert(topics.back().topic).second) refuse(entry, "this topic was there before");
  }
  return topics;
}

bool isText(const std::string& scene) { return scene.find_first_not_of(" \n") == scene.find('{'); }

YAML::Node load(const std::string& scene) {
  if (isText(scene)) return YAML::Load(scene);
  std::error_code error;
  if (std::filesystem::file_size(scene, error) > kMaxSceneFile || error)
    throw InvalidInput(error ? error.message() + (path(scene).is_absolute() ? "" : ": give an absolute path")
                             : "larger than 1 MiB: describe the workpieces in mesh files");
  return YAML::LoadFile(scene);
}

}  // namespace

Scene readScene(const std::string& scene) {
  const std::string name = isText(scene) ? "scene" : scene;
  const path folder = isText(scene) ? path("/") : path(scene).parent_path();
  Scene read;
  std::string id;
  try {
    const YAML::Node root = load(scene);
    if (!root.IsMap() || root.size() > kMaxObjects)
      throw InvalidInput(
          "must be a group of 1 to 1000 workpieces by their ids, as in {table: {box: [1.2, 0.8, 0.05]}}");
    std::set<std::string> ids;
    for (const auto& entry : root) {
      id = as<std::string>(entry.first, "an id");
      if (!ids.insert(id).second) refuse(entry.first, "this id was there before");
      if (id == "environment") {
        read.topics = readTopics(entry.second);
      } else {
        read.objects.push_back(readObject(id, entry.second, folder));
      }
    }
  } catch (const YAML::Exception& error) {
    throw InvalidInput(name + ": " + error.what());
  } catch (const InvalidInput& error) {
    throw InvalidInput(name + ": " + (id.empty() ? "" : "'" + printable(id) + "': ") + error.what());
  }
  return read;
}

}  // namespace sweep_guard_ros
