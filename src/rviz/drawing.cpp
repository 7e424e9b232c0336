#include "rviz/drawing.h"

#include <OgreManualObject.h>
#include <OgreMaterialManager.h>
#include <OgrePass.h>
#include <OgreSceneManager.h>
#include <OgreTechnique.h>

#include <array>
#include <string>

namespace sweep_guard_rviz {
namespace {

void blend(Ogre::Pass& pass, float alpha) {
  const bool opaque = alpha >= 1.0F;
  pass.setSceneBlending(opaque ? Ogre::SBT_REPLACE : Ogre::SBT_TRANSPARENT_ALPHA);
  pass.setDepthWriteEnabled(opaque);
}

using Ogre::Vector3;

void addAll(Ogre::ManualObject& object, const Ogre::MaterialPtr& material, Ogre::RenderOperation::OperationType type,
            std::vector<Vector3>& points) {
  if (points.empty()) return;
  object.begin(material->getName(), type, kResources);
  for (const Vector3& point : points) object.position(point);
  object.end();
  points.clear();
}

// Corners of a square across a direction, about its middle.
std::array<Vector3, 4> squareAcross(const Vector3& direction, float radius) {
  const Vector3 u = radius * direction.perpendicular().normalisedCopy();
  const Vector3 v = radius * direction.crossProduct(u).normalisedCopy();
  return {u, v, -u, -v};
}

}  // namespace

Ogre::MaterialPtr makeMaterial(int lifted) {
  static int made = 0;
  const std::string name = "sweep_guard_material_" + std::to_string(made++);
  const Ogre::MaterialPtr material = Ogre::MaterialManager::getSingleton().create(name, kResources);
  material->setReceiveShadows(false);
  material->setCullingMode(Ogre::CULL_NONE);
  material->setDepthBias(static_cast<float>(lifted), static_cast<float>(lifted));
  return material;
}

Ogre::MaterialPtr makeShadedMaterial() {
  const Ogre::MaterialPtr material = makeMaterial();
  material->setLightingEnabled(true);
  return material;
}

void drop(const Ogre::MaterialPtr& material) { Ogre::MaterialManager::getSingleton().remove(material->getHandle()); }

void paint(Ogre::Pass& pass, const Ogre::ColourValue& color) {
  pass.setLightingEnabled(true);
  pass.setAmbient(Ogre::ColourValue::Black);
  pass.setDiffuse(0.0F, 0.0F, 0.0F, color.a);
  pass.setSelfIllumination(color);
  blend(pass, color.a);
}

void paintByVertices(Ogre::Pass& pass, float alpha) {
  pass.setLightingEnabled(false);
  blend(pass, alpha);
}

void paintShaded(Ogre::Pass& pass, const Ogre::ColourValue& color) {
  pass.setAmbient(Ogre::ColourValue::Black);
  pass.setDiffuse(0.55F * color.r, 0.55F * color.g, 0.55F * color.b, color.a);
  pass.setSelfIllumination(0.45F * color);
  blend(pass, color.a);
}

Drawing::Drawing(Ogre::SceneManager& scene, Ogre::SceneNode& node, bool on_top)
    : scene_(scene), object_(scene.createManualObject()), faces_(makeMaterial()), lines_(makeMaterial()) {
  if (on_top) {
    faces_->setDepthCheckEnabled(false);
    lines_->setDepthCheckEnabled(false);
    object_->setRenderQueueGroup(Ogre::RENDER_QUEUE_6);
  }
  object_->setDynamic(true);
  node.attachObject(object_);
}

Drawing::~Drawing() {
  scene_.destroyManualObject(object_);
  drop(faces_);
  drop(lines_);
}

void Drawing::addTriangle(const Vector3& a, const Vector3& b, const Vector3& c) {
  triangle_corners_.insert(triangle_corners_.end(), {a, b, c});
}

void Drawing::addFace(const std::vector<Vector3>& corners) {
  for (size_t i = 2; i < corners.size(); ++i) addTriangle(corners[0], corners[i - 1], corners[i]);
  for (size_t i = 0; i < corners.size(); ++i) {
    line_ends_.push_back(corners[i]);
    line_ends_.push_back(corners[(i + 1) % corners.size()]);
  }
}

void Drawing::addSpike(const Vector3& base, const Vector3& tip, float radius) {
  const std::array<Vector3, 4> corners = squareAcross(tip - base, radius);
  for (size_t i = 0; i < 4; ++i) addTriangle(base + corners[i], base + corners[(i + 1) % 4], tip);
}

void Drawing::addArrow(const Vector3& base, const Vector3& tip, float radius) {
  const std::array<Vector3, 4> corners = squareAcross(tip - base, radius);
  const Vector3 neck = tip - 6.0F * radius * (tip - base).normalisedCopy();
  for (size_t i = 0; i < 4; ++i) {
    const Vector3& corner = corners[i];
    const Vector3& next = corners[(i + 1) % 4];
    addTriangle(base + corner, base + next, neck + corner);
    addTriangle(base + next, neck + next, neck + corner);
  }
  addSpike(neck, tip, 2.0F * radius);
}

void Drawing::addBead(const Vector3& center, float radius) {
  addSpike(center, center + radius * Vector3::UNIT_Z, radius);
  addSpike(center, center - radius * Vector3::UNIT_Z, radius);
}

void Drawing::paint(const Ogre::ColourValue& faces, const Ogre::ColourValue& lines) {
  sweep_guard_rviz::paint(*faces_->getTechnique(0)->getPass(0), faces);
  sweep_guard_rviz::paint(*lines_->getTechnique(0)->getPass(0), lines);
}

void Drawing::show() {
  object_->clear();
  addAll(*object_, faces_, Ogre::RenderOperation::OT_TRIANGLE_LIST, triangle_corners_);
  addAll(*object_, lines_, Ogre::RenderOperation::OT_LINE_LIST, line_ends_);
}

}  // namespace sweep_guard_rviz
