#include "rviz/workpiece_visual.h"

#include <OgreSceneManager.h>
#include <OgreSceneNode.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "rviz/ogre_conversions.h"

namespace sweep_guard_rviz {
namespace {

using sweep_guard::TriangleContact;

constexpr size_t kMaxContacts = 200;

bool allFinite(const std::vector<float>& values) {
  return std::all_of(values.begin(), values.end(), [](float value) { return std::isfinite(value); });
}

std::vector<float> positionsOf(const shape_msgs::Mesh& mesh) {
  std::vector<float> positions;
  positions.reserve(3 * mesh.vertices.size());
  for (const geometry_msgs::Point& p : mesh.vertices) {
    for (const double value : {p.x, p.y, p.z}) positions.push_back(static_cast<float>(value));
  }
  return positions;
}

Ogre::ColourValue outline(const ElementStyle& element) {
  Ogre::ColourValue color = element.color;
  color.a = element.shown ? std::min(1.0F, 3.0F * color.a) : 0.0F;
  return color;
}

void showAll(Drawing& drawing, const std::vector<sweep_guard::TestedVolume>& volumes) {
  for (const sweep_guard::TestedVolume& volume : volumes) {
    for (const Face& face : facesOf(volume)) drawing.addFace(face);
  }
}

std::string labelOf(const TriangleContact& deepest, const DisplayStyle& style) {
  char text[32];
  if (style.since_contact) {
    std::snprintf(text, sizeof text, "touched %.1f s ago", *style.since_contact);
  } else {
    std::snprintf(text, sizeof text, "%.1f mm deep", 1e3 * deepest.depth);
  }
  return text;
}

}  // namespace

WorkpieceVisual::WorkpieceVisual(Ogre::SceneManager& scene, Ogre::SceneNode& root)
    : scene_(scene),
      root_(root),
      node_(root.createChildSceneNode()),
      surface_(scene, *node_),
      measured_(scene, *node_),
      predicted_(scene, *node_),
      points_(scene, *node_, /*on_top=*/true),
      normals_(scene, *node_, /*on_top=*/true),
      depths_(scene, *node_, /*on_top=*/true),
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
  if (!indicesInRange(message.mesh.triangles, message.mesh.vertices.size())) return "a triangle index is out of range";
  if (!allFinite(positions)) return "a vertex is NaN or infinite";
  surface_.setTriangles(message.mesh.triangles, message.mesh.vertices.size());
  surface_.setVertices(positions.data());
  frame_ = message.header.frame_id;
  revision_ = message.revision;
  highlights_.reset();
  heat_ = {};
  return "";
}

std::string WorkpieceVisual::setVertices(const sweep_guard::MeshVertices& message) {
  if (!revision_ || message.revision != *revision_) return "no mesh yet for this revision of vertices";
  if (message.positions.size() != 3 * surface_.vertexCount()) return "the number of vertices differs from the mesh's";
  if (!allFinite(message.positions)) return "a vertex is NaN or infinite";
  surface_.setVertices(message.positions.data());
  frame_ = message.header.frame_id;
  return "";
}

void WorkpieceVisual::setIntended(std::uint32_t revision, const std::vector<std::uint32_t>& triangles) {
  intended_revision_ = revision;
  intended_ = triangles;
}

void WorkpieceVisual::setTouches(const sweep_guard::ObjectTouches& touches, ColorBy by) {
  HeatMap map = revision_ == touches.revision ? heatMapOf(touches, by, surface_.triangleCount()) : HeatMap();
  colored_by_ = by;
  if (map == heat_) return;
  surface_.color(map);
  heat_ = std::move(map);
}

std::string WorkpieceVisual::legend() const { return legendOf(heat_, colored_by_); }

void WorkpieceVisual::show(const sweep_guard::ObjectView& view, const DisplayStyle& style) {
  if (frame_.empty()) frame_ = view.frame_id;
  static const std::vector<std::uint32_t> kNone;
  const SurfaceVisual::Highlights highlights =
      highlightsOf(fits(view) ? view : sweep_guard::ObjectView(), revision_ == intended_revision_ ? intended_ : kNone,
                   surface_.triangleCount());
  if (highlights_ != highlights) surface_.highlight(highlights);
  highlights_ = highlights;
  showVolumes(view, style);
  showContacts(view, style);
}

