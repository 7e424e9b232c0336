#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <map>
#include <string>

#include "common/guarded_by.h"
#include "ros/threads/timer_thread.h"

namespace sweep_guard_ros {

/// Attaches workpieces to links of the tool, and detaches them, by the guard's `~attach`, in a thread of its own. Asks again
/// until the guard has done it.
class Attachments {
 public:
  /// @param why  why a workpiece is not where its link says; empty: it is
  using Report = std::function<void(const std::string& id, const std::string& why)>;

  /// @param guard   name of its node
  /// @param report  called after each request to the guard, in the thread of the attachments
  Attachments(const ros::NodeHandle& node, const std::string& guard, Report report);

  void start(Supervisor& supervisor);
  void stop() { thread_.stop(); }
  /// Sets the link that holds a workpiece. Any thread
  /// @param link  "": none
  /// @returns whether the guard has done so already
  bool setLink(const std::string& id, const std::string& link);
  /// Attaches all anew: there is a new guard. Any thread
  void beginAnew();

 private:
  using Links = std::map<std::string, std::string>;  // by id

  void exchange();
  void attach(const std::string& id, const std::string& link);
  bool detach(const std::string& id);
  std::string ask(const std::string& id, const std::string& link);

  const Report report_;
  ros::ServiceClient attach_;
  sweep_guard_core::Mutex mutex_;
  Links wanted_ GUARDED_BY(mutex_);
  Links done_ GUARDED_BY(mutex_);
  Links doubted_ GUARDED_BY(mutex_);  // what was done by a guard that may have ended since
  TimerThread thread_;
};

}  // namespace sweep_guard_ros
