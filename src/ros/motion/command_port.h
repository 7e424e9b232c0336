#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/TwistStamped.h>
#include <ros/node_handle.h>
#include <std_msgs/Float64MultiArray.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "ros/connection/bounded.h"
#include "ros/input/joint_jog.h"
#include "ros/motion/joint_input.h"
#include "ros/motion/motion_parameters.h"
#include "sweep_guard/motion/motion_guard.h"
#include "sweep_guard/prediction/jump.h"

namespace sweep_guard_ros {

/// Receives `command` and publishes `guarded_command`, in one message type. One thread at a time, apart from the
/// callbacks.
class CommandPort {
 public:
  static constexpr char kTopic[] = "command";

  using ToolPose = sweep_guard_core::MotionInputs::ToolPose;
  using Message = std::variant<geometry_msgs::TwistConstPtr, geometry_msgs::TwistStampedConstPtr,
                               geometry_msgs::PoseStampedConstPtr, JointJog::ConstPtr,
                               trajectory_msgs::JointTrajectoryConstPtr, std_msgs::Float64MultiArrayConstPtr>;
  /// Takes a message that was received. A command without a stamp has that of its receipt.
  using Receive = std::function<void(const Message&, const sweep_guard_core::Timestamps&)>;
  using Refuse = std::function<void(const std::string&)>;  ///< takes why a message cannot be read

  virtual ~CommandPort() = default;
  CommandPort(const CommandPort&) = delete;
  CommandPort& operator=(const CommandPort&) = delete;

  void take(const Message& message) { newest_ = message; }  ///< it is the newest command from now on
  virtual bool isPose() const { return false; }
  /// Returns whether a command may be sent again before the next one. Not if it is a change from the one before.
  virtual bool repeats() const { return true; }

  /// The times of a cycle in which something is sent.
  struct Cycle {
    sweep_guard_core::Instant now;
    sweep_guard_core::Duration since_sent;  ///< a pose moves on by what is possible in this time
    sweep_guard_core::Duration period;      ///< longest until something is sent again
  };

  /// Returns how much of a command would be let through.
  virtual sweep_guard_core::PermissionDecision permission(const sweep_guard_core::MotionInputs& known,
                                                          const sweep_guard_core::Timestamps& command,
                                                          const sweep_guard_core::Instant& now) = 0;
  /// Returns what to send for the newest command, and remembers that it was sent.
  /// @throws FrameError, sweep_guard_core::InvalidInput if it cannot be carried out
  virtual sweep_guard_core::GuardedMotion limit(const sweep_guard_core::MotionInputs& known,
                                                const sweep_guard_core::Timestamps& command, const Cycle& cycle) = 0;
  /// Publishes what limit() returned; the message itself if that is everything.
  /// @param again  since the command came, it was sent before: it is stamped now
  virtual void send(const sweep_guard_core::GuardedMotion& motion, bool again) = 0;
  /// Publishes that the tool shall stand still, and remembers it. A pose is published only if one was before.
  virtual void sendZero(const sweep_guard_core::MotionInputs& known, const Cycle& cycle) = 0;
  void stop() { subscriber_.shutdown(); }  ///< no callback begins any more, and none is running
  virtual void pause() {}                  ///< nothing is sent for a while
  virtual void rebase() {}                 ///< see PoseFollower::rebase()

  /// Returns how far the pose sent last is ahead of a tool that does not follow it; empty: it follows, or no poses are sent.
  virtual std::optional<sweep_guard_core::Moved> standingLead() const { return {}; }

  std::string commandTopic() const { return subscriber_.getTopic(); }
  std::uint32_t commandPublishers() const { return subscriber_.getNumPublishers(); }
  std::string guardedTopic() const { return publisher_.getTopic(); }
  std::uint32_t guardedSubscribers() const { return publisher_.getNumSubscribers(); }

 protected:
  CommandPort(const ros::Publisher& publisher, BoundedSubscriber subscriber)
      : publisher_(publisher), subscriber_(std::move(subscriber)) {}

  template <typename Msg>
  const boost::shared_ptr<const Msg>& newestPtr() const {
    return std::get<boost::shared_ptr<const Msg>>(newest_);
  }
  template <typename Msg>
  const Msg& newest() const {
    return *newestPtr<Msg>();
  }
  // Shared, so that no nodelet reads a copy.
  template <typename Msg>
  void publishNewest() {
    publisher_.publish(newestPtr<Msg>());
  }
  template <typename Msg>
  void publish(const boost::shared_ptr<Msg>& msg) {
    publisher_.publish(msg);
  }

 private:
  Message newest_;
  ros::Publisher publisher_;
  BoundedSubscriber subscriber_;
};

/// Returns the header of a command; an empty one if its type has none.
template <typename Msg>
std_msgs::Header headerOf(const Msg& msg) {
  if constexpr (ros::message_traits::HasHeader<Msg>::value) {
    return msg.header;
  } else {
    return {};
  }
}

/// Stamps a command, if its type has a stamp.
template <typename Msg>
void stampNow(Msg& msg) {
  if constexpr (ros::message_traits::HasHeader<Msg>::value) msg.header.stamp = ros::Time::now();
}

/// Where a port listens, and whom it tells.
struct PortSetup {
  ros::NodeHandle node;  ///< whose queue calls back
  const MotionParameters& parameters;
  CommandPort::Receive receive;
  CommandPort::Refuse refuse;

  template <typename Msg>
  ros::Publisher advertise() const {
    return ros::NodeHandle(node).advertise<Msg>("guarded_command", 1);
  }
  template <typename Msg>
  BoundedSubscriber subscribe() const {
    return subscribeBounded<Msg>(
        node, {CommandPort::kTopic, kCommandsQueued, kMaxCommandMessage},
        [to = receive](const ros::MessageEvent<const Msg>& event) {
          const auto& msg = event.getConstMessage();
          to(msg, timestampsOf(headerOf(*msg)));
        },
        refuse);
  }

 private:
  static constexpr std::uint32_t kCommandsQueued = 1;  // only the newest counts
  static constexpr size_t kMaxCommandMessage = 16384;

  static sweep_guard_core::Timestamps timestampsOf(const std_msgs::Header& header);
};

/// Returns the port of command_type.
/// @param joints  of a robot whose joints are commanded; else null
std::unique_ptr<CommandPort> makeCommandPort(const PortSetup& setup, const Frames& frames, const JointInput* joints);

}  // namespace sweep_guard_ros
