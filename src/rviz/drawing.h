#pragma once

#include <OgreColourValue.h>
#include <OgreMaterial.h>
#include <OgreSceneNode.h>

#include <vector>

#include "rviz/ogre_vector.h"

namespace Ogre {
class ManualObject;
class SceneManager;
}  // namespace Ogre

namespace sweep_guard_rviz {

/// Shows a node below its parent or detaches it. Setting its visibility instead would overwrite that of its children.
inline void attach(Ogre::SceneNode& parent, Ogre::SceneNode& node, bool shown) {
  if (shown == (node.getParent() != nullptr)) return;
  if (shown) {
    parent.addChild(&node);
  } else {
    parent.removeChild(&node);
  }
}

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

/// Draws a small number of triangles and lines that are replaced whenever they change.
class Drawing {
 public:
  /// @param on_top  nothing hides the drawing
  Drawing(Ogre::SceneManager& scene, Ogre::SceneNode& node, bool on_top = false);
  ~Drawing();
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

  /// Adds a convex polygon and its outline.
  void addFace(const std::vector<Ogre::Vector3>& corners);
  /// Adds a four-sided pyramid from a base of this radius to a tip.
  void addSpike(const Ogre::Vector3& base, const Ogre::Vector3& tip, float radius);
  /// Adds a four-sided shaft of this radius with a pyramid of twice the radius at its tip.
  void addArrow(const Ogre::Vector3& base, const Ogre::Vector3& tip, float radius);
  /// Adds a small octahedron.
  void addBead(const Ogre::Vector3& center, float radius);

  void paint(const Ogre::ColourValue& faces, const Ogre::ColourValue& lines);
  /// Replaces the shown triangles and lines by those added since the last call.
  void show();

 private:
  void addTriangle(const Ogre::Vector3& a, const Ogre::Vector3& b, const Ogre::Vector3& c);

  Ogre::SceneManager& scene_;
  Ogre::ManualObject* object_;
  Ogre::MaterialPtr faces_;
  Ogre::MaterialPtr lines_;
  std::vector<Ogre::Vector3> triangle_corners_;
  std::vector<Ogre::Vector3> line_ends_;
};

}  // namespace sweep_guard_rviz
