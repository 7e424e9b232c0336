#pragma once

#include <ros/node_handle.h>

#include <atomic>
#include <condition_variable>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include "ros/connection/xml_rpc_call.h"
#include "ros/threads/supervisor.h"
#include "sweep_guard/common/time.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_ros {

/// Writes private parameters to the parameter server, in a thread of its own: roscpp waits for a master that does not
/// answer. Any thread.
class ParameterWriter {
 public:
  explicit ParameterWriter(const ros::NodeHandle& private_node);
  ~ParameterWriter();  ///< drops what is not written yet
  ParameterWriter(const ParameterWriter&) = delete;
  ParameterWriter& operator=(const ParameterWriter&) = delete;

  /// Starts the thread; the supervisor must outlive it.
  void start(Supervisor& supervisor);

  /// Writes the values, newer ones in place of older ones that are not written yet.
  /// @returns false if the server has not taken all within the time: they are written once it answers
  bool write(const std::map<std::string, ParameterValue>& values, sweep_guard_core::Duration timeout);

 private:
  void run();
  void writeNext(std::unique_lock<std::mutex>& lock);
  bool writeOne(const std::string& key, const ParameterValue& value) const;

  const ros::NodeHandle node_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, ParameterValue> waiting_;
  std::atomic<bool> stopping_ = false;
  const XmlRpcCall call_;
  ThreadTop* top_ = nullptr;  // from start() on
  std::thread thread_;
};

}  // namespace sweep_guard_ros
