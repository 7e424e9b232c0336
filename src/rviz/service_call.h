#pragma once

#include <ros/service_client.h>

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace sweep_guard_rviz {

/// Calls services of the guard on a thread of its own, one at a time: a guard that does not answer stops nobody.
class ServiceCall {
 public:
  ServiceCall() = default;
  ~ServiceCall();
  ServiceCall(const ServiceCall&) = delete;
  ServiceCall& operator=(const ServiceCall&) = delete;

  /// std_srvs/SetBool and std_srvs/Trigger. Nothing happens while a call is under way.
  /// @param service  its name, absolute
  void setBool(const std::string& service, bool value);
  void trigger(const std::string& service);

  /// Ends the call under way, if its service has been found; its outcome, and one not taken yet, are forgotten.
  void drop();

  bool busy() const;
  std::optional<std::string> takeOutcome();  ///< of the call that has ended since, in words

 private:
  template <typename Service>
  void start(const std::string& name, Service service);
  template <typename Service>
  std::string call(const std::string& name, Service& service);

  mutable std::mutex mutex_;
  ros::ServiceClient client_;  // of the call under way: shutting it down ends that
  bool dropped_ = false;
  bool busy_ = false;
  std::optional<std::string> outcome_;
  std::thread thread_;
};

}  // namespace sweep_guard_rviz
