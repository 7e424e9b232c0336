#include "ros/scene/workpiece_publisher.h"

#include <ros/single_subscriber_publisher.h>
#include <sweep_guard/MeshVertices.h>
#include <tf2_eigen/tf2_eigen.h>

#include <cstring>
#include <utility>
#include <vector>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::SceneObject;
using sweep_guard_core::Triangle;

constexpr auto kMeshArrives = std::chrono::milliseconds(300);
constexpr std::uint32_t kQueueLength = 2000;  // all workpieces may be published at once

template <typename Msg>
Msg headed(const SceneObject& object, std::uint32_t revision, const ros::Time& stamp) {
  Msg message;
  message.header.stamp = stamp;
  message.header.frame_id = object.frame;
  message.id = object.id;
  message.revision = revision;
  return message;
}

bool sameTriangles(const std::vector<Triangle>& a, const std::vector<Triangle>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Triangle)) == 0;
}

bool sameMesh(const SceneObject& a, const SceneObject& b) {
  return a.frame == b.frame && a.open == b.open && a.surface_M.vertices.size() == b.surface_M.vertices.size() &&
         sameTriangles(a.surface_M.triangles, b.surface_M.triangles);
}

}  // namespace

// Revisions go on from one process to the next, so that nothing is said of a mesh of the one before.
WorkpiecePublisher::WorkpiecePublisher(ros::NodeHandle node, std::function<void()> on_guard)
    : revision_(static_cast<std::uint32_t>(ros::WallTime::now().sec)),
      vertices_(node.advertise<sweep_guard::MeshVertices>("mesh_vertices", kQueueLength)),
      mesh_(node.advertise<sweep_guard::DeformableMesh>(
          "mesh", kQueueLength,
          [this, on_guard = std::move(on_guard)](const ros::SingleSubscriberPublisher& subscriber) {
            {
              const sweep_guard_core::Lock lock(mutex_);
              for (const auto& [id, published] : published_) subscriber.publish(messageOf(id, published));
            }
            on_guard();
          })) {}

// Positions that would overtake their mesh wait for confirm().
void WorkpiecePublisher::show(const Object& object, bool as_mesh) {
  const sweep_guard_core::Lock lock(mutex_);
  Published& published = published_[object->id];
  const bool moves =
      !as_mesh && published.revision != 0 && published.refused.empty() && sameMesh(*published.object, *object);
  published.object = object;
  published.refused.clear();
  if (!moves) return publishMesh(published);
  published.has_moved = true;
  if (now().steady - published.mesh_at >= kMeshArrives) publishPositions(published);
}

void WorkpiecePublisher::refuse(const std::string& id, const std::string& why) {
  const sweep_guard_core::Lock lock(mutex_);
  Published& published = published_[id];
  if (published.refused == why) return;
  published.refused = why;
  mesh_.publish(messageOf(id, published));
}

void WorkpiecePublisher::remove(const std::string& id) {
  const sweep_guard_core::Lock lock(mutex_);
  mesh_.publish(messageOf(id, {}));
  published_.erase(id);
}

void WorkpiecePublisher::withdraw(const std::string& id) {
  const sweep_guard_core::Lock lock(mutex_);
  Published& published = published_[id];
  published = {};
  mesh_.publish(messageOf(id, published));
}

sweep_guard::DeformableMesh WorkpiecePublisher::messageOf(const std::string& id, const Published& published) {
  sweep_guard::DeformableMesh message;
  if (!published.refused.empty() || !published.object) {
    message.header.stamp = ros::Time::now();
    message.id = id;
    message.refused = published.refused;
    return message;
  }
  const SceneObject& object = *published.object;
  message = headed<sweep_guard::DeformableMesh>(object, published.revision, toMsg(object.stamp));
  message.open = object.open;
  for (const Eigen::Vector3d& vertex : object.surface_M.vertices) message.mesh.vertices.push_back(tf2::toMsg(vertex));
  for (const auto& [a, b, c] : object.surface_M.triangles)
    message.mesh.triangles.emplace_back().vertex_indices = {a, b, c};
  return message;
}

void WorkpiecePublisher::publishMesh(Published& published) {
  published.revision = ++revision_;
  published.mesh_at = now().steady;
  published.has_moved = published.moves = false;
  mesh_.publish(messageOf(published.object->id, published));
}

void WorkpiecePublisher::publishPositions(Published& published) {
  const SceneObject& object = *published.object;
  auto message = headed<sweep_guard::MeshVertices>(object, published.revision, toMsg(object.stamp));
  message.positions.resize(3 * object.surface_M.vertices.size());
  float* position = message.positions.data();
  for (const Eigen::Vector3d& vertex : object.surface_M.vertices) {
    for (const double coordinate : vertex) *position++ = static_cast<float>(coordinate);
  }
  published.moves = true;
  vertices_.publish(message);
}

void WorkpiecePublisher::confirm(const std::function<bool(const std::string& id)>& rests) {
  const sweep_guard_core::Lock lock(mutex_);
  const ros::Time stamp = ros::Time::now();
  for (auto& [id, published] : published_) {
    const bool moves = std::exchange(published.moves, false);
    if (!published.refused.empty() || !published.object || moves) continue;
    if (published.has_moved) {
      if (now().steady - published.mesh_at >= kMeshArrives) publishMesh(published);
    } else if (rests(id)) {
      vertices_.publish(headed<sweep_guard::MeshVertices>(*published.object, published.revision, stamp));
    }
  }
}

}  // namespace sweep_guard_ros
