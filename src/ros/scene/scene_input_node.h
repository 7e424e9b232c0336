#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <std_srvs/Trigger.h>

#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "common/guarded_by.h"
#include "ros/connection/master_watch.h"
#include "ros/process/log_throttle.h"
#include "ros/scene/attachments.h"
#include "ros/scene/environment_source.h"
#include "ros/scene/scene_file.h"
#include "ros/scene/workpiece_publisher.h"
#include "ros/threads/queue_thread.h"
#include "ros/threads/timer_thread.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_ros {

/// Gives guards the surroundings of a tool: publishes the workpieces of a scene, and those that the topics of other programs
/// describe, on `mesh` and `mesh_vertices`. Says 10 times a second that they are as they were, those of a topic while it
/// has a publisher. A ROS node or a nodelet. doc/connect.md lists types and parameters.
class SceneInputNode {
 public:
  /// @throws sweep_guard_core::InvalidInput if a parameter or the scene is refused
  SceneInputNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Process process);
  ~SceneInputNode();
  SceneInputNode(const SceneInputNode&) = delete;
  SceneInputNode& operator=(const SceneInputNode&) = delete;

  void start();  ///< begins to publish; once

 private:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  SceneInputNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Process process,
                 ParameterReader read);

  bool load(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  void replaceObjects(std::vector<sweep_guard_core::SceneObject> objects);
  void apply(const std::string& source, sweep_guard_core::SceneUpdate update);
  void publish(const std::string& id) REQUIRES(mutex_);
  void refuseTopic(const std::string& topic, const std::string& why);
  void reportAttachment(const std::string& id, const std::string& why);
  void confirm();
  void report(Status& status) const;
  void report(const EnvironmentSource& source, Status& status) const;

  // Members use only earlier members.
  MasterWatch master_watch_;  // before what registers at the master
  Supervisor supervisor_;     // before all threads
  const std::string scene_;   // file, or YAML
  ParameterReader::Settings settings_;
  LogThrottle log_;
  MasterThread confirmations_;  // of its own: a master that does not answer must not delay them
  QueueThread calls_;           // before what uses its queue
  QueueThread receiving_;       // the same
  WorkpiecePublisher workpieces_;
  Attachments attachments_;
  mutable sweep_guard_core::Mutex mutex_;
  /// What sources say of a workpiece, by their names.
  using BySource = std::map<std::string, std::shared_ptr<const sweep_guard_core::SceneChange>>;
  std::map<std::string, BySource> workpieces_by_id_ GUARDED_BY(mutex_);
  const std::string topics_id_;  // of a refused workpiece that stands for all refused topics
  std::map<std::string, std::string> refused_topics_ GUARDED_BY(mutex_);  // and why
  std::vector<EnvironmentTopic> topics_;                                  // of the scene
  std::deque<EnvironmentSource> sources_;
  ros::ServiceServer load_service_;
  diagnostic_updater::Updater updater_;
  TimerThread reports_;
};

}  // namespace sweep_guard_ros
