#pragma once

#include <OgreColourValue.h>
#include <OgreMaterial.h>
#include <OgreMesh.h>
#include <OgrePrerequisites.h>
#include <geometry_msgs/Pose.h>
#include <sweep_guard/ToolShape.h>

#include <vector>

namespace sweep_guard_rviz {

/// Draws the tool at several poses at once, each in a color of its own.
class ToolVisual {
 public:
  struct PlacedTool {
    geometry_msgs::Pose pose;  ///< in the frame of the node
    Ogre::ColourValue color;
  };

  ToolVisual(Ogre::SceneManager& scene, Ogre::SceneNode& node);
  ~ToolVisual();
  ToolVisual(const ToolVisual&) = delete;
  ToolVisual& operator=(const ToolVisual&) = delete;

  void setShape(const sweep_guard::ToolShape& shape);
  bool hasShape() const { return mesh_ != nullptr; }
  double boundingRadius() const {
    return bounding_radius_;
  }                                                ///< bound on the distance of a point from the tool's origin [m]
  double thickness() const { return thickness_; }  ///< smallest extent along an axis of the tool frame [m]

  /// Shows the tool at these poses only.
  void show(const std::vector<PlacedTool>& places);
  size_t shown() const { return shown_; }  ///< number of tools shown

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
  double bounding_radius_ = 0.0;
  double thickness_ = 0.0;
  std::vector<Instance> instances_;
  size_t shown_ = 0;
};

/// Returns the indices of the poses at which ghosts are drawn: evenly spread, without those that hardly differ from the
/// previous one.
/// @param max_count    largest number of ghosts
/// @param tool_radius  bounding radius of the tool [m]
/// @param spacing      distance that some point of the tool must move between two ghosts [m]
std::vector<size_t> pickGhosts(const std::vector<geometry_msgs::Pose>& path, size_t max_count, double tool_radius,
                               double spacing);

}  // namespace sweep_guard_rviz
