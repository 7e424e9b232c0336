#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <memory>

#include "ros/connection/master_watch.h"
#include "ros/input/frames.h"
#include "ros/motion/command_cycle.h"
#include "ros/motion/guard_input.h"
#include "ros/motion/hold_publisher.h"
#include "ros/motion/input_diagnostics.h"
#include "ros/motion/joint_input.h"
#include "ros/motion/motion_parameters.h"
#include "ros/motion/output_watch.h"
#include "ros/motion/status_publisher.h"
#include "ros/motion/tool_pose_input.h"
#include "ros/threads/supervisor.h"
#include "ros/threads/timer_thread.h"

namespace sweep_guard_ros {

/// Lets the part of a commanded motion through that does not close on a surface too fast, as a ROS node or a nodelet.
/// doc/interface.md lists topics, services and parameters.
class MotionGuardNode {
 public:
  /// @throws sweep_guard_core::InvalidInput if a parameter is refused
  MotionGuardNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Process process);
  ~MotionGuardNode();
  MotionGuardNode(const MotionGuardNode&) = delete;
  MotionGuardNode& operator=(const MotionGuardNode&) = delete;

  void start();  ///< begins to pass commands on; once

 private:
  // Lines of /diagnostics: what is let through and how often each cause began; the commands and their period; where they go
  // and who else publishes there.
  void motion(DiagnosticsLine& line) const;
  void command(DiagnosticsLine& line) const;
  void output(DiagnosticsLine& line) const;

  // Members use only earlier members.
  const MotionParameters parameters_;
  MasterWatch master_watch_;  // before what registers at the master
  Supervisor supervisor_;     // before all threads
  Frames frames_;
  GuardInput guard_;
  const std::unique_ptr<ToolPoseInput> tool_pose_;  // null for commands of joints
  const std::unique_ptr<JointInput> joints_;        // null for others
  StatusPublisher status_;
  HoldPublisher hold_;
  CommandCycle cycle_;
  OutputWatch output_watch_;
  diagnostic_updater::Updater updater_;
  TimerThread ticks_;
  TimerThread reports_;
};

}  // namespace sweep_guard_ros
