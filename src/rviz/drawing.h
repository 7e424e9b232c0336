#pragma once

#include <OgreColourValue.h>
#include <OgreMaterial.h>
#include <OgreVector.h>

#include <vector>

namespace Ogre {
class ManualObject;
class SceneManager;
class SceneNode;
}  // namespace Ogre

namespace sweep_guard_rviz {

/// Draws a small number of triangles and lines that are replaced whenever they change.
class Drawing {
 public:
  enum class Depth { kInTheScene, kOnTop };  ///< kOnTop: nothing hides the drawing

  Drawing(Ogre::SceneManager& scene, Ogre::SceneNode& node, Depth depth = Depth::kInTheScene);
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
