#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <cstdint>
#include <string>

#include "monitor/input_record.h"
#include "ros/motion/guard_input.h"
#include "ros/motion/output_watch.h"
#include "ros/motion/tool_pose_input.h"

namespace sweep_guard_ros {

using DiagnosticsLine = diagnostic_updater::DiagnosticStatusWrapper;

void addRecord(const std::string& name, const sweep_guard_core::InputRecord::Summary& record, DiagnosticsLine& line);

/// Returns whether nothing has come for a second.
bool silent(const sweep_guard_core::InputRecord::Summary& record);

/// Fills the line of the messages of a guard.
void reportGuard(const GuardInput& guard, DiagnosticsLine& line);

/// Fills the line of the poses of a tool.
/// @param name  of the poses, for people
void reportPose(const ToolPoseInput& pose, const std::string& name, DiagnosticsLine& line);

/// A topic that only one node may publish.
struct Output {
  std::string topic;
  std::uint32_t subscribers;
  std::string node;     ///< that publishes it
  std::string without;  ///< what it means that nobody subscribes
};

/// Fills the line of an output: who subscribes, and who else publishes.
void reportOutput(const OutputWatch& watch, const Output& output, DiagnosticsLine& line);

}  // namespace sweep_guard_ros
