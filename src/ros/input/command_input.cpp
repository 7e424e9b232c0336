#include "ros/input/command_input.h"

#include <cmath>
#include <limits>
#include <utility>

#include "common/frame_name.h"
#include "ros/input/future_stamp.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::CommandedJoints;
using sweep_guard_core::CommandedTwist;
using sweep_guard_core::InvalidInput;
using sweep_guard_core::SentCommand;

constexpr std::uint32_t kCommandsQueued = 256;
constexpr size_t kMaxCommandSize = 65536;  // [bytes]
constexpr sweep_guard_core::Duration kSilence = std::chrono::seconds(1);

const std_msgs::Header& headerOf(const geometry_msgs::Twist& /*msg*/) {
  static const std_msgs::Header kNone;
  return kNone;
}
template <typename Msg>
const std_msgs::Header& headerOf(const Msg& msg) {
  return msg.header;
}

double checkedSpeed(double speed) {
  constexpr double kMax = 1e6;  // [m/s, rad/s]
  if (!(std::abs(speed) <= kMax)) throw InvalidInput("a velocity must be finite, within 1e6");
  return speed;
}

sweep_guard_core::Vector6d vectorOf(const geometry_msgs::Twist& twist) {
  sweep_guard_core::Vector6d v;
  v << twist.linear.x, twist.linear.y, twist.linear.z, twist.angular.x, twist.angular.y, twist.angular.z;
  for (const double speed : v) checkedSpeed(speed);
  return v;
}

}  // namespace

CommandInput::CommandInput(const ros::NodeHandle& node, const Parameters& parameters, const Frames& frames,
                           sweep_guard_core::CommandQueue& commands)
    : fixed_frame_(parameters.fixed_frame),
      tool_frame_(parameters.tool_frame),
      frames_(frames),
      commands_(commands),
      robot_(parameters.command_type == CommandSource::kJointJog ? parameters.robot : nullptr),
      names_(robot_ ? std::make_unique<JointNames>(robot_->robot.tree,
                                                   fixedPositions(robot_->robot.tree, parameters.fixed_joints),
                                                   parameters.joint_names)
                    : nullptr),
      sole_(kSilence),
      subscriber_(subscribeTo(parameters, thread_.on(node))) {}

BoundedSubscriber CommandInput::subscribeTo(const Parameters& parameters, const ros::NodeHandle& node) {
  switch (parameters.command_type) {
    case CommandSource::kPoseStamped:
      return subscribe<geometry_msgs::PoseStamped>(node, parameters.command_topic);
    case CommandSource::kTwist:
      return subscribe<geometry_msgs::Twist>(node, parameters.command_topic);
    case CommandSource::kJointJog:
      return subscribe<JointJog>(node, parameters.command_topic);
    default:
      return subscribe<geometry_msgs::TwistStamped>(node, parameters.command_topic);
  }
}

template <typename Msg>
BoundedSubscriber CommandInput::subscribe(const ros::NodeHandle& node, const std::string& topic) {
  const auto take = [this](const ros::MessageEvent<const Msg>& event) {
    try {
      const Msg& msg = *event.getConstMessage();
      const std_msgs::Header& header = headerOf(msg);
      const sweep_guard_core::Instant at = now();
      sweep_guard_core::Timestamps timestamps{fromMsg(header.stamp), at.steady};
      if (timestamps.stamp == sweep_guard_core::Time()) timestamps.stamp = at.stamp;
      if (liesInFuture(timestamps)) throw InvalidInput(kFutureStampText);
      if (!sole_.alone(event.getPublisherName(), timestamps.received)) throw InvalidInput("several nodes publish it");
      SentCommand command = read(msg, header);
      command.stamp = timestamps.stamp;
      commands_.push(std::move(command));
      record_.received(timestamps);
    } catch (const sweep_guard_core::Error& error) {
      refuse(error.what());
    }
  };
  return subscribeBounded<Msg>(node, {topic, kCommandsQueued, kMaxCommandSize}, take,
                               [this](const std::string& reason) { refuse(reason); });
}

SentCommand CommandInput::read(const geometry_msgs::PoseStamped& msg, const std_msgs::Header& header) const {
  return {{}, framePose(header.frame_id) * fromMsg(msg.pose)};
}

SentCommand CommandInput::read(const geometry_msgs::TwistStamped& msg, const std_msgs::Header& header) const {
  CommandedTwist command{vectorOf(msg.twist)};
  command.of_tool = sweep_guard_core::isSameFrame(header.frame_id, tool_frame_);
  if (command.of_tool) return {{}, command};
  const Eigen::Matrix3d R_WC = framePose(header.frame_id).linear();
  command.twist << R_WC * command.twist.head<3>(), R_WC * command.twist.tail<3>();
  return {{}, command};
}

SentCommand CommandInput::read(const geometry_msgs::Twist& msg, const std_msgs::Header& /*header*/) const {
  return {{}, CommandedTwist{vectorOf(msg)}};
}

SentCommand CommandInput::read(const JointJog& msg, const std_msgs::Header& /*header*/) const {
  if (msg.velocities.size() != msg.joint_names.size()) throw InvalidInput("it must have a velocity for each joint");
  CommandedJoints command;
  command.velocities.assign(robot_->robot.tree.variables().size(), std::numeric_limits<double>::quiet_NaN());
  for (size_t i = 0; i < msg.joint_names.size(); ++i) {
    const double velocity = checkedSpeed(msg.velocities[i]);
    if (const auto variable = names_->variable(msg.joint_names[i])) command.velocities[*variable] = velocity;
  }
  return {{}, command};
}

Eigen::Isometry3d CommandInput::framePose(const std::string& frame) const {
  if (frame.empty()) throw InvalidInput("its header names no frame");
  if (sweep_guard_core::isSameFrame(frame, tool_frame_))
    throw InvalidInput("a pose in the frame of the tool does not say where it shall be: send it in a fixed frame");
  return frames_.newestPose(fixed_frame_, frame).X;
}

void CommandInput::refuse(const std::string& reason) {
  record_.error(reason, /*refused=*/true);
  log_.error("", "message on " + subscriber_.getTopic() + " refused: " + reason);
}

}  // namespace sweep_guard_ros
