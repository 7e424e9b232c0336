#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/TwistStamped.h>
#include <ros/node_handle.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Float64.h>
#include <std_srvs/Empty.h>

#include <list>
#include <mutex>
#include <optional>
#include <string>

#include "listener.h"
#include "repeater.h"

namespace sweep_guard_ros {

/// What MoveIt Servo of ROS Noetic does with a twist: names, types, time-out, scale and sticky status are those of
/// moveit_servo/src/servo_calcs.cpp. The arm is shoulder and elbow of arm.urdf, stretched out: the shoulder alone moves its end.
class FakeServo {
 public:
  struct Iteration {
    geometry_msgs::Twist velocity;  ///< that the robot is sent
    double scale;                   ///< collision_velocity_scale
    int status;
  };

  static constexpr double kReach = 0.5;  ///< of the end of the arm [m]

  /// Reads incoming_command_timeout from the private parameters of this node.
  explicit FakeServo(const std::string& name);

  const Watched<Iteration>& iterations() const { return iterations_; }
  bool hearsAScale() const { return scale_subscriber_.getNumPublishers() > 0; }

 private:
  void iterate();

  ros::NodeHandle node_;
  const double timeout_;
  std::mutex mutex_;
  geometry_msgs::TwistStamped command_;
  ros::Time newest_stamp_;
  double scale_ = 1.0;
  int status_ = 0;
  Watched<Iteration> iterations_;
  ros::Publisher status_publisher_;
  ros::Publisher joint_publisher_;
  ros::Subscriber command_subscriber_;
  ros::Subscriber scale_subscriber_;
  ros::ServiceServer reset_;
  std::optional<Repeater> repeater_;  // ends before what it publishes
};

/// twist_mux of ROS Noetic with one input, nav_vel of priority 10: passes a twist on unless a lock of higher priority is
/// true or its time-out is over, and sends nothing of its own.
class FakeTwistMux {
 public:
  /// Reads the locks from the parameter `locks` of this node.
  explicit FakeTwistMux(const std::string& name);

  /// Whether each twist of the input met a lock.
  const Watched<bool>& locked() const { return locked_; }

 private:
  static constexpr int kPriority = 10;

  struct Lock {
    double timeout;
    int priority;
    ros::Subscriber subscriber;
    ros::Time stamp;
    bool on = false;
  };

  void addLock(XmlRpc::XmlRpcValue entry);
  void pass(const geometry_msgs::Twist& twist);

  ros::NodeHandle node_;
  std::mutex mutex_;
  std::list<Lock> locks_;
  Watched<bool> locked_;
  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
};

/// The twist_controller of ros_controllers_cartesian, as in the UR driver: it keeps the newest command for ever.
class FakeVelocityController {
 public:
  explicit FakeVelocityController(const std::string& name) : commands_(name + "/command") {}

  const Watched<geometry_msgs::Twist>& commands() const { return commands_; }

 private:
  Listener<geometry_msgs::Twist> commands_;
};

/// An arm of the dVRK with the names of CRTK: it goes where servo_cp says, and measured_cp says where it is.
class FakeArm {
 public:
  FakeArm(const std::string& name, const geometry_msgs::Pose& pose);

  const Watched<geometry_msgs::PoseStamped>& commands() const { return commands_; }

 private:
  void publish();

  ros::NodeHandle node_;
  std::mutex mutex_;
  geometry_msgs::Pose pose_;
  Watched<geometry_msgs::PoseStamped> commands_;
  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
  std::optional<Repeater> repeater_;  // ends before what it publishes
};

}  // namespace sweep_guard_ros
