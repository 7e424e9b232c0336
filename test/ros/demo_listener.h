#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <ros/ros.h>
#include <sweep_guard/Warning.h>

#include <Eigen/Core>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <vector>

namespace sweep_guard_ros {

/// Listens to what the demo's operator does with the tool, and to what the guard says of it.
class DemoListener {
 public:
  DemoListener();

  /// All poses so far, as soon as they fit. @throws std::runtime_error after 20 s
  using Poses = std::vector<geometry_msgs::PoseStamped>;
  Poses awaitPoses(const std::function<bool(const Poses&)>& fit) const;
  Poses awaitPoses(size_t count) const;
  /// The poses from the first one on that as many others follow which are equal to it.
  Poses awaitRest(size_t count) const;

  bool touched() const;       ///< the guard has told of a contact
  void awaitContact() const;  ///< returns when it has. @throws std::runtime_error after 20 s

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  Poses poses_;
  bool touched_ = false;
  ros::NodeHandle node_;
  ros::Subscriber pose_subscriber_;
  ros::Subscriber warning_subscriber_;
  ros::AsyncSpinner spinner_{1};
};

Eigen::Vector3d positionOf(const geometry_msgs::PoseStamped& pose);

/// Farthest way between one pose and the next [m].
double longestStep(const DemoListener::Poses& poses);

/// Whether the stamps are so far apart, all of them, to the nanosecond; farther only where the operator stalled.
bool isEven(const DemoListener::Poses& poses, const ros::Duration& period);

}  // namespace sweep_guard_ros
