#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <sweep_guard/Warning.h>

#include <string>
#include <vector>

#include "common/guarded_by.h"
#include "monitor/warning_merger.h"
#include "ros/connection/bounded.h"
#include "ros/connection/master_watch.h"
#include "ros/connection/peer_watch.h"
#include "ros/process/log_throttle.h"
#include "ros/threads/queue_thread.h"
#include "ros/threads/timer_thread.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_ros {

/// Publishes one `~warning` for several guards, as WarningMerger merges theirs: at once when it changes, and at 20 Hz at least;
/// and the flags `~reflex_warning` and `~considered_warning`, as a guard does.
/// A ROS node or a nodelet. A guard whose topic several nodes publish on counts as silent.
class WarningMergerNode {
 public:
  /// @throws sweep_guard_core::InvalidInput if a parameter is refused
  WarningMergerNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Process process);
  ~WarningMergerNode();  ///< publishes a last UNKNOWN
  WarningMergerNode(const WarningMergerNode&) = delete;
  WarningMergerNode& operator=(const WarningMergerNode&) = delete;

  void start();  ///< begins to listen; once

 private:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  WarningMergerNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Process process,
                    ParameterReader read);

  BoundedSubscriber subscribe(const ros::NodeHandle& node, size_t guard, const std::string& topic);
  void hear(size_t guard, const sweep_guard::Warning& message);
  void publish();
  void publishFlags();
  sweep_guard::Warning merged(const sweep_guard_core::Instant& now) const REQUIRES(mutex_);
  void report(Status& status, size_t guard);
  bool aGuardIsSilent() const;

  // Members use only earlier members.
  MasterWatch master_watch_;  // before what registers at the master
  Supervisor supervisor_;     // before all threads
  ParameterReader::Settings settings_;
  LogThrottle log_;
  mutable sweep_guard_core::Mutex mutex_;  // of the next five
  sweep_guard_core::WarningMerger merger_ GUARDED_BY(mutex_);
  std::vector<sweep_guard::Warning> newest_ GUARDED_BY(mutex_);     // by guard
  sweep_guard::Warning published_ GUARDED_BY(mutex_);               // newest
  sweep_guard_core::SteadyTime published_at_ GUARDED_BY(mutex_){};  // its time
  bool ending_ GUARDED_BY(mutex_) = false;
  ros::Publisher publisher_;
  ros::Publisher reflex_;
  ros::Publisher considered_;
  diagnostic_updater::Updater updater_;
  QueueThread thread_;
  std::vector<BoundedSubscriber> subscribers_;  // by guard
  PeerWatch peer_watch_;
  TimerThread ticks_;
  TimerThread reports_;
};

}  // namespace sweep_guard_ros
