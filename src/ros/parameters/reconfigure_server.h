#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/publisher.h>
#include <ros/service_server.h>

#include <functional>
#include <memory>
#include <string>

#include "common/guarded_by.h"
#include "ros/parameters/live_parameters.h"
#include "ros/parameters/parameter_writer.h"
#include "ros/service/limited_calls.h"
#include "ros/service/service_threads.h"

namespace sweep_guard_ros {

/// Changes parameters while the node runs, by the protocol of dynamic_reconfigure: `~set_parameters`,
/// `~parameter_descriptions`, `~parameter_updates`. Names, ranges and checks are those of loadParameters(). A request
/// is applied as a whole, or refused as a whole with a message. If the parameter server does not take the applied
/// values, the answer is an error that says so. Five calls are let in; any more are answered BUSY.
class ReconfigureServer {
 public:
  /// Applies parameters that differ from the current ones. Returns when that is done, or throws and changes nothing.
  using Apply = std::function<void(const std::shared_ptr<const Parameters>& next)>;

  struct History {
    std::string last_change;   ///< change and caller; empty: none yet
    std::string last_refusal;  ///< reason and caller; empty: none yet
  };

  ReconfigureServer(const ros::NodeHandle& private_node, ServiceThreads& threads, MasterThread& master,
                    const LiveParameters& parameters, Apply apply);

  History history() const;

 private:
  using Event =
      ros::ServiceEvent<dynamic_reconfigure::Reconfigure::Request, dynamic_reconfigure::Reconfigure::Response>;

  bool onSet(Event& event);
  void change(const dynamic_reconfigure::Config& request, const std::string& caller);
  void publishValues();

  ros::NodeHandle private_node_;
  const LiveParameters& parameters_;
  const Apply apply_;
  mutable sweep_guard_core::Mutex mutex_;
  History history_ GUARDED_BY(mutex_);
  ParameterWriter writer_;
  ros::Publisher descriptions_;
  ros::Publisher values_;
  LimitedCalls calls_;  // before the server, which uses it
  ros::ServiceServer server_;
};

}  // namespace sweep_guard_ros
