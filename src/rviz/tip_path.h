#pragma once

#include <OgreVector.h>
#include <geometry_msgs/Pose.h>
#include <ros/time.h>
#include <rviz/ogre_helpers/billboard_line.h>

#include <deque>
#include <vector>

#include "rviz/look.h"

namespace sweep_guard_rviz {

/// The way of the tip: where it has been for 2 s, and where it is expected.
class TipPath {
 public:
  TipPath(Ogre::SceneManager& scene, Ogre::SceneNode& node);

  /// A stamp that goes back begins anew.
  void add(ros::Time stamp, const geometry_msgs::Pose& pose);
  void show(const std::vector<geometry_msgs::Pose>& expected, const Part& part);
  void clear();

 private:
  struct Point {
    ros::Time stamp;
    Ogre::Vector3 position;
  };

  std::deque<Point> points_;
  rviz::BillboardLine measured_;
  rviz::BillboardLine expected_;
};

}  // namespace sweep_guard_rviz
