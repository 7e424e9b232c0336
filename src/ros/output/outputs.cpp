#include "ros/output/outputs.h"

#include <chrono>
#include <string>

namespace sweep_guard_ros {
namespace {

const sweep_guard_core::Duration kViewPeriod = sweep_guard_core::fromSeconds(1.0 / 60.0);
constexpr auto kTestPeriod = std::chrono::milliseconds(20);
constexpr auto kEarlyPeriod = std::chrono::milliseconds(100);
constexpr auto kDiagnosticsPeriod = std::chrono::seconds(1);
constexpr auto kTouchesPeriod = std::chrono::seconds(1);

sweep_guard_core::Duration markerPeriod(const Parameters& parameters) {
  return sweep_guard_core::fromSeconds(1.0 / parameters.marker_rate);
}

ServiceDependencies dependenciesIn(GuardState& state) {
  return {state.parameters, state.frames, state.workpieces, state.monitor};
}

}  // namespace

Outputs::Outputs(const ros::NodeHandle& node, const ros::NodeHandle& private_node, GuardState& state,
                 GuardRunner& guard, Inputs& inputs, MasterThread& master)
    : state_(state),
      guard_(guard),
      marker_timer_(
          reports_.every(markerPeriod(state.parameters.initial()), [&state] { state.scene.publishMarkers(); })),
      path_tests_(dependenciesIn(state), &state.frame_motions),
      check_sweep_(private_node, "check_sweep", service_threads_, path_tests_, checkSweep),
      check_trajectory_(private_node, "check_trajectory", service_threads_, path_tests_, checkTrajectory),
      trajectory_watch_(node, private_node, service_threads_, path_tests_,
                        {[&guard] { return guard.thread().newestPose(); },
                         [&guard](const auto& trajectory) { guard.thread().setTrajectory(trajectory); }}),
      predict_(private_node, service_threads_, state.parameters, state.workpieces,
               [&guard](sweep_guard_core::Duration horizon) { return guard.thread().predictMotion(horizon); }),
      controls_(private_node, state.parameters, state.monitor, state.workpieces, service_threads_,
                {[&guard] { guard.thread().reset(); },
                 [&guard](const std::string& id) { return guard.thread().acknowledge(id); },
                 [&state] { state.touches.reset(); }}),
      intend_(private_node, service_threads_, dependenciesIn(state), state.intentions),
      attach_(
          private_node, service_threads_, dependenciesIn(state), [&guard] { return guard.thread().newestPose(); },
          [&guard](const auto& before, const auto& next, const auto& also) {
            guard.thread().exchangeTool(before, next, also);
          }),
      reconfigure_server_(private_node, service_threads_, master, state.parameters,
                          [this](const auto& wanted) { apply(wanted); }),
      diagnostics_(node, private_node, state, inputs, reconfigure_server_, trajectory_watch_) {
  reports_.every(kTestPeriod, [this] { trajectory_watch_.testIfDue(); });
  reports_.every(kViewPeriod, [&state] { state.scene.publishView(); });
  reports_.every(kViewPeriod, [this] { intend_.publishIfChanged(); });
  reports_.every(kEarlyPeriod, [&inputs] { inputs.takeEarly(); });
  reports_.every(kTouchesPeriod, [&state] { state.touches.publishIfChanged(); });
  reports_.every(kDiagnosticsPeriod, [this] { diagnostics_.publish(); });
}

void Outputs::start() {
  path_tests_.start(state_.supervisor);
  service_threads_.start(state_.supervisor);
  reports_.start(state_.supervisor, {"reports", sweep_guard_core::Stage::kPublish});
}

void Outputs::stopServices() {
  path_tests_.stop();
  predict_.stop();
  service_threads_.stop();
}

void Outputs::apply(const std::shared_ptr<const Parameters>& wanted) {
  guard_.apply(wanted);
  marker_timer_.setPeriod(markerPeriod(*wanted));
  state_.warnings.publishIfChanged();
}

}  // namespace sweep_guard_ros
