#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/publisher.h>
#include <ros/service_server.h>

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "ros/parameters/parameters.h"
#include "sweep_guard/ros/queue_thread.h"

namespace sweep_guard_ros {

/// Parameters that change while the guard runs, in the protocol of dynamic_reconfigure: `~set_parameters`,
/// `~parameter_descriptions`, `~parameter_updates`. Names, ranges and checks are those of loadParameters(): there is no
/// other list of them. A request comes into force as a whole or, with a message, not at all.
class ReconfigureServer {
 public:
  /// Brings parameters into force that differ from those before; returns when that is done, or throws and leaves
  /// everything as it was.
  using Adopt = std::function<void(const std::shared_ptr<const Parameters>& next)>;

  struct History {
    std::string last_change;   ///< what and who; empty: none yet
    std::string last_refusal;  ///< what, who and why; empty: none yet
  };

  ReconfigureServer(const ros::NodeHandle& private_node, const LiveParameters& parameters, Adopt adopt);

  void start() { thread_.start(); }

  History history() const;

 private:
  using Event =
      ros::ServiceEvent<dynamic_reconfigure::Reconfigure::Request, dynamic_reconfigure::Reconfigure::Response>;

  bool onSet(Event& event);
  void change(const dynamic_reconfigure::Config& request, const std::string& caller);
  void publishValues();

  ros::NodeHandle private_node_;
  const LiveParameters& parameters_;
  const Adopt adopt_;
  mutable std::mutex mutex_;
  History history_;
  QueueThread thread_;  // outlives what calls back on it
  ros::Publisher descriptions_;
  ros::Publisher values_;
  ros::ServiceServer server_;
};

}  // namespace sweep_guard_ros
