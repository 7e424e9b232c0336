#pragma once

#include <memory>

#include "ros/guard/cross_check_thread.h"
#include "ros/guard/guard_state.h"
#include "ros/guard/guard_thread.h"

namespace sweep_guard_ros {

/// Returns parameters with a detector that this machine can make; logs if it is another one.
Parameters withAvailableDetector(Parameters parameters);

/// Owns the thread that sweeps and predicts, and the cross-check of its detector.
class GuardRunner {
 public:
  /// @throws sweep_guard_core::InvalidInput if a parameter is refused
  /// @throws sweep_guard_core::DeviceError if the detector cannot be created
  GuardRunner(const ros::NodeHandle& private_node, GuardState& state);

  void start();
  void stop() { thread_.stop(); }  ///< ends the sweeps; the cross-check ends with this

  GuardThread& thread() { return thread_; }

  /// Sets other parameters, with a detector that this machine can make.
  /// @throws sweep_guard_core::Error as GuardThread::apply()
  void apply(const std::shared_ptr<const Parameters>& wanted);

 private:
  GuardState& state_;
  CrossCheckThread cross_check_;
  GuardThread thread_;
};

}  // namespace sweep_guard_ros
