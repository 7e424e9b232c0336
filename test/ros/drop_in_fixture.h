#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/TwistStamped.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <signal.h>
#include <tf2_msgs/TFMessage.h>

#include <chrono>
#include <cmath>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fake_guard.h"
#include "guard_process.h"
#include "listener.h"
#include "repeater.h"

namespace sweep_guard_ros {

/// Publishes the newest of its messages, by default at 100 Hz, stamped with the time of each.
template <typename Msg>
class Stream {
 public:
  explicit Stream(const std::string& topic, std::chrono::milliseconds period = std::chrono::milliseconds(10))
      : publisher_(node_.advertise<Msg>(topic, 10)), repeater_(period, [this] { publish(); }) {}

  /// @param stamped  false: with the stamp that it has
  void send(const Msg& message, bool stamped = true) {
    const std::lock_guard lock(mutex_);
    message_ = message;
    stamped_ = stamped;
  }

 private:
  static void stamp(Msg& message) {
    if constexpr (ros::message_traits::HasHeader<Msg>::value) message.header.stamp = ros::Time::now();
  }

  void publish() {
    const std::lock_guard lock(mutex_);
    if (!message_) return;
    if (stamped_) stamp(*message_);
    publisher_.publish(*message_);
  }

  ros::NodeHandle node_;
  std::mutex mutex_;
  std::optional<Msg> message_;
  bool stamped_ = true;
  ros::Publisher publisher_;
  Repeater repeater_;  // ends before what it publishes
};

inline geometry_msgs::Twist velocity(double x, double z) {
  geometry_msgs::Twist twist;
  twist.linear.x = x;
  twist.linear.z = z;
  twist.angular.y = 0.01 * x;
  return twist;
}

inline bool isZero(const geometry_msgs::Twist& twist) { return twist == geometry_msgs::Twist(); }

const geometry_msgs::Twist kDown = velocity(0.02, -0.5);
const geometry_msgs::Twist kUp = velocity(0.02, 0.3);
constexpr double kNear = 0.02;  ///< gap [m]

/// Returns whether the part that closes on the plane is limited to what can stop within the gap, and the rest is kept.
inline bool isLimited(const geometry_msgs::Twist& twist) {
  const double deceleration = ros::param::param("/motion_guard/deceleration", 1.0);
  return twist.linear.z < 0.0 && twist.linear.z > -std::sqrt(2.0 * deceleration * kNear) &&
         std::abs(twist.linear.x - kDown.linear.x) < 1e-3;
}

/// A running motion guard between an operator and a stand-in, with a fake guard beside it, in the namespace of the test.
class DropInTest : public testing::Test {
 protected:
  DropInTest() : tf_static_(node_.advertise<tf2_msgs::TFMessage>("/tf_static", 1, /*latch=*/true)) { spinner_.start(); }
  void TearDown() override { spinner_.stop(); }  // a timer of roscpp may call once more while it is destroyed

  // Each with its parent, in the same place.
  void publishFrames(const std::vector<std::pair<std::string, std::string>>& frames) {
    tf2_msgs::TFMessage message;
    for (const auto& [parent, child] : frames) {
      geometry_msgs::TransformStamped& transform = message.transforms.emplace_back();
      transform.header.frame_id = parent;
      transform.header.stamp = ros::Time::now();
      transform.child_frame_id = child;
      transform.transform.rotation.w = 1.0;
    }
    tf_static_.publish(message);
  }

  static geometry_msgs::PoseStamped poseAtOrigin() {
    geometry_msgs::PoseStamped pose;
    pose.header.frame_id = "world";
    pose.pose.orientation.w = 1.0;
    return pose;
  }

  // Ends the motion guard as a crash would, and returns when it happened.
  static std::chrono::steady_clock::time_point killMotionGuard() {
    const pid_t pid = pidOf(ros::names::resolve("motion_guard"));
    EXPECT_GT(pid, 0);
    kill(pid, SIGKILL);
    return std::chrono::steady_clock::now();
  }

  ros::NodeHandle node_;
  ros::Publisher tf_static_;
  ros::AsyncSpinner spinner_{2};
  FakeGuard guard_{"sweep_guard"};
};

}  // namespace sweep_guard_ros
