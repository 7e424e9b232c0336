#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <sweep_guard/MotionStatus.h>
#include <sweep_guard/Warning.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/guarded_by.h"
#include "monitor/warning_merger.h"
#include "ros/connection/bounded.h"
#include "ros/connection/master_watch.h"
#include "ros/process/log_throttle.h"
#include "ros/sound/rumble.h"
#include "ros/sound/sound_player.h"
#include "ros/threads/queue_thread.h"
#include "ros/threads/timer_thread.h"
#include "sound/earcon.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_ros {

/// Lets an operator hear the warning of a guard or of warning_merger: earconOf() by a program that plays samples. Silence of
/// the guard sounds as UNKNOWN. Also lets the operator hear and feel that a motion guard holds the robot back: heldEarcon() behind
/// the warning, and Rumble. A motion guard that is silent holds nothing. A ROS node.
class EarconNode {
 public:
  /// @throws sweep_guard_core::InvalidInput if a parameter is refused
  EarconNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node);
  ~EarconNode();
  EarconNode(const EarconNode&) = delete;
  EarconNode& operator=(const EarconNode&) = delete;

  void start();  ///< begins to listen and to sound; once

 private:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  EarconNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node, ParameterReader read);

  void hear(const sweep_guard::Warning& message);
  void hear(const sweep_guard::MotionStatus& status);
  void refuse(const std::string& topic, const std::string& reason);
  void sound();
  void play(const sweep_guard_core::MergedWarning& warning, double held);
  void report(Status& status) const;

  // Members use only earlier members.
  MasterWatch master_watch_;  // before what registers at the master
  Supervisor supervisor_;     // before all threads
  const std::vector<std::string> command_;
  const bool clear_tick_;
  ParameterReader::Settings settings_;
  LogThrottle log_;
  mutable sweep_guard_core::Mutex mutex_;                         // of the next five
  sweep_guard_core::WarningMerger warning_ GUARDED_BY(mutex_);    // of one guard
  double held_ GUARDED_BY(mutex_) = 0.0;                          // share of the command by the newest motion status
  sweep_guard_core::SteadyTime motion_heard_ GUARDED_BY(mutex_);  // its receipt
  std::string problem_ GUARDED_BY(mutex_);                        // of the player; empty: none
  sweep_guard_core::WarningLevel sounds_ GUARDED_BY(mutex_) = sweep_guard_core::WarningLevel::kUnknown;
  // Of the thread of the sound:
  Rumble rumble_;
  sweep_guard_core::Synthesizer synthesizer_;
  std::optional<SoundPlayer> player_;
  sweep_guard_core::SteadyTime next_start_{};  // of the player, at the earliest
  sweep_guard_core::SteadyTime played_until_{};
  std::vector<std::int16_t> samples_;  // that wait for room
  diagnostic_updater::Updater updater_;
  QueueThread thread_;
  BoundedSubscriber subscriber_;
  BoundedSubscriber motion_subscriber_;
  TimerThread sound_;
  TimerThread reports_;
};

}  // namespace sweep_guard_ros
