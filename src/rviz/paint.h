#pragma once

#include <OgreColourValue.h>
#include <OgreMaterial.h>

namespace sweep_guard_rviz {

/// Where everything drawn here keeps its resources: Ogre's default.
constexpr const char* kResources = "General";

/// A material that ignores the light, seen from both sides. One pass; more may be added.
/// @param lifted  how far it is drawn towards the eye, so that what lies in one plane does not flicker: 0 not, 1, 2...
Ogre::MaterialPtr makeMaterial(int lifted = 0);

/// One that is shaded by rviz's light, dimly on the side away from it.
Ogre::MaterialPtr makeShadedMaterial();

/// Ogre keeps it until then.
void drop(const Ogre::MaterialPtr& material);

/// In one colour. What is transparent hides nothing.
void paint(Ogre::Pass& pass, const Ogre::ColourValue& color);
void paintByVertices(Ogre::Pass& pass, float alpha);  ///< in the colours of the vertices, of this alpha
void paintShaded(Ogre::Pass& pass, const Ogre::ColourValue& color);

}  // namespace sweep_guard_rviz
