#include "ros/haptics/haptics_parameters.h"

#include "ros/motion/source_parameters.h"
#include "ros/parameters/finish_reading.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::ForceOptions;

void readSources(ParameterReader& read, HapticsParameters& parameters) {
  PoseSource& tool = parameters.tool;
  tool = readPoseSource(read);
  tool.silence = parameters.force.warning_silence;
  parameters.guard = readGuard(read);
  const bool moves = read.flag(
      "tool/joint_states", false,
      "`joint_states` moves the tool's links, as the guard's. The force is that on a tool that moves as a whole.");
  parameters.joints = readJointSource(read, tool.frame, moves);
  parameters.device_frame = read.optionalName(
      "device_frame", "tf frame that does not move with the device; the force is along its axes. Empty: fixed_frame.");
  if (parameters.device_frame.empty()) parameters.device_frame = tool.fixed_frame;
  parameters.device_tells_pose = read.choice("device_source", "tool_pose", {"tool_pose", "device_pose"},
                                             "Motion of the hand. tool_pose: that of the tool, if it always follows. "
                                             "device_pose: poses of the device on `device_pose`.") == "device_pose";
}

void readContact(ParameterReader& read, ForceOptions& force) {
  sweep_guard_core::ContactLaw& law = force.law;
  law.stiffness = read.number("stiffness", law.stiffness, {0.0, 1e5, "N/m"},
                              "Force on the tool for a depth. Less where the delay does not allow it.");
  law.damping =
      read.number("damping", law.damping, {0.0, 1e3, "N s/m"}, "Force on the tool for a speed into a surface.");
  law.distance =
      read.number("distance", law.distance, {0.0, 1.0, "m"}, "Distance from a surface at which the force begins.");
  law.cue_damping =
      read.number("cue/damping", law.cue_damping, {0.0, 1e3, "N s/m"},
                  "Force on the tool for a speed towards a surface within cue/time, growing to this. 0: no cue.");
  law.cue_time = read.number("cue/time", law.cue_time, {0.01, 5.0, "s"},
                             "Time before contact, at the present speed, when the cue begins.");
}

void readDevice(ParameterReader& read, HapticsParameters& parameters) {
  ForceOptions& force = parameters.force;
  force.position_scale = read.number("position_scale", force.position_scale, {1e-3, 1e3},
                                     "Displacement of the tool per displacement of the device.");
  force.force_scale =
      read.number("force_scale", force.force_scale, {1e-3, 1e3},
                  "Force at the device per force on the tool; for torques, force_scale / position_scale.");
  force.max_force = read.number("max_force", force.max_force, {1e-3, 100.0, "N"}, "Largest force at the device.");
  force.max_force_rate = read.number("max_force_rate", force.max_force_rate, {1.0, 1e6, "N/s"},
                                     "How fast the force at the device changes, but to zero.");
  force.max_torque =
      read.number("max_torque", force.max_torque, {0.0, 10.0, "N m"}, "Largest torque at the device. 0: no torque.");
  force.max_torque_rate = read.number("max_torque_rate", force.max_torque_rate, {1e-2, 1e5, "N m/s"},
                                      "How fast the torque at the device changes, but to zero.");
  force.device_damping = read.number("device_damping", force.device_damping, {1e-3, 1e3, "N s/m"},
                                     "Damping of device and hand, which bounds the stiffness. Above damping + "
                                     "cue/damping, times force_scale and position_scale.");
  force.device_turn_damping = read.number("device_turn_damping", force.device_turn_damping, {1e-6, 10.0, "N m s/rad"},
                                          "The same about any axis, where there is torque.");
  parameters.hand.max_speed =
      read.number("max_speed", parameters.hand.max_speed, {1e-2, 10.0, "m/s"},
                  "Largest speed of the hand along an axis. Lower values leave more force where poses are late.");
  parameters.hand.max_acceleration =
      read.number("max_acceleration", parameters.hand.max_acceleration, {1.0, 1e4, "m/s^2"},
                  "Largest acceleration of the hand along an axis.");
  parameters.hand.max_turn_rate = read.number("max_turn_rate", parameters.hand.max_turn_rate, {1e-1, 100.0, "rad/s"},
                                              "Largest turn rate of the hand.");
  parameters.hand.max_turn_acceleration =
      read.number("max_turn_acceleration", parameters.hand.max_turn_acceleration, {10.0, 1e5, "rad/s^2"},
                  "Largest angular acceleration of the hand.");
  force.output_delay = readSeconds(read, "output_delay", force.output_delay, {0.0, 0.2, "s"},
                                   "Time until what is sent acts at the device, at most.");
}

}  // namespace

HapticsParameters loadHapticsParameters(const ros::NodeHandle& private_node) {
  ParameterReader read(private_node);
  HapticsParameters parameters;
  readSources(read, parameters);
  readContact(read, parameters.force);
  readDevice(read, parameters);
  parameters.realtime_priority = read.integer("realtime_priority", 50, 0, 99,
                                              "SCHED_FIFO priority of the sending thread; 0: none. If the system "
                                              "refuses, log and diagnostics say what to set.");
  parameters.settings = finishReading(read);
  parameters.described = read.described();
  return parameters;
}

}  // namespace sweep_guard_ros
