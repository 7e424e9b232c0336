#pragma once

#include <functional>

#include "guard/command_queue.h"
#include "guard/intention_store.h"
#include "guard/recent_poses.h"
#include "guard/tool_distances.h"
#include "guard/workpiece_store.h"
#include "monitor/sweep_statistics.h"
#include "monitor/work_queue.h"
#include "ros/input/frames.h"
#include "ros/output/scene_publisher.h"
#include "ros/output/touches_publisher.h"
#include "ros/output/warning_publisher.h"
#include "ros/parameters/live_parameters.h"
#include "ros/threads/supervisor.h"
#include "sweep_guard/guard/allowed_contact.h"
#include "sweep_guard/guard/frame_motion.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// Holds what the parts of a guard share: its parameters, the scene, the poses that wait, faults, and what is shown of them. All
/// threads that use it must have ended before it is destroyed.
class GuardState {
  // What is reported to members that are built later.
  std::function<void()> on_fault_ = [] {};
  Supervisor::Failed on_failure_ = [](const char*, const ThreadTraits&) {};

 public:
  /// @param parameters  must outlive this
  GuardState(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Process process,
             LiveParameters& parameters);
  GuardState(const GuardState&) = delete;
  GuardState& operator=(const GuardState&) = delete;

  LiveParameters& parameters;
  Supervisor supervisor;
  sweep_guard_core::WorkQueue queue;
  sweep_guard_core::CommandQueue commands;
  sweep_guard_core::SweepStatistics statistics;
  sweep_guard_core::WarningMonitor monitor;
  WarningPublisher warnings;
  ScenePublisher scene;
  TouchesPublisher touches;
  Frames frames;
  sweep_guard_core::IntentionStore intentions;
  sweep_guard_core::AllowedMatches allowed;
  sweep_guard_core::WorkpieceStore workpieces;
  sweep_guard_core::FrameMotionStore frame_motions;
  sweep_guard_core::ToolDistances distances;
  sweep_guard_core::RecentPoses recent_poses;
};

}  // namespace sweep_guard_ros
