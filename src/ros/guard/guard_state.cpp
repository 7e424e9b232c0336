#include "ros/guard/guard_state.h"

#include <chrono>
#include <string>

namespace sweep_guard_ros {

GuardState::GuardState(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Process process,
                       LiveParameters& live)
    : parameters(live),
      supervisor(process, [this](const char* what, const ThreadTraits& thread) { on_failure_(what, thread); }),
      statistics(parameters.initial().guard.cycle),
      monitor(
          parameters.initial().limits, [this] { on_fault_(); }, [this] { return queue.waitingSince(); },
          [this] { return supervisor.hung(); }),
      warnings(private_node, parameters, monitor),
      scene(private_node, parameters, monitor, workpieces),
      touches(private_node),
      frames(node, parameters.initial().max_message_size,
             [this](const std::string& parent, const std::string& child) {
               monitor.placedAnew("static transform from '" + child + "' to '" + parent + "' has changed");
             }),
      allowed(parameters.initial().guard.allowed),
      workpieces([this](const auto& snapshot) {
        monitor.setWorkpieces(snapshot, std::chrono::steady_clock::now());
        intentions.follow(snapshot);
        allowed.follow(snapshot);
      }) {
  monitor.setTool(*parameters.initial().tool);
  on_fault_ = [this] { warnings.publishIfChanged(); };
  on_failure_ = [this](const char* what, const ThreadTraits& thread) {
    monitor.failed(sweep_guard_core::kDetectorFault, what, std::chrono::steady_clock::now(), thread.loses_latched);
    warnings.publishIfChanged();
    statistics.fault(what);
  };
}

}  // namespace sweep_guard_ros
