#pragma once

#include <ros/publisher.h>
#include <ros/service_server.h>
#include <sweep_guard/Intended.h>
#include <sweep_guard/SetIntent.h>

#include <memory>
#include <string>
#include <vector>

#include "common/guarded_by.h"
#include "guard/intention_store.h"
#include "ros/connection/bounded.h"
#include "ros/process/log_throttle.h"
#include "ros/service/limited_calls.h"
#include "ros/service/service_dependencies.h"
#include "ros/service/service_threads.h"

namespace sweep_guard_ros {

/// Serves `~intend` and takes `~intend_updates`: where the tool is meant to touch. Publishes `~intended`, latched. Five
/// calls are let in; any more are answered BUSY.
class IntendService {
 public:
  IntendService(const ros::NodeHandle& private_node, ServiceThreads& threads, const ServiceDependencies& dependencies,
                sweep_guard_core::IntentionStore& intentions);

  void publishIfChanged();  ///< publishes `~intended` if it has changed, by itself too. Any thread

 private:
  using Event = ros::ServiceEvent<sweep_guard::SetIntent::Request, sweep_guard::SetIntent::Response>;

  bool onCall(Event& event);
  void onUpdate(const sweep_guard::Intend& intend);
  void refuseUpdate(const std::string& reason);
  void set(const std::vector<sweep_guard::Intend>& intends);
  sweep_guard_core::IntentionRequest requestFrom(const sweep_guard::Intend& intend) const;
  Eigen::Vector3d centerOf(const sweep_guard::Intend& intend) const;
  void checkLinks(const sweep_guard::Intend& intend) const;
  void publish(const std::string& refusal, bool only_if_changed);

  const ServiceDependencies dependencies_;
  sweep_guard_core::IntentionStore& intentions_;
  sweep_guard_core::Mutex mutex_;
  std::shared_ptr<const sweep_guard_core::Intentions> published_ GUARDED_BY(mutex_);
  std::string refusal_ GUARDED_BY(mutex_);  // of the newest update
  LogThrottle log_;
  ros::Publisher publisher_;
  LimitedCalls calls_;  // before the server, which uses it
  BoundedSubscriber updates_;
  ros::ServiceServer server_;
};

}  // namespace sweep_guard_ros
