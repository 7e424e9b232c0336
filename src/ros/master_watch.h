#pragma once

#include <xmlrpcpp/XmlRpc.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "ros/parameters/parameters.h"
#include "ros/threads/supervisor.h"
#include "ros/xml_rpc_call.h"

namespace sweep_guard_ros {

/// Notices that the ROS master was started anew, which then knows neither this node nor its parameters, and registers
/// topics and services of the process and sets the parameters of the guard there again. Connections that exist are kept:
/// poses and meshes arrive as before, also from nodes that the new master does not know. Asks the master once a second,
/// in a thread of its own.
class MasterWatch {
 public:
  MasterWatch(const ros::NodeHandle& private_node, const LiveParameters& parameters);
  ~MasterWatch() { stop(); }
  MasterWatch(const MasterWatch&) = delete;
  MasterWatch& operator=(const MasterWatch&) = delete;

  void stop();                         ///< waits for the running call
  void start(Supervisor& supervisor);  ///< after topics and services were advertised

  bool answers() const { return answers_; }  ///< false: the master did not answer when it was asked last

 private:
  void run();
  void checkOrLog();
  void check();
  std::optional<std::string> identity() const;
  bool registerAnew();
  bool setParameters();
  bool registerServices();
  bool registerTopics();
  bool subscribe(const XmlRpc::XmlRpcValue& topic, const XmlRpc::XmlRpcValue& connections);
  bool tell(const std::string& function, const std::vector<XmlRpc::XmlRpcValue>& arguments);

  const std::string namespace_;
  const LiveParameters& parameters_;
  std::atomic<bool> stopping_ = false;
  std::atomic<bool> answers_ = true;
  const XmlRpcCall call_;
  std::optional<std::string> master_;  // identity of the one that knows this node
  std::mutex mutex_;
  std::condition_variable changed_;
  ThreadTop* top_ = nullptr;  // from start() on
  std::thread thread_;
};

}  // namespace sweep_guard_ros
