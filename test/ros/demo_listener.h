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

/// Records the tool poses of the demo's operator and the contacts of the guard.
class DemoListener {
 public:
  DemoListener();

  /// Waits until the poses fit, and returns them all. @throws std::runtime_error after 20 s
  using Poses = std::vector<geometry_msgs::PoseStamped>;
  Poses awaitPoses(const std::function<bool(const Poses&)>& fit) const;
  Poses awaitPoses(size_t count) const;
  /// Returns the poses up to the first one that this many equal poses follow.
  Poses awaitRest(size_t count) const;

  bool inContact() const;     ///< the guard has reported a contact
  bool acknowledged() const;  ///< the guard has reported an acknowledged warning
  void awaitContact() const;  ///< waits for a contact. @throws std::runtime_error after 20 s

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  Poses poses_;
  bool in_contact_ = false;
  bool acknowledged_ = false;
  ros::NodeHandle node_;
  ros::Subscriber pose_subscriber_;
  ros::Subscriber warning_subscriber_;
  ros::AsyncSpinner spinner_{1};
};

Eigen::Vector3d positionOf(const geometry_msgs::PoseStamped& pose);

/// Returns the largest distance between two successive poses [m].
double longestStep(const DemoListener::Poses& poses);

/// Returns whether all stamps have this distance to the nanosecond; a larger one only where the operator stalled.
bool isEven(const DemoListener::Poses& poses, const ros::Duration& period);

}  // namespace sweep_guard_ros
