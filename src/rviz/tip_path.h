#pragma once

#include <geometry_msgs/Pose.h>
#include <ros/time.h>
#include <rviz/ogre_helpers/billboard_line.h>

#include <vector>

#include "common/trail.h"
#include "rviz/display_style.h"

namespace sweep_guard_rviz {

/// Draws the path of the tool's tip: measured (the last 2 s) and predicted.
class TipPath {
 public:
  TipPath(Ogre::SceneManager& scene, Ogre::SceneNode& node);

  /// Adds a measured pose; first forgets all others if its stamp is older than the newest one's.
  void add(ros::Time stamp, const geometry_msgs::Pose& pose);
  void show(const std::vector<geometry_msgs::Pose>& predicted, const ElementStyle& element);
  void clear();

 private:
  sweep_guard_core::Trail trail_;
  rviz::BillboardLine measured_;
  rviz::BillboardLine predicted_;
};

}  // namespace sweep_guard_rviz
