#pragma once

#include <ros/service_client.h>

#include <optional>
#include <string>
#include <thread>

#include "common/guarded_by.h"

namespace sweep_guard_rviz {

/// Calls services of the guard on a thread of its own, one at a time: a guard that does not answer blocks nothing.
class ServiceCall {
 public:
  ServiceCall() = default;
  ~ServiceCall();
  ServiceCall(const ServiceCall&) = delete;
  ServiceCall& operator=(const ServiceCall&) = delete;

  /// Starts a call of a std_srvs/SetBool or std_srvs/Trigger service. Does nothing while another call runs.
  /// @param service  absolute name
  void setBool(const std::string& service, bool value);
  void trigger(const std::string& service);
  /// Starts a call of a sweep_guard/Acknowledge service. Does nothing while another call runs.
  /// @param mesh_id  workpiece that the operator was shown
  void acknowledge(const std::string& service, const std::string& mesh_id);

  /// Ends the running call if its service has been found, and forgets all outcomes.
  void drop();

  bool busy() const;
  std::optional<std::string> takeOutcome();  ///< text about a call that ended since the last query

 private:
  template <typename Service>
  void start(const std::string& name, Service service);
  template <typename Service>
  std::string call(const std::string& name, Service& service);

  mutable sweep_guard_core::Mutex mutex_;
  ros::ServiceClient client_ GUARDED_BY(mutex_);  // of the running call: its shutdown ends the call
  bool dropped_ GUARDED_BY(mutex_) = false;
  bool busy_ GUARDED_BY(mutex_) = false;
  std::optional<std::string> outcome_ GUARDED_BY(mutex_);
  std::thread thread_;
};

}  // namespace sweep_guard_rviz
