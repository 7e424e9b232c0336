#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <cstdint>
#include <string>

#include "monitor/input_record.h"
#include "ros/connection/bounded.h"
#include "ros/motion/output_watch.h"
#include "ros/motion/tool_pose_input.h"

namespace sweep_guard_ros {

using DiagnosticsLine = diagnostic_updater::DiagnosticStatusWrapper;

void addRecord(const std::string& name, const sweep_guard_core::InputRecord::Summary& record, DiagnosticsLine& line);

/// Returns whether nothing has come for a second.
bool silent(const sweep_guard_core::InputRecord::Summary& record);

/// Adds a topic of a guard to a line.
/// @param expected  whether it is an error that nothing has been received
void reportTopic(const BoundedSubscriber& subscriber, const sweep_guard_core::InputRecord::Summary& record,
                 bool expected, DiagnosticsLine& line);

/// Fills the line of the poses of a tool.
/// @param name  of the poses, for people
void reportPose(const ToolPoseInput& pose, const std::string& name, DiagnosticsLine& line);

/// Fills the line of an output that only one node may publish: who subscribes, and who else publishes.
/// @param node     that publishes it
/// @param without  what it means that nobody subscribes
void reportOutput(const OutputWatch& watch, std::uint32_t subscribers, const std::string& node,
                  const std::string& without, DiagnosticsLine& line);

}  // namespace sweep_guard_ros
