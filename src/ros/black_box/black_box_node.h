#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/service_server.h>
#include <ros/subscriber.h>
#include <std_srvs/Trigger.h>

#include <vector>

#include "ros/black_box/black_box_parameters.h"
#include "ros/black_box/recorded_topics.h"
#include "ros/black_box/recorder.h"
#include "ros/connection/master_watch.h"
#include "ros/service/limited_calls.h"
#include "ros/threads/queue_thread.h"
#include "ros/threads/supervisor.h"
#include "ros/threads/timer_thread.h"

namespace sweep_guard_ros {

/// Keeps the last seconds of what a guard hears and publishes, and writes them into a bag after a contact, as a ROS node or a
/// nodelet. doc/black_box.md describes it.
class BlackBoxNode {
 public:
  /// @throws sweep_guard_core::InvalidInput if a parameter is refused
  BlackBoxNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Process process);
  ~BlackBoxNode();
  BlackBoxNode(const BlackBoxNode&) = delete;
  BlackBoxNode& operator=(const BlackBoxNode&) = delete;

  void start();  ///< begins to listen; once

 private:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;
  using SaveEvent = ros::ServiceEvent<std_srvs::Trigger::Request, std_srvs::Trigger::Response>;

  std::vector<ros::Subscriber> subscribe(const ros::NodeHandle& node);
  bool onSave(SaveEvent& event);
  const ros::Subscriber& warnings() const;
  void memory(Status& status) const;      // what is kept, on /diagnostics
  void recordings(Status& status) const;  // what was written, and why nothing can be

  // Members use only earlier members.
  const BlackBoxParameters parameters_;
  MasterWatch master_watch_;  // before what registers at the master
  Supervisor supervisor_;     // before all threads
  Recorder recorder_;
  const std::vector<RecordedTopic> topics_;
  QueueThread thread_;
  std::vector<ros::Subscriber> subscribers_;  // in the order of the topics
  QueueThread saves_;
  QueueThread refusals_;
  LimitedCalls calls_{saves_, refusals_};
  ros::ServiceServer save_;
  diagnostic_updater::Updater updater_;
  TimerThread ticks_;
  TimerThread reports_;
};

}  // namespace sweep_guard_ros
