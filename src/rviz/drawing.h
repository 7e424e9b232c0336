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

/// Triangles and lines that are drawn anew whenever they change: few.
class Drawing {
 public:
  enum class Depth { kInTheScene, kOnTop };  ///< on top: nothing hides it

  Drawing(Ogre::SceneManager& scene, Ogre::SceneNode& node, Depth depth = Depth::kInTheScene);
  ~Drawing();
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

  void addFace(const std::vector<Ogre::Vector3>& corners);  ///< convex, with its outline
  /// A slender pyramid from a base of this radius to a tip.
  void addSpike(const Ogre::Vector3& base, const Ogre::Vector3& tip, float radius);
  void addBead(const Ogre::Vector3& center, float radius);

  void paint(const Ogre::ColourValue& faces, const Ogre::ColourValue& lines);
  void show();  ///< what was added since the last time, instead of what is there

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
