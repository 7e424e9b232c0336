#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/TwistStamped.h>
#include <ros/node_handle.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "ros/connection/bounded.h"
#include "ros/motion/command_frames.h"
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
                               geometry_msgs::PoseStampedConstPtr>;
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

  /// Reads the newest command. All but its timestamps and `period` is filled in.
  /// @throws FrameError, sweep_guard_core::InvalidInput if it cannot be carried out
  virtual sweep_guard_core::MotionCommand read(const sweep_guard_core::MotionInputs& known, const Cycle& cycle) = 0;
  /// Publishes what was let through of what read() returned; the message itself if that is everything.
  /// @param again  since the command came, it was sent before: it is stamped now
  virtual void send(const sweep_guard_core::GuardedMotion& motion, bool again) = 0;
  /// Publishes that the tool shall stand still. A pose is published only if one was before.
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
  CommandPort(const Frames& frames, const MotionParameters& parameters, const ros::Publisher& publisher,
              BoundedSubscriber subscriber)
      : frames_(frames), parameters_(parameters), publisher_(publisher), subscriber_(std::move(subscriber)) {}

  Eigen::Isometry3d poseOf(const std::string& frame, const std::optional<ToolPose>& tool) const {
    return commandFramePose(frames_, parameters_, frame, tool);
  }
  Eigen::Isometry3d point() const { return newestPose(frames_, parameters_.tool.frame, parameters_.command_point); }
  template <typename Msg>
  const Msg& newest() const {
    return *std::get<boost::shared_ptr<const Msg>>(newest_);
  }
  // Shared, so that no nodelet reads a copy.
  template <typename Msg>
  void publishNewest() {
    publisher_.publish(std::get<boost::shared_ptr<const Msg>>(newest_));
  }
  template <typename Msg>
  void publish(const boost::shared_ptr<Msg>& msg) {
    publisher_.publish(msg);
  }

 private:
  const Frames& frames_;
  const MotionParameters& parameters_;
  Message newest_;
  ros::Publisher publisher_;
  BoundedSubscriber subscriber_;
};

/// Returns the port of command_type.
/// @param node  its queue calls back
std::unique_ptr<CommandPort> makeCommandPort(const ros::NodeHandle& node, const MotionParameters& parameters,
                                             const Frames& frames, CommandPort::Receive receive,
                                             CommandPort::Refuse refuse);

}  // namespace sweep_guard_ros