void WorkpieceVisual::showSurfaceOnly() {
  history_.clear();
  show(sweep_guard::ObjectView(), DisplayStyle());
}

void WorkpieceVisual::paint(const DisplayStyle& style) {
  const bool edges = surface_.triangleCount() <= style.max_edged;
  surface_.paintLayer(SurfaceVisual::kSurface, style.surface.color, style.surface.shown, edges);
  for (size_t i = 0; i < kHeatColors; ++i) {
    Ogre::ColourValue color = heatColors()[i];
    color.a = style.surface.color.a;
    surface_.paintLayer(static_cast<SurfaceVisual::Layer>(SurfaceVisual::kHeat + i), color, style.surface.shown, false);
  }
  surface_.paintLayer(SurfaceVisual::kTouched, style.touched.color, style.touched.shown, true);
  surface_.paintLayer(SurfaceVisual::kReflex, style.reflex.color, style.reflex.shown, true);
  surface_.paintLayer(SurfaceVisual::kConsidered, style.considered.color, style.considered.shown, true);
  surface_.paintLayer(SurfaceVisual::kIntended, style.intended.color, style.intended.shown, true);
  surface_.paintLayer(SurfaceVisual::kAllowed, style.allowed.color, style.allowed.shown, true);
  measured_.paint(style.measured.color, outline(style.measured));
  predicted_.paint(style.predicted.color, outline(style.predicted));
  points_.paint(style.contacts.color, style.contacts.color);
  normals_.paint(style.normals.color, style.normals.color);
  depths_.paint(style.depths.color, style.depths.color);
}

void WorkpieceVisual::showVolumes(const sweep_guard::ObjectView& view, const DisplayStyle& style) {
  if (style.measured.shown) {
    showAll(measured_, view.measured);
    showAll(measured_, history_.beside(view.measured));
    history_.add(view.measured, style.history);
  }
  measured_.show();
  if (style.predicted.shown) showAll(predicted_, view.predicted);
  predicted_.show();
}

void WorkpieceVisual::showContacts(const sweep_guard::ObjectView& view, const DisplayStyle& style) {
  const TriangleContact* deepest = nullptr;
  for (size_t i = 0; i < std::min(kMaxContacts, view.impacts.size()); ++i) {
    const TriangleContact& contact = view.impacts[i];
    const Ogre::Vector3 point = toOgre(contact.point);
    const Ogre::Vector3 normal = toOgre(contact.normal);
    if (style.contacts.shown) points_.addBead(point, 0.5F * style.point_size);
    if (style.normals.shown) normals_.addSpike(point, point + style.normal_length * normal, 0.25F * style.point_size);
    if (!style.depths.shown || !(contact.depth > 0.0)) continue;
    if (!style.since_contact)
      depths_.addSpike(point, point - static_cast<float>(contact.depth) * normal, 0.25F * style.point_size);
    if (deepest == nullptr || contact.depth > deepest->depth) deepest = &contact;
  }
  points_.show();
  normals_.show();
  depths_.show();
  label(deepest, style);
}

void WorkpieceVisual::label(const TriangleContact* deepest, const DisplayStyle& style) {
  label_node_->setVisible(deepest != nullptr);
  if (deepest == nullptr) return;
  label_.setCaption(labelOf(*deepest, style));
  label_.setCharacterHeight(0.5F * style.normal_length);
  label_.setColor(style.depths.color);
  label_node_->setPosition(toOgre(deepest->point) + 1.7F * style.normal_length * toOgre(deepest->normal));
}

void WorkpieceVisual::place(const Ogre::Vector3& position, const Ogre::Quaternion& orientation) {
  node_->setPosition(position);
  node_->setOrientation(orientation);
}

void WorkpieceVisual::setVisible(bool visible) { attach(root_, *node_, visible); }

}  // namespace sweep_guard_rviz
