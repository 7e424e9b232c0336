#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include "ros/haptics/force_cycle.h"
#include "ros/motion/output_watch.h"
#include "ros/process/log_throttle.h"
#include "ros/threads/real_time_request.h"

namespace sweep_guard_ros {

struct HapticsDiagnosticsSources {
  const ForceCycle& cycle;
  const DeviceAxes& axes;
  const RealTimeRequest& priority;
  const GuardInput& guard;
  const ToolPoseInput& tool;
  const ToolPoseInput* device;  ///< null: the pose of the tool stands for it
  const OutputWatch& output;
};

/// Publishes on /diagnostics what force is sent and why, what the delay takes of the stiffness, the energy at the device,
/// the jitter of the output and who else publishes there, and the ages of the messages that come in.
class HapticsDiagnostics {
 public:
  HapticsDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                     const HapticsDiagnosticsSources& sources);

  void publish() { updater_.force_update(); }  ///< to be called once a second

 private:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  void force(Status& status);
  void output(Status& status) const;

  const HapticsDiagnosticsSources sources_;
  LogThrottle log_;
  diagnostic_updater::Updater updater_;
};

}  // namespace sweep_guard_ros
