#pragma once

#include <geometry_msgs/Pose.h>
#include <rviz/ogre_helpers/movable_text.h>
#include <sweep_guard/Interaction.h>

#include <memory>
#include <string>
#include <vector>

#include "rviz/display_style.h"
#include "rviz/drawing.h"

namespace sweep_guard_rviz {

/// Draws the force of each workpiece on the tool as an arrow from the centroid of the volume that they have in common, with
/// force, volume and depth as text at its tip.
class ForceVisual {
 public:
  /// @param node  at the frame of the poses
  ForceVisual(Ogre::SceneManager& scene, Ogre::SceneNode& node);
  ~ForceVisual();
  ForceVisual(const ForceVisual&) = delete;
  ForceVisual& operator=(const ForceVisual&) = delete;

  /// @param tool  pose of the frame in which the interaction is
  void show(const sweep_guard::Interaction& interaction, const geometry_msgs::Pose& tool, const DisplayStyle& style);
  void clear();

  size_t shown() const { return shown_; }  ///< number of arrows

 private:
  void addLabel();
  void label(const std::string& text, const Ogre::Vector3& place, const DisplayStyle& style);

  Ogre::SceneManager& scene_;
  Ogre::SceneNode& node_;
  Drawing arrows_;
  std::vector<std::unique_ptr<rviz::MovableText>> labels_;  // each on a node of its own
  size_t shown_ = 0;
};

}  // namespace sweep_guard_rviz
