#pragma once

#include <OgreColourValue.h>
#include <OgreMaterial.h>

namespace sweep_guard_rviz {

/// The Ogre resource group of everything drawn here: Ogre's default.
constexpr const char* kResources = "General";

/// Makes a material that ignores light and is visible from both sides. It has one pass; more may be added.
/// @param lifted  depth bias towards the eye that keeps coplanar surfaces from flickering: 0 is none
Ogre::MaterialPtr makeMaterial(int lifted = 0);

/// Makes a material that is shaded by rviz's light, dimly on its dark side.
Ogre::MaterialPtr makeShadedMaterial();

/// Removes a material from Ogre, which otherwise keeps it.
void drop(const Ogre::MaterialPtr& material);

/// Paints in one color. Transparent surfaces hide nothing.
void paint(Ogre::Pass& pass, const Ogre::ColourValue& color);
/// Paints in the colors of the vertices with this alpha.
void paintByVertices(Ogre::Pass& pass, float alpha);
void paintShaded(Ogre::Pass& pass, const Ogre::ColourValue& color);

}  // namespace sweep_guard_rviz
