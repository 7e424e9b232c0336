#pragma once

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>

#include <chrono>
#include <future>
#include <stdexcept>
#include <string>
#include <thread>

#include "ros/input/frames.h"
#include "ros/parameters/live_parameters.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {

/// The clock stands still until it is set, and goes on as that of the machine when this ends.
class DrivenClock {
 public:
  explicit DrivenClock(ros::Time time) { set(time); }
  ~DrivenClock() { ros::Time::init(); }
  void set(ros::Time time) { ros::Time::setNow(time); }
};

/// Publishes the static transform of a base, and that of an arm which moves in it.
class BaseAndArm : public testing::Test {
 protected:
  // No load delays anything as long as its timeout.
  static Parameters patient() {
    Parameters parameters = loadParameters(ros::NodeHandle("~"));
    parameters.limits.pose_timeout = std::chrono::minutes(1);
    return parameters;
  }
  static tf2_msgs::TFMessage transform(const std::string& parent, const std::string& child, ros::Time stamp, double z) {
    tf2_msgs::TFMessage message;
    geometry_msgs::TransformStamped& one = message.transforms.emplace_back();
    one.header.frame_id = parent;
    one.header.stamp = stamp;
    one.child_frame_id = child;
    one.transform.translation.z = z;
    one.transform.rotation.w = 1.0;
    return message;
  }
  void placeBase(double z) { static_transforms_.publish(transform(parameters_.fixed_frame, "base", ros::Time(), z)); }
  void moveArm(ros::Time stamp) { transforms_.publish(transform("base", "arm", stamp, 0.0)); }
  template <typename Fits>
  static void await(const std::string& what, const Fits& fits) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!fits()) {
      if (std::chrono::steady_clock::now() > end) throw std::runtime_error("waited for " + what);
      std::this_thread::yield();
    }
  }
  void awaitFrame(const std::string& frame) const {
    await(frame, [&] { return frames_.newest(parameters_.fixed_frame, frame).has_value(); });
  }
  void awaitArm(ros::Time stamp) const {
    await("the arm", [&] { return frames_.newest(parameters_.fixed_frame, "arm") == fromMsg(stamp); });
  }

  ros::NodeHandle node_;
  const Parameters parameters_ = patient();
  const LiveParameters live_{parameters_};
  Supervisor supervisor_{Process::kShared};  // before all that has a thread
  std::promise<void> changed_;               // the base
  Frames frames_{node_, parameters_.max_message_size,
                 [this](const std::string&, const std::string&) { changed_.set_value(); }};
  ros::Publisher transforms_ = node_.advertise<tf2_msgs::TFMessage>("/tf", 10);
  ros::Publisher static_transforms_ = node_.advertise<tf2_msgs::TFMessage>("/tf_static", 10);
  const ros::Time now_ = ros::Time::now();
};

}  // namespace sweep_guard_ros
