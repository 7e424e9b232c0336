#include "ros/scene/single_mesh_readers.h"

#include <algorithm>
#include <array>
#include <limits>

#include "ros/scene/placed_message.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::SceneObject;

constexpr std::int64_t kFloat32 = 7;  // sensor_msgs/PointField

// Of a uint32 in the definition that is known.
size_t sizeIn(const MessageValue& value) {
  const std::int64_t size = value.integer();
  if (size < 0 || size > std::numeric_limits<std::uint32_t>::max())
    throw InvalidInput("the cloud has a size that is none");
  return static_cast<size_t>(size);
}

size_t offsetInCloud(const MessageValue& cloud, std::string_view name) {
  for (const MessageValue& field : cloud["fields"].elements()) {
    if (field["name"].text() != name) continue;
    if (field["datatype"].integer() != kFloat32)
      throw InvalidInput("the points of the cloud have another type than float32 in '" + std::string(name) + "'");
    return sizeIn(field["offset"]);
  }
  throw InvalidInput("the points of the cloud have no field '" + std::string(name) + "'");
}

std::vector<Eigen::Vector3d> pointsIn(const MessageValue& cloud) {
  const std::array<size_t, 3> offsets = {offsetInCloud(cloud, "x"), offsetInCloud(cloud, "y"),
                                         offsetInCloud(cloud, "z")};
  const auto step = sizeIn(cloud["point_step"]);
  const auto width = sizeIn(cloud["width"]);
  const auto height = sizeIn(cloud["height"]);
  const auto row_step = sizeIn(cloud["row_step"]);
  const Wire data = cloud["data"].bytes();
  const size_t last = std::max({offsets[0], offsets[1], offsets[2]}) + sizeof(float);
  const bool fits = cloud["is_bigendian"].flag() == false && step >= last && row_step >= width * step &&
                    (height == 0 || row_step <= data.size / height);
  if (!fits) throw InvalidInput("the cloud is big-endian, or its sizes do not fit its data");
  std::vector<Eigen::Vector3d> points(width * height);
  auto p = points.begin();
  for (size_t row = 0; row < height; ++row) {
    for (size_t column = 0; column < width; ++column) {
      const std::uint8_t* const point = data.bytes + row * row_step + column * step;
      *p++ = {numberAt<float>(point + offsets[0]), numberAt<float>(point + offsets[1]),
              numberAt<float>(point + offsets[2])};
    }
  }
  return points;
}

}  // namespace

SceneObject readShapeMesh(const MessageValue& message, const EnvironmentTopic& topic) {
  if (topic.frame.empty()) throw InvalidInput("shape_msgs/Mesh names no frame: set `frame` of this topic");
  return {topic.id, topic.frame, {}, {message["vertices"].positions(), message["triangles"].triangles()}};
}

SceneObject readPolygonMesh(const MessageValue& message, const EnvironmentTopic& topic) {
  SceneObject object = objectAt(message["header"], topic.frame);
  object.id = topic.id;
  object.surface_M = {pointsIn(message["cloud"]), message["polygons"].triangles()};
  return object;
}

SceneObject readMeshGeometry(const MessageValue& message, const EnvironmentTopic& topic) {
  SceneObject object = objectAt(message["header"], topic.frame);
  object.id = topic.id;
  object.surface_M = {message["mesh_geometry"]["vertices"].positions(), message["mesh_geometry"]["faces"].triangles()};
  return object;
}

SceneObject readTriangleMesh(const MessageValue& message, const EnvironmentTopic& topic) {
  SceneObject object = objectAt(message["header"], topic.frame);
  object.id = topic.id;
  object.surface_M = {message["mesh"]["vertices"].positions(), message["mesh"]["triangles"].triangles()};
  return object;
}

}  // namespace sweep_guard_ros
