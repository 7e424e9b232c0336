#pragma once

#include <ros/service_server.h>
#include <sweep_guard/SaveProfile.h>

#include <functional>
#include <future>
#include <memory>
#include <string>

#include "prediction/profile.h"
#include "ros/parameters/parameters.h"
#include "ros/service/limited_calls.h"

namespace sweep_guard_ros {

/// Serves `~save_profile`. The guard's thread copies what it has learned, in microseconds between two sweeps; the file is
/// written here, in a thread of its own. A caller chooses a plain name, no path: only the file of `prediction/profile` and
/// profiles in one folder can be overwritten. A call that finds 4 others waiting is answered BUSY.
class SaveProfileService {
 public:
  /// Copies what was learned; null if the predictor learns nothing.
  using TakeProfile = std::function<std::future<std::unique_ptr<sweep_guard_core::Profile>>()>;

  SaveProfileService(const ros::NodeHandle& private_node, const LiveParameters& parameters, TakeProfile take_profile);

  void start(Supervisor& supervisor) { calls_.start(supervisor); }

 private:
  using Event = ros::ServiceEvent<sweep_guard::SaveProfile::Request, sweep_guard::SaveProfile::Response>;

  bool onCall(Event& event);
  void save(const std::string& name, sweep_guard::SaveProfile::Response& response);
  std::unique_ptr<sweep_guard_core::Profile> learned() const;

  const LiveParameters& parameters_;
  const TakeProfile take_profile_;
  LimitedCalls calls_{"save_profile"};  // before the server, which uses it
  ros::ServiceServer server_;
};

}  // namespace sweep_guard_ros
