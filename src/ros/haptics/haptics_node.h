#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <optional>

#include "ros/connection/master_watch.h"
#include "ros/haptics/device_axes.h"
#include "ros/haptics/force_cycle.h"
#include "ros/input/frames.h"
#include "ros/motion/guard_input.h"
#include "ros/motion/input_diagnostics.h"
#include "ros/motion/joint_input.h"
#include "ros/motion/tool_pose_input.h"
#include "ros/process/log_throttle.h"
#include "ros/threads/real_time_request.h"
#include "ros/threads/supervisor.h"
#include "ros/threads/timer_thread.h"

namespace sweep_guard_ros {

/// Sends the force of the surfaces around the tool to a haptic device, as a ROS node or a nodelet. doc/haptics.md lists
/// topics and parameters.
class HapticsNode {
 public:
  /// @throws sweep_guard_core::InvalidInput if a parameter is refused
  HapticsNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Process process);
  ~HapticsNode();  ///< sends a last zero
  HapticsNode(const HapticsNode&) = delete;
  HapticsNode& operator=(const HapticsNode&) = delete;

  void start();  ///< begins to send; once

 private:
  // Lines of /diagnostics: what force is sent and why, what the delay takes of the stiffness, and the energy at the device;
  // the jitter of the output and who else publishes there.
  void force(DiagnosticsLine& line);
  void output(DiagnosticsLine& line) const;

  void tick();  // of `forces_`; allocates nothing
  std::optional<sweep_guard_core::PlacedByJoints> placedByJoints(const sweep_guard_core::MotionInputs& known);

  struct Joints {
    Joints(const ros::NodeHandle& node, const HapticsParameters& parameters)
        : input(node, parameters.joints, parameters.force.warning_silence),
          tool(parameters.joints.tree),
          at_rest(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parameters.joints.tree->variables().size()))) {}

    JointInput input;
    sweep_guard_core::MeasuredJoints measured;  // of the newest tick, as the following
    sweep_guard_core::MovingTool tool;
    const Eigen::VectorXd at_rest;
  };

  // Members use only earlier members.
  const HapticsParameters parameters_;
  MasterWatch master_watch_;  // before what registers at the master
  Supervisor supervisor_;     // before all threads
  Frames frames_;
  GuardInput guard_;
  ToolPoseInput tool_pose_;
  std::optional<Joints> joints_;  // of a tool that they move
  std::optional<ToolPoseInput> device_pose_;
  DeviceAxes axes_;
  RealTimeRequest priority_;
  ForceCycle cycle_;
  OutputWatch output_watch_;
  LogThrottle log_;
  diagnostic_updater::Updater updater_;
  TimerThread forces_;
  TimerThread reports_;
};

}  // namespace sweep_guard_ros
