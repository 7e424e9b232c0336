#include "sweep_guard/rviz/workpiece_visual.h"

#include <OgreSceneManager.h>
#include <OgreSceneNode.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sweep_guard/rviz/attach.h"
#include "sweep_guard/rviz/ogre_conversions.h"
#include "sweep_guard/rviz/volume_faces.h"

namespace sweep_guard_rviz {
namespace {

using sweep_guard::TriangleContact;

constexpr size_t kMostContacts = 200;

bool allFinite(const std::vector<float>& values) {
  return std::all_of(values.begin(), values.end(), [](float value) { return std::isfinite(value); });
}

bool refersTo(const std::vector<shape_msgs::MeshTriangle>& triangles, size_t vertices) {
  return std::all_of(triangles.begin(), triangles.end(), [&](const shape_msgs::MeshTriangle& triangle) {
    const auto& corners = triangle.vertex_indices;
    return std::all_of(corners.begin(), corners.end(), [&](std::uint32_t corner) { return corner < vertices; });
  });
}

std::vector<float> positionsOf(const shape_msgs::Mesh& mesh) {
  std::vector<float> positions;
  positions.reserve(3 * mesh.vertices.size());
  for (const geometry_msgs::Point& p : mesh.vertices) {
    for (const double value : {p.x, p.y, p.z}) positions.push_back(static_cast<float>(value));
  }
  return positions;
}

Ogre::ColourValue outline(const Part& part) {
  Ogre::ColourValue color = part.color;
  color.a = part.shown ? std::min(1.0F, 3.0F * color.a) : 0.0F;
  return color;
}

void showAll(Drawing& drawing, const std::vector<sweep_guard::TestedVolume>& volumes) {
  for (const sweep_guard::TestedVolume& volume : volumes) {
    for (const Face& face : facesOf(volume)) drawing.addFace(face);
  }
}

}  // namespace

WorkpieceVisual::WorkpieceVisual(Ogre::SceneManager& scene, Ogre::SceneNode& root)
    : scene_(scene),
      root_(root),
      node_(root.createChildSceneNode()),
      surface_(scene, *node_),
      measured_(scene, *node_),
      predicted_(scene, *node_),
      points_(scene, *node_, Drawing::Depth::kOnTop),
      depths_(scene, *node_, Drawing::Depth::kOnTop),
      label_("-"),
      label_node_(node_->createChildSceneNode()) {
  label_.showOnTop(true);
  label_node_->attachObject(&label_);
  label_node_->setVisible(false);
}

WorkpieceVisual::~WorkpieceVisual() {
  label_node_->detachAllObjects();
  scene_.destroySceneNode(label_node_);
  scene_.destroySceneNode(node_);
}

std::string WorkpieceVisual::setMesh(const sweep_guard::DeformableMesh& message) {
  const std::vector<float> positions = positionsOf(message.mesh);
  if (!refersTo(message.mesh.triangles, message.mesh.vertices.size()))
    return "a triangle has a corner that is not there";
  if (!allFinite(positions)) return "a vertex is NaN or infinite";
  surface_.setTriangles(message.mesh.triangles, message.mesh.vertices.size());
  surface_.setVertices(positions.data());
  frame_ = message.header.frame_id;
  revision_ = message.revision;
  highlights_.reset();
  return "";
}

std::string WorkpieceVisual::setVertices(const sweep_guard::MeshVertices& message) {
  if (!revision_ || message.revision != *revision_) return "its triangles have not come: vertices of another revision";
  if (message.positions.size() != 3 * surface_.vertexCount()) return "vertices of another number than the mesh has";
  if (!allFinite(message.positions)) return "a vertex is NaN or infinite";
  surface_.setVertices(message.positions.data());
  frame_ = message.header.frame_id;
  return "";
}

void WorkpieceVisual::show(const sweep_guard::ObjectView& view, const Look& look) {
  if (frame_.empty()) frame_ = view.frame_id;
  Highlights highlights;
  if (fits(view)) highlights = highlightsOf(view, surface_.triangleCount());
  if (!highlights_ || !(*highlights_ == highlights)) surface_.highlight(highlights);
  highlights_ = std::move(highlights);
  showVolumes(view, look);
  showContacts(view, look);
}

void WorkpieceVisual::paint(const Look& look) {
  const bool edges = surface_.triangleCount() <= look.most_edged;
  surface_.paintLayer(SurfaceVisual::kSurface, look.surface.color, look.surface.shown, edges);
  surface_.paintLayer(SurfaceVisual::kTouched, look.touched.color, look.touched.shown, true);
  surface_.paintLayer(SurfaceVisual::kReflex, look.reflex.color, look.reflex.shown, true);
  surface_.paintLayer(SurfaceVisual::kConsidered, look.considered.color, look.considered.shown, true);
  measured_.paint(look.measured.color, outline(look.measured));
  predicted_.paint(look.predicted.color, outline(look.predicted));
  points_.paint(look.contacts.color, look.contacts.color);
  depths_.paint(look.touched.color, look.touched.color);
}

void WorkpieceVisual::showVolumes(const sweep_guard::ObjectView& view, const Look& look) {
  if (look.measured.shown) {
    showAll(measured_, view.measured);
    for (const sweep_guard::TestedVolume& volume : view.measured) remember(volume, static_cast<size_t>(look.history));
    showAll(measured_, {history_.begin(), history_.end()});
  }
  measured_.show();
  if (look.predicted.shown) showAll(predicted_, view.predicted);
  predicted_.show();
}

// Close enough to leave no gap. A sweep in parts shows them all again and again: each is kept once.
void WorkpieceVisual::remember(const sweep_guard::TestedVolume& volume, size_t most) {
  const auto& half = volume.half_extents;
  const auto spacing = static_cast<float>(std::min({half.x, half.y, half.z}));
  const Ogre::Vector3 center = toOgre(volume.pose.position);
  const bool kept = std::any_of(history_.begin(), history_.end(), [&](const sweep_guard::TestedVolume& one) {
    return toOgre(one.pose.position).distance(center) < spacing;
  });
  if (!kept) history_.push_back(volume);
  while (history_.size() > most) history_.pop_front();
}

void WorkpieceVisual::showContacts(const sweep_guard::ObjectView& view, const Look& look) {
  const TriangleContact* deepest = nullptr;
  const size_t count = look.contacts.shown ? std::min(kMostContacts, view.impacts.size()) : 0;
  for (size_t i = 0; i < count; ++i) {
    const TriangleContact& contact = view.impacts[i];
    const Ogre::Vector3 point = toOgre(contact.point);
    const Ogre::Vector3 normal = toOgre(contact.normal);
    points_.addBead(point, 0.5F * look.point_size);
    points_.addSpike(point, point + look.normal_length * normal, 0.25F * look.point_size);
    if (!look.depths || !(contact.depth > 0.0)) continue;
    depths_.addSpike(point, point - static_cast<float>(contact.depth) * normal, 0.25F * look.point_size);
    if (deepest == nullptr || contact.depth > deepest->depth) deepest = &contact;
  }
  points_.show();
  depths_.show();
  label(deepest, look);
}

void WorkpieceVisual::label(const TriangleContact* deepest, const Look& look) {
  label_node_->setVisible(deepest != nullptr);
  if (deepest == nullptr) return;
  char text[32];
  std::snprintf(text, sizeof text, "%.1f mm deep", 1e3 * deepest->depth);
  label_.setCaption(text);
  label_.setCharacterHeight(0.5F * look.normal_length);
  label_.setColor(look.contacts.color);
  label_node_->setPosition(toOgre(deepest->point) + 1.7F * look.normal_length * toOgre(deepest->normal));
}

void WorkpieceVisual::place(const Ogre::Vector3& position, const Ogre::Quaternion& orientation) {
  node_->setPosition(position);
  node_->setOrientation(orientation);
}

void WorkpieceVisual::setVisible(bool visible) { attach(root_, *node_, visible); }

}  // namespace sweep_guard_rviz
