#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <ros/node_handle.h>
#include <sweep_guard/Proximity.h>
#include <sweep_guard/ToolBalls.h>
#include <sweep_guard/Warning.h>

#include <Eigen/Core>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "repeater.h"

namespace sweep_guard_ros {

/// A ball of an arm, seen from the frame of a link, and the joints that the guard of the arm knows.
struct FakeLink {
  std::string tool = "tool";                           ///< frame of the tool
  std::string link = {};                               ///< empty: the tool frame
  Eigen::Vector3d center = Eigen::Vector3d::Zero();    ///< in the link's frame [m]
  Eigen::Vector3d center_T = Eigen::Vector3d::Zero();  ///< where `positions` place it [m]
  std::vector<std::string> joints = {};
  std::vector<double> positions = {};  ///< [rad or m]
};

/// What a guard publishes about a tool that is one small ball, above a plane whose normal is z. At 100 Hz.
class FakeGuard {
 public:
  static constexpr double kRadius = 0.005;  ///< of the ball [m]
  static constexpr double kFar = 1.0;       ///< height at first [m]

  explicit FakeGuard(const std::string& name, FakeLink link = {});

  void setGap(double gap);  ///< between the ball and the plane [m]
  void setJoints(const std::vector<std::string>& joints);
  void setLevel(std::uint8_t level);
  void setSilent(bool silent);

 private:
  void publish();
  sweep_guard::Proximity proximity(ros::Time now) const;

  ros::NodeHandle node_;
  std::mutex mutex_;
  FakeLink link_;
  double gap_ = kFar;
  std::uint8_t level_ = sweep_guard::Warning::CLEAR;
  bool silent_ = false;
  ros::Publisher warnings_;
  ros::Publisher proximities_;
  ros::Publisher balls_;
  std::optional<Repeater> repeater_;  // ends before what it publishes
};

}  // namespace sweep_guard_ros
