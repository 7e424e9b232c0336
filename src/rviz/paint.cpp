#include "rviz/paint.h"

#include <OgreMaterialManager.h>
#include <OgrePass.h>
#include <OgreTechnique.h>

#include <string>

namespace sweep_guard_rviz {
namespace {

void blend(Ogre::Pass& pass, float alpha) {
  const bool opaque = alpha >= 1.0F;
  pass.setSceneBlending(opaque ? Ogre::SBT_REPLACE : Ogre::SBT_TRANSPARENT_ALPHA);
  pass.setDepthWriteEnabled(opaque);
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

void drop(const Ogre::MaterialPtr& material) { Ogre::MaterialManager::getSingleton().remove(material); }

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

}  // namespace sweep_guard_rviz
