#pragma once

#include <OgreColourValue.h>
#include <OgreMaterial.h>
#include <OgreMesh.h>
#include <geometry_msgs/Pose.h>
#include <sweep_guard/ToolShape.h>

#include <vector>

namespace Ogre {
class Entity;
class SceneManager;
class SceneNode;
}  // namespace Ogre

namespace sweep_guard_rviz {

/// The tool at several places at once, each in a colour of its own.
class ToolVisual {
 public:
  struct Placed {
    geometry_msgs::Pose pose;  ///< in the frame of the node
    Ogre::ColourValue color;
  };

  ToolVisual(Ogre::SceneManager& scene, Ogre::SceneNode& node);
  ~ToolVisual();
  ToolVisual(const ToolVisual&) = delete;
  ToolVisual& operator=(const ToolVisual&) = delete;

  void setShape(const sweep_guard::ToolShape& shape);
  bool hasShape() const { return mesh_ != nullptr; }
  double reach() const { return reach_; }          ///< largest distance of a point from the tool's origin [m]
  double thickness() const { return thickness_; }  ///< smallest extent along an axis of the tool frame [m]

  void show(const std::vector<Placed>& places);  ///< there, and nowhere else
  size_t shown() const { return shown_; }

 private:
  struct Instance {
    Ogre::SceneNode* node;
    Ogre::Entity* entity;
    Ogre::MaterialPtr material;
  };

  void clear();
  Instance make();

  Ogre::SceneManager& scene_;
  Ogre::SceneNode& node_;
  Ogre::MaterialPtr material_;  // of the mesh; each instance has its own
  Ogre::MeshPtr mesh_;
  double reach_ = 0.0;
  double thickness_ = 0.0;
  std::vector<Instance> instances_;
  size_t shown_ = 0;
};

/// Indices of the poses of a path that are worth a ghost: evenly spread, none that has hardly moved since the one
/// before.
/// @param reach    of the tool [m]
/// @param spacing  that some point of the tool has to move [m]
std::vector<size_t> pickGhosts(const std::vector<geometry_msgs::Pose>& path, size_t most, double reach, double spacing);

}  // namespace sweep_guard_rviz
