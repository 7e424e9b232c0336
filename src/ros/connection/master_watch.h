#pragma once

#include <xmlrpcpp/XmlRpc.h>

#include <functional>
#include <optional>
#include <string>

#include "ros/connection/publisher_links.h"
#include "ros/threads/master_thread.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_ros {

/// Notices that the ROS master was started anew, which then knows neither this node nor its parameters. Registers the topics
/// and the services of the process there again, and sets the parameters of this node. Services that nodelets of other
/// packages advertise are left out: roscpp has no list of them. Connections that exist are kept: poses and meshes arrive as
/// before, also from nodes that the new master does not know. A publisher that the master knows and that is not connected is
/// connected: roscpp gives up for good where a stream of bytes makes no sense. Asks the master once a second, in a thread
/// that others may use.
class MasterWatch {
 public:
  /// @param settings  returns the private parameters as they are now. Any thread
  MasterWatch(const ros::NodeHandle& private_node, std::function<ParameterReader::Settings()> settings);

  ~MasterWatch() { stop(); }
  MasterWatch(const MasterWatch&) = delete;
  MasterWatch& operator=(const MasterWatch&) = delete;

  MasterThread& thread() { return thread_; }  ///< for what else asks the master

  /// After topics and services were advertised; the supervisor must outlive the thread.
  void start(Supervisor& supervisor) { thread_.start(supervisor); }
  void stop() { thread_.stop(); }  ///< ends the running call

 private:
  void checkOrLog();
  void check();
  std::optional<std::string> identity() const;
  bool registerAnew();
  void connectMissing();
  std::optional<PublishersOfTopics> missingPublishers() const;
  bool addPublishersAtMaster(PublishersOfTopics& topics) const;
  bool lookUp(const std::string& node, std::optional<std::string>& address) const;
  bool setParameters();
  bool registerServices();
  bool registerTopics();
  bool subscribe(const XmlRpc::XmlRpcValue& topic);
  std::optional<Publishers> registerSubscriber(const XmlRpc::XmlRpcValue& topic);
  bool request(const std::string& function, const std::vector<XmlRpc::XmlRpcValue>& arguments);

  const std::string namespace_;
  const std::function<ParameterReader::Settings()> settings_;
  const std::string service_address_;  // at the start: roscpp's server is gone while the process shuts down
  bool answers_ = true;
  int checks_ = 0;
  PublishersOfTopics missing_;  // at the last look
  MasterThread thread_;
  const XmlRpcCall& call_;
  const XmlRpcCall brief_call_;        // of a master that did not answer: others use the thread
  std::optional<std::string> master_;  // identity of the one that knows this node
};

}  // namespace sweep_guard_ros
