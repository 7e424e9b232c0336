#pragma once

#include <ros/node_handle.h>

#include <map>
#include <string>

#include "common/guarded_by.h"
#include "ros/threads/master_thread.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_ros {

/// Writes private parameters to the parameter server, and gives up after a while: roscpp waits for a master that does not
/// answer. What is not written is written later, by the thread that calls the master. Any thread.
class ParameterWriter {
 public:
  /// @param thread  writes later; must be stopped first
  ParameterWriter(const ros::NodeHandle& private_node, MasterThread& thread);
  ParameterWriter(const ParameterWriter&) = delete;
  ParameterWriter& operator=(const ParameterWriter&) = delete;

  /// Writes the values, newer ones in place of older ones that are not written yet.
  /// @returns false if the server has not taken all within about half a second: they are written once it answers
  bool write(const std::map<std::string, ParameterValue>& values);

 private:
  bool writeWaiting() REQUIRES(mutex_);
  bool writeOne(const std::string& key, const ParameterValue& value) const;

  const ros::NodeHandle node_;
  const XmlRpcCall& call_;
  sweep_guard_core::Mutex mutex_;  // held while one writes: an older value must not follow a newer one
  std::map<std::string, ParameterValue> waiting_ GUARDED_BY(mutex_);
};

}  // namespace sweep_guard_ros
