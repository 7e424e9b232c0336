#include "rviz/tool_visual.h"

#include <OgreEntity.h>
#include <OgreManualObject.h>
#include <OgreMeshManager.h>
#include <OgrePass.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <OgreTechnique.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "rviz/drawing.h"
#include "rviz/ogre_conversions.h"

namespace sweep_guard_rviz {
namespace {

using Ogre::Vector3;

constexpr float kAsNear = 1e-4F;  // [m]

std::string newName() {
  static int made = 0;
  return "sweep_guard_tool_" + std::to_string(made++);
}

Vector3 centerOf(const shape_msgs::Mesh& piece) {
  Vector3 sum = Vector3::ZERO;
  for (const geometry_msgs::Point& vertex : piece.vertices) sum += toOgre(vertex);
  return sum / static_cast<float>(std::max<size_t>(1, piece.vertices.size()));
}

// The piece is convex: its normals point away from its center.
void add(Ogre::ManualObject& drawing, const shape_msgs::Mesh& piece) {
  const Vector3 center = centerOf(piece);
  for (const shape_msgs::MeshTriangle& triangle : piece.triangles) {
    Vector3 corners[3];
    for (size_t i = 0; i < 3; ++i) corners[i] = toOgre(piece.vertices[triangle.vertex_indices[i]]);
    Vector3 normal = (corners[1] - corners[0]).crossProduct(corners[2] - corners[0]).normalisedCopy();
    if (normal.dotProduct(corners[0] - center) < 0.0F) normal = -normal;
    for (const Vector3& corner : corners) {
      drawing.position(corner);
      drawing.normal(normal);
    }
  }
}

// A part of an older guard has no body: the tool is one.
size_t bodyOf(const sweep_guard::ToolShape& shape, size_t part) {
  constexpr size_t kMostBodies = 1000;
  return part < shape.bodies.size() ? std::min<size_t>(shape.bodies[part], kMostBodies) : 0;
}

bool haveMoved(const BodyPoses& from, const BodyPoses& to, const std::vector<BodySize>& bodies) {
  for (size_t i = 0; i < std::min({from.size(), to.size(), bodies.size()}); ++i) {
    const Ogre::Quaternion turn = toOgre(from[i].orientation).Inverse() * toOgre(to[i].orientation);
    const double angle = 2.0 * std::acos(std::min(1.0, static_cast<double>(std::abs(turn.w))));
    const auto distance = static_cast<double>(toOgre(from[i].position).distance(toOgre(to[i].position)));
    if (distance + bodies[i].radius * angle >= 0.5 * bodies[i].thickness) return true;
  }
  return false;
}

}  // namespace

ToolVisual::ToolVisual(Ogre::SceneManager& scene, Ogre::SceneNode& node)
    : scene_(scene), node_(node), material_(makeShadedMaterial()) {}

ToolVisual::~ToolVisual() {
  clear();
  drop(material_);
}

void ToolVisual::clear() {
  for (const Instance& instance : instances_) {
    if (instance.entity != nullptr) scene_.destroyEntity(instance.entity);
    scene_.destroySceneNode(instance.node);
    drop(instance.material);
  }
  instances_.clear();
  shown_ = 0;
  for (const Ogre::MeshPtr& mesh : meshes_) {
    if (mesh.get() != nullptr) Ogre::MeshManager::getSingleton().remove(mesh->getHandle());
  }
  meshes_.clear();
  sizes_.clear();
}

void ToolVisual::setShape(const sweep_guard::ToolShape& shape) {
  clear();
  if (shape.parts.empty()) return;
  size_t bodies = 1;
  for (size_t part = 0; part < shape.parts.size(); ++part) bodies = std::max(bodies, bodyOf(shape, part) + 1);
  for (size_t body = 0; body < bodies; ++body) addBody(shape, body);
}

void ToolVisual::addBody(const sweep_guard::ToolShape& shape, size_t body) {
  meshes_.emplace_back();
  sizes_.push_back({});
  Ogre::ManualObject drawing(newName());
  drawing.begin(material_->getName(), Ogre::RenderOperation::OT_TRIANGLE_LIST, kResources);
  for (size_t i = 0; i < shape.parts.size(); ++i) {
    const shape_msgs::Mesh& piece = shape.parts[i];
    if (bodyOf(shape, i) == body && indicesInRange(piece.triangles, piece.vertices.size())) add(drawing, piece);
  }
  if (drawing.getCurrentVertexCount() == 0) return;
  drawing.end();
  meshes_.back() = drawing.convertToMesh(newName(), kResources);
  const Ogre::AxisAlignedBox& box = drawing.getBoundingBox();
  const Vector3 size = box.getSize();
  sizes_.back() = {static_cast<double>(Ogre::Math::boundingRadiusFromAABB(box)),
                   static_cast<double>(std::min({size.x, size.y, size.z}))};
}

void ToolVisual::makeInstances() {
  for (const Ogre::MeshPtr& mesh : meshes_) {
    Instance instance{node_.createChildSceneNode(), mesh.get() != nullptr ? scene_.createEntity(mesh) : nullptr,
                      makeShadedMaterial()};
    if (instance.entity != nullptr) {
      instance.entity->setMaterial(instance.material);
      instance.node->attachObject(instance.entity);
    }
    instances_.push_back(instance);
  }
}

void ToolVisual::show(const std::vector<PlacedTool>& places) {
  if (!hasShape()) return;
  while (instances_.size() < places.size() * meshes_.size()) makeInstances();
  for (size_t i = 0; i < instances_.size(); ++i) {
    const size_t place = i / meshes_.size();
    const size_t body = i % meshes_.size();
    const bool visible = place < places.size() && body < places[place].bodies.size();
    instances_[i].node->setVisible(visible);
    if (!visible) continue;
    const geometry_msgs::Pose& pose = places[place].bodies[body];
    instances_[i].node->setPosition(toOgre(pose.position));
    instances_[i].node->setOrientation(toOgre(pose.orientation));
    paintShaded(*instances_[i].material->getTechnique(0)->getPass(0), places[place].color);
  }
  shown_ = places.size();
}

std::optional<Ogre::Vector3> heldPoint(const sweep_guard::MotionStatus& status, const sweep_guard::ToolShape& shape,
                                       const BodyPoses& bodies) {
  const Vector3 normal = toOgre(status.normal);
  const bool held = status.code != sweep_guard::MotionStatus::NO_WARNING && !normal.isZeroLength();
  if (!held || status.piece >= shape.parts.size() || bodyOf(shape, status.piece) >= bodies.size()) return {};
  const geometry_msgs::Pose& pose = bodies[bodyOf(shape, status.piece)];
  Vector3 sum;
  float count = 0.0F;
  float nearest = std::numeric_limits<float>::infinity();
  for (const geometry_msgs::Point& vertex : shape.parts[status.piece].vertices) {
    const Vector3 point = toOgre(pose.position) + toOgre(pose.orientation) * toOgre(vertex);
    const float height = normal.dotProduct(point);
    if (height > nearest + kAsNear) continue;
    if (height < nearest - kAsNear) count = 0.0F;
    sum = count > 0.0F ? sum + point : point;
    nearest = count > 0.0F ? nearest : height;
    ++count;
  }
  return count > 0.0F ? std::optional(sum / count) : std::nullopt;
}

std::vector<size_t> pickGhosts(const std::vector<BodyPoses>& path, size_t max_count,
                               const std::vector<BodySize>& bodies) {
  std::vector<size_t> picked;
  for (size_t i = 1; i <= max_count && !path.empty(); ++i) {
    const size_t next = (path.size() * i + max_count - 1) / max_count - 1;
    if (!picked.empty() && (next == picked.back() || !haveMoved(path[picked.back()], path[next], bodies))) continue;
    picked.push_back(next);
  }
  return picked;
}

}  // namespace sweep_guard_rviz
