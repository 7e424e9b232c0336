#pragma once

#include <OgreColourValue.h>
#include <OgreMaterial.h>
#include <OgreMesh.h>
#include <OgrePrerequisites.h>
#include <geometry_msgs/Pose.h>
#include <sweep_guard/MotionStatus.h>
#include <sweep_guard/ToolShape.h>

#include <optional>
#include <vector>

#include "rviz/ogre_vector.h"

namespace sweep_guard_rviz {

/// How large a body of a tool is.
struct BodySize {
  double radius;     ///< bound on the distance of a point from the origin of the body [m]
  double thickness;  ///< smallest extent along an axis of the body [m]
};

/// The pose of each body of a tool at one time.
using BodyPoses = std::vector<geometry_msgs::Pose>;

/// Draws the tool at several poses at once, each in a color of its own.
class ToolVisual {
 public:
  struct PlacedTool {
    BodyPoses bodies;  ///< in the frame of the node
    Ogre::ColourValue color;
  };

  ToolVisual(Ogre::SceneManager& scene, Ogre::SceneNode& node);
  ~ToolVisual();
  ToolVisual(const ToolVisual&) = delete;
  ToolVisual& operator=(const ToolVisual&) = delete;

  void setShape(const sweep_guard::ToolShape& shape);
  bool hasShape() const { return !meshes_.empty(); }
  const std::vector<BodySize>& sizes() const { return sizes_; }  ///< of each body

  /// Shows the tool at these poses only; a body without a pose is not shown.
  void show(const std::vector<PlacedTool>& places);
  size_t shown() const { return shown_; }  ///< number of tools shown

 private:
  struct Instance {
    Ogre::SceneNode* node;
    Ogre::Entity* entity;
    Ogre::MaterialPtr material;
  };

  void clear();
  void addBody(const sweep_guard::ToolShape& shape, size_t body);
  void makeInstances();

  Ogre::SceneManager& scene_;
  Ogre::SceneNode& node_;
  Ogre::MaterialPtr material_;         // of the meshes; each instance has its own
  std::vector<Ogre::MeshPtr> meshes_;  // of each body; null for one without a part
  std::vector<BodySize> sizes_;
  std::vector<Instance> instances_;  // of each body in turn, for each tool
  size_t shown_ = 0;
};

/// Returns where a motion guard holds the tool back: the middle of those points of the piece that come nearest to the surface;
/// empty: it passes commands on, no surface limits them, or the piece is not known.
/// @param bodies  poses of the tool's bodies in the frame of the status
std::optional<Ogre::Vector3> heldPoint(const sweep_guard::MotionStatus& status, const sweep_guard::ToolShape& shape,
                                       const BodyPoses& bodies);

/// Returns the indices of the poses at which ghosts are drawn: evenly spread, without those in which no body has moved by half
/// of its thickness since the previous one.
/// @param max_count  largest number of ghosts
std::vector<size_t> pickGhosts(const std::vector<BodyPoses>& path, size_t max_count,
                               const std::vector<BodySize>& bodies);

}  // namespace sweep_guard_rviz
