#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include "ros/motion/command_cycle.h"
#include "ros/motion/guard_input.h"
#include "ros/motion/output_watch.h"
#include "ros/motion/status_publisher.h"
#include "ros/motion/tool_pose_input.h"

namespace sweep_guard_ros {

struct MotionDiagnosticsSources {
  const CommandCycle& cycle;
  const GuardInput& guard;
  const ToolPoseInput& tool_pose;
  const StatusPublisher& status;
  const OutputWatch& output;
};

/// Publishes on /diagnostics what is let through and how often each cause began, the commands and their period, where they
/// go and who else publishes there, and the ages of the messages of the guard and of the tool pose.
class MotionDiagnostics {
 public:
  MotionDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                    const MotionDiagnosticsSources& sources);

  void publish() { updater_.force_update(); }  ///< to be called once a second

 private:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  void motion(Status& status) const;
  void command(Status& status) const;
  void output(Status& status) const;

  const MotionDiagnosticsSources sources_;
  diagnostic_updater::Updater updater_;
};

}  // namespace sweep_guard_ros
