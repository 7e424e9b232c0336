#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <atomic>
#include <functional>
#include <optional>
#include <string>

#include "common/guarded_by.h"
#include "ros/connection/bounded.h"
#include "ros/connection/master_watch.h"
#include "ros/motion/output_watch.h"
#include "ros/process/log_throttle.h"
#include "ros/threads/queue_thread.h"
#include "ros/threads/timer_thread.h"
#include "sweep_guard/motion/command_gaps.h"
#include "sweep_guard/motion/command_period.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_ros {

/// Passes commands from `command` on to `output` untouched, and sends zero at 50 Hz while none come: from the start on,
/// and once more at the end. A command that is not finite, or that cannot be read, is replaced by zero and does not end
/// the silence.
class ZeroOnSilence {
 public:
  /// @throws sweep_guard_core::InvalidInput at a refused parameter
  ZeroOnSilence(const ros::NodeHandle& node, const ros::NodeHandle& private_node);
  ~ZeroOnSilence();  ///< sends the last zero
  ZeroOnSilence(const ZeroOnSilence&) = delete;
  ZeroOnSilence& operator=(const ZeroOnSilence&) = delete;

  void start();

 private:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  ZeroOnSilence(const ros::NodeHandle& node, const ros::NodeHandle& private_node, ParameterReader read);

  template <typename Msg>
  void relay(const ros::NodeHandle& node);
  template <typename Msg>
  void pass(const boost::shared_ptr<const Msg>& command);
  void refuse(const std::string& reason);
  void sendZeroIfSilent();
  void report(Status& status);

  std::atomic<bool> stopping_ = false;
  ParameterReader::Settings settings_;
  MasterWatch master_watch_;  // before what registers at the master
  LogThrottle log_;
  const sweep_guard_core::Duration timeout_;
  sweep_guard_core::Mutex mutex_;  // of the next five: commands and zeros leave in the order of their decisions
  std::optional<sweep_guard_core::SteadyTime> newest_ GUARDED_BY(mutex_);  // when the newest command was received
  sweep_guard_core::CommandGaps gaps_ GUARDED_BY(mutex_);
  std::function<void()> send_zero_;
  std::uint64_t passed_ GUARDED_BY(mutex_) = 0;
  std::string last_refusal_ GUARDED_BY(mutex_);
  ros::Publisher output_;
  diagnostic_updater::Updater updater_;
  Supervisor supervisor_;
  QueueThread commands_;
  BoundedSubscriber input_;
  TimerThread zeros_;
  TimerThread reports_;
  std::optional<OutputWatch> output_watch_;
};

}  // namespace sweep_guard_ros
