#pragma once

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sweep_guard/MotionStatus.h>
#include <sweep_guard/Proximity.h>
#include <sweep_guard/ToolBalls.h>
#include <sweep_guard/Warning.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>

#include "ros/repeater.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {

/// Keeps the messages of a topic until a test takes them.
template <typename Msg>
class Inbox {
 public:
  Inbox(ros::NodeHandle& node, const std::string& topic)
      : subscriber_(node.subscribe<Msg>(topic, 1000, [this](const boost::shared_ptr<const Msg>& msg) {
          const std::lock_guard lock(mutex_);
          messages_.push_back(*msg);
          changed_.notify_all();
        })) {}

  void clear() {
    const std::lock_guard lock(mutex_);
    messages_.clear();
  }

  /// Returns the next message that fits, and drops those before it.
  Msg await(const std::function<bool(const Msg&)>& fits, const std::string& what) {
    std::unique_lock lock(mutex_);
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (true) {
      while (!messages_.empty()) {
        Msg next = messages_.front();
        messages_.pop_front();
        if (fits(next)) return next;
      }
      if (changed_.wait_until(lock, deadline) == std::cv_status::timeout) break;
    }
    ADD_FAILURE() << "no message: " << what;
    return {};
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Msg> messages_;
  ros::Subscriber subscriber_;  // after what its callback uses
};

/// Publishes every 10 ms what a guard would, of a needle before a wall across x, its pose, as a message and in tf by way of
/// a joint, and the commands of a test. The needle reaches from the origin of the tool frame to 0.1 m along its x axis,
/// where the frame `tip` is. The frame `turned` is the world's, turned by a quarter about z.
class MotionWorld {
 public:
  struct State {
    Eigen::Isometry3d X_WT = Eigen::Isometry3d(Eigen::Translation3d(0.8, 0.0, 0.0));
    double wall = 0.0;  ///< its x [m]
    std::uint8_t level = sweep_guard::Warning::CLEAR;
    std::uint32_t reasons = 0;
    bool warns = true;
    bool finds_planes = true;
    bool has_pose = true;                               ///< in both ways
    ros::Duration pose_age;                             ///< of the message
    std::function<void(const ros::Time& now)> command;  ///< empty: none
  };

  MotionWorld();

  void change(const std::function<void(State&)>& change) {
    const std::lock_guard lock(mutex_);
    change(state_);
  }

 private:
  void step();

  ros::NodeHandle node_;
  std::mutex mutex_;
  State state_;
  ros::Publisher warning_;
  ros::Publisher planes_;
  ros::Publisher tool_;
  ros::Publisher pose_;
  ros::Publisher joints_;
  ros::Publisher frames_;
  const Repeater repeater_;  // ends before what it publishes
};

}  // namespace sweep_guard_ros
