#include "ros/motion/motion_parameters.h"

#include <map>

#include "ros/motion/source_parameters.h"
#include "ros/parameters/finish_reading.h"

namespace sweep_guard_ros {
namespace {

void readCommand(ParameterReader& read, MotionParameters& parameters) {
  const std::map<std::string, CommandType> types = {
      {"twist_stamped", CommandType::kTwistStamped},       {"twist", CommandType::kTwist},
      {"pose_stamped", CommandType::kPoseStamped},         {"joint_jog", CommandType::kJointJog},
      {"joint_trajectory", CommandType::kJointTrajectory}, {"joint_velocities", CommandType::kVelocityArray}};
  parameters.command_type = types.at(read.choice(
      "command_type", "twist_stamped",
      {"twist_stamped", "twist", "pose_stamped", "joint_jog", "joint_trajectory", "joint_velocities"},
      "Type of `command` and `guarded_command`: a geometry_msgs type, of the tool; or velocities of joints: "
      "control_msgs/JointJog, trajectory_msgs/JointTrajectory of one point, std_msgs/Float64MultiArray."));
  const std::string mode = read.choice("command_mode", "absolute", {"absolute", "incremental"},
                                       "pose_stamped only. absolute: the tool catches up with what was held back. "
                                       "incremental: that is lost, and ~rebase is the clutch.");
  parameters.incremental = mode == "incremental";
}

void readFrames(ParameterReader& read, MotionParameters& parameters) {
  parameters.tool = readPoseSource(read);
  parameters.command_frame = read.optionalName("command_frame",
                                               "tf frame of a command whose header names none. Empty: fixed_frame for "
                                               "twist, which has no header; a stamped command is refused.");
  parameters.command_point = read.optionalName(
      "command_point", "tf frame whose velocity or pose is commanded. It moves with the tool. Empty: tool_frame.");
  const bool needs_frame = parameters.command_type == CommandType::kTwist && parameters.command_frame.empty();
  if (needs_frame) parameters.command_frame = parameters.tool.fixed_frame;
  if (parameters.command_point.empty()) parameters.command_point = parameters.tool.frame;
}

void readJoints(ParameterReader& read, MotionParameters& parameters) {
  parameters.joint_source = readJointSource(read, parameters.tool.frame, isOfJoints(parameters.command_type));
  parameters.joints =
      read.texts("joints", "joint_velocities only: names of the joints, in the order of the velocities.");
  if (parameters.command_type != CommandType::kVelocityArray) return;
  if (parameters.joints.empty())
    throw sweep_guard_core::InvalidInput(
        "command_type is joint_velocities: name the joints, in their order, in joints");
  for (const std::string& joint : parameters.joints) {
    if (!parameters.joint_source.names->variable(joint))
      throw sweep_guard_core::InvalidInput("joints names '" + joint +
                                           "', which is no joint of the robot that is commanded");
  }
}

void readScales(ParameterReader& read, MotionParameters& parameters) {
  parameters.linear_scale = read.number("command_scale/linear", 1.0, {1e-6, 1e6, "m/s"},
                                        "Speed that 1 in a twist means. MoveIt Servo, unitless: its scale/linear.");
  parameters.angular_scale =
      read.number("command_scale/angular", 1.0, {1e-6, 1e6, "rad/s"},
                  "Turn rate that 1 in a twist means. MoveIt Servo, unitless: its scale/rotational.");
}

void readTimes(ParameterReader& read, MotionParameters& parameters) {
  sweep_guard_core::MotionGuardOptions& options = parameters.options;
  options.command_timeout = readSeconds(read, "command_timeout", options.command_timeout, {0.005, 10.0, "s"},
                                        "An older command counts as zero: the longest period of commands.");
  options.silence = readSeconds(read, "silence", options.silence, {0.02, 2.0, "s"},
                                "Zero is sent unless a warning, planes and a tool pose have come within this time.");
  parameters.tool.silence = options.silence;
  parameters.halt_messages =
      read.integer("halt_messages", 4, 0, 1000, "Zeros that are sent after the commands have stopped. 0: without end.");
  options.dead_time = readSeconds(read, "lag/dead_time", std::chrono::milliseconds(20), {0.0, 2.0, "s"},
                                  "Time until the robot begins to do what was sent.");
  options.time_constant = readSeconds(read, "lag/time_constant", std::chrono::milliseconds(30), {0.0, 2.0, "s"},
                                      "Time constant with which it then follows, filters included.");
}

void readMotion(ParameterReader& read, MotionParameters& parameters) {
  sweep_guard_core::MotionGuardOptions& options = parameters.options;
  options.deceleration =
      read.number("deceleration", options.deceleration, {0.01, 1000.0, "m/s^2"},
                  "Deceleration of the fastest tool point when the robot is stopped. It brakes along its path.");
  options.standoff = read.number("standoff", options.standoff, {0.0, 1.0, "m"},
                                 "Distance from a surface at which nothing closes on it.");
  options.escape_speed =
      read.number("escape_speed", options.escape_speed, {0.0, 10.0, "m/s"},
                  "Speed at which a command may lead away from every surface while the guard does not know. 0: none.");
  options.unseen_speed =
      read.number("unseen_speed", options.unseen_speed, {0.0, 10.0, "m/s"},
                  "Largest speed of any tool point while cameras do not see where the tool is going (NOT_SEEN).");
  parameters.leash.max_speed = read.number("max_speed", parameters.leash.max_speed, {0.001, 1000.0, "m/s"},
                                           "pose_stamped only: largest speed of the pose that is sent.");
  parameters.leash.max_turn_rate =
      read.number("max_turn_rate", parameters.leash.max_turn_rate, {0.001, 1000.0, "rad/s"},
                  "pose_stamped only: largest turn rate of the pose that is sent.");
}

}  // namespace

MotionParameters loadMotionParameters(const ros::NodeHandle& private_node) {
  ParameterReader read(private_node);
  MotionParameters parameters;
  readCommand(read, parameters);
  readFrames(read, parameters);
  readJoints(read, parameters);
  readScales(read, parameters);
  parameters.guard = readGuard(read);
  readTimes(read, parameters);
  readMotion(read, parameters);
  parameters.leash.dead_time = parameters.options.dead_time;
  parameters.leash.time_constant = parameters.options.time_constant;
  parameters.leash.deceleration = parameters.options.deceleration;
  parameters.settings = finishReading(read);
  parameters.described = read.described();
  return parameters;
}

}  // namespace sweep_guard_ros
