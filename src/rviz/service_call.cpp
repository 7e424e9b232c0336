#include "rviz/service_call.h"

#include <ros/node_handle.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <sweep_guard/Acknowledge.h>

#include <utility>

namespace sweep_guard_rviz {

ServiceCall::~ServiceCall() {
  drop();
  if (thread_.joinable()) thread_.join();
}

void ServiceCall::drop() {
  const sweep_guard_core::Lock lock(mutex_);
  dropped_ = true;
  client_.shutdown();
  outcome_.reset();
}

void ServiceCall::setBool(const std::string& service, bool value) {
  std_srvs::SetBool set;
  set.request.data = value;
  start(service, set);
}

void ServiceCall::trigger(const std::string& service) { start(service, std_srvs::Trigger()); }

void ServiceCall::acknowledge(const std::string& service, const std::string& mesh_id) {
  sweep_guard::Acknowledge acknowledge;
  acknowledge.request.mesh_id = mesh_id;
  start(service, acknowledge);
}

bool ServiceCall::busy() const {
  const sweep_guard_core::Lock lock(mutex_);
  return busy_;
}

std::optional<std::string> ServiceCall::takeOutcome() {
  const sweep_guard_core::Lock lock(mutex_);
  return std::exchange(outcome_, std::nullopt);
}

template <typename Service>
void ServiceCall::start(const std::string& name, Service service) {
  {
    const sweep_guard_core::Lock lock(mutex_);
    if (std::exchange(busy_, true)) return;
    dropped_ = false;
  }
  if (thread_.joinable()) thread_.join();
  thread_ = std::thread([this, name, service]() mutable {
    std::string outcome = call(name, service);
    const sweep_guard_core::Lock lock(mutex_);
    if (!dropped_) outcome_ = std::move(outcome);
    busy_ = false;
  });
}

template <typename Service>
std::string ServiceCall::call(const std::string& name, Service& service) {
  // Persistent: only a persistent call ends when its client is shut down.
  ros::ServiceClient client = ros::NodeHandle().serviceClient<Service>(name, /*persistent=*/true);
  {
    const sweep_guard_core::Lock lock(mutex_);
    if (dropped_) return "";
    client_ = client;
  }
  if (!client.call(service)) return "no answer from " + name;
  if (!service.response.message.empty()) return service.response.message;
  return name + (service.response.success ? ": done" : ": refused");
}

}  // namespace sweep_guard_rviz
