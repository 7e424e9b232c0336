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
#include <string>

#include "rviz/ogre_conversions.h"
#include "rviz/paint.h"
#include "rviz/triangles.h"

namespace sweep_guard_rviz {
namespace {

using Ogre::Vector3;

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

}  // namespace

ToolVisual::ToolVisual(Ogre::SceneManager& scene, Ogre::SceneNode& node)
    : scene_(scene), node_(node), material_(makeShadedMaterial()) {}

ToolVisual::~ToolVisual() {
  clear();
  drop(material_);
}

void ToolVisual::clear() {
  for (const Instance& instance : instances_) {
    scene_.destroyEntity(instance.entity);
    scene_.destroySceneNode(instance.node);
    drop(instance.material);
  }
  instances_.clear();
  shown_ = 0;
  if (mesh_) Ogre::MeshManager::getSingleton().remove(mesh_);
  mesh_.reset();
}

void ToolVisual::setShape(const sweep_guard::ToolShape& shape) {
  clear();
  Ogre::ManualObject drawing(newName());
  drawing.begin(material_->getName(), Ogre::RenderOperation::OT_TRIANGLE_LIST, kResources);
  for (const shape_msgs::Mesh& piece : shape.parts) {
    if (indicesInRange(piece.triangles, piece.vertices.size())) add(drawing, piece);
  }
  if (drawing.getCurrentVertexCount() == 0) return;
  drawing.end();
  mesh_ = drawing.convertToMesh(newName(), kResources);
  const Ogre::AxisAlignedBox& box = drawing.getBoundingBox();
  const Vector3 size = box.getSize();
  thickness_ = static_cast<double>(std::min({size.x, size.y, size.z}));
  bounding_radius_ = static_cast<double>(Ogre::Math::boundingRadiusFromAABB(box));
}

ToolVisual::Instance ToolVisual::make() {
  Instance instance{node_.createChildSceneNode(), scene_.createEntity(mesh_), makeShadedMaterial()};
  instance.entity->setMaterial(instance.material);
  instance.node->attachObject(instance.entity);
  return instance;
}

void ToolVisual::show(const std::vector<PlacedTool>& places) {
  if (!mesh_) return;
  while (instances_.size() < places.size()) instances_.push_back(make());
  for (size_t i = 0; i < instances_.size(); ++i) {
    instances_[i].node->setVisible(i < places.size());
    if (i >= places.size()) continue;
    instances_[i].node->setPosition(toOgre(places[i].pose.position));
    instances_[i].node->setOrientation(toOgre(places[i].pose.orientation));
    paintShaded(*instances_[i].material->getTechnique(0)->getPass(0), places[i].color);
  }
  shown_ = places.size();
}

std::vector<size_t> pickGhosts(const std::vector<geometry_msgs::Pose>& path, size_t max_count, double tool_radius,
                               double spacing) {
  std::vector<size_t> picked;
  for (size_t i = 1; i <= max_count && !path.empty(); ++i) {
    const size_t next = (path.size() * i + max_count - 1) / max_count - 1;
    if (!picked.empty()) {
      const geometry_msgs::Pose& previous = path[picked.back()];
      const Ogre::Quaternion turn = toOgre(previous.orientation).Inverse() * toOgre(path[next].orientation);
      const double angle = 2.0 * std::acos(std::min(1.0, static_cast<double>(std::abs(turn.w))));
      const float distance = toOgre(previous.position).distance(toOgre(path[next].position));
      if (next == picked.back() || static_cast<double>(distance) + tool_radius * angle < spacing) continue;
    }
    picked.push_back(next);
  }
  return picked;
}

}  // namespace sweep_guard_rviz
