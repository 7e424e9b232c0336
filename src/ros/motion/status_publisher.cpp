#include "ros/motion/status_publisher.h"

#include <ros/console.h>
#include <std_msgs/Int8.h>

#include <utility>

#include "ros/motion/motion_status.h"

namespace sweep_guard_ros {
namespace {

constexpr auto kLongestPause = std::chrono::milliseconds(90);
constexpr auto kLogPause = std::chrono::seconds(1);

}  // namespace

StatusPublisher::StatusPublisher(ros::NodeHandle private_node, std::string fixed_frame)
    : fixed_frame_(std::move(fixed_frame)),
      newest_(idleStatus({})),
      status_(private_node.advertise<sweep_guard::MotionStatus>("status", 10)),
      servo_status_(private_node.advertise<std_msgs::Int8>("servo_status", 10)) {
  newest_.header.frame_id = fixed_frame_;
}

void StatusPublisher::update(sweep_guard::MotionStatus status) {
  const sweep_guard_core::Lock lock(mutex_);
  const sweep_guard::MotionStatus before = std::exchange(newest_, std::move(status));
  newest_.header.frame_id = fixed_frame_;
  if (before.cause != newest_.cause || before.code != newest_.code) {
    ++counts_[newest_.cause];
    log(before);
  }
  if (differ(before, newest_)) publish();
}

void StatusPublisher::publishIfDue() {
  const sweep_guard_core::Lock lock(mutex_);
  if (std::chrono::steady_clock::now() - published_ >= kLongestPause) publish();
}

sweep_guard::MotionStatus StatusPublisher::newest() const {
  const sweep_guard_core::Lock lock(mutex_);
  return newest_;
}

std::map<std::string, std::uint64_t> StatusPublisher::counts() const {
  const sweep_guard_core::Lock lock(mutex_);
  return counts_;
}

void StatusPublisher::publish() {
  published_ = std::chrono::steady_clock::now();
  newest_.header.stamp = ros::Time::now();
  status_.publish(newest_);
  std_msgs::Int8 code;
  code.data = newest_.code;
  servo_status_.publish(code);
}

// A command that goes to and fro between two causes would fill the log.
void StatusPublisher::log(const sweep_guard::MotionStatus& before) {
  if (before.cause == newest_.cause) return;
  const sweep_guard_core::SteadyTime now = std::chrono::steady_clock::now();
  if (now - logged_ < kLogPause) return;
  logged_ = now;
  if (newest_.code == sweep_guard::MotionStatus::HALT_FOR_COLLISION ||
      newest_.code == sweep_guard::MotionStatus::INVALID) {
    ROS_WARN("%s", newest_.text.c_str());
  } else {
    ROS_INFO("%s", newest_.text.c_str());
  }
}

}  // namespace sweep_guard_ros
