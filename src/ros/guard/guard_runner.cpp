#include "ros/guard/guard_runner.h"

#include <ros/console.h>

#include "ros/parameters/parameter_changes.h"

namespace sweep_guard_ros {
namespace {

GuardThreadDependencies dependenciesOf(GuardState& state, sweep_guard_core::QuerySampler& sampler) {
  GuardThreadDependencies dependencies{state.parameters, state.workpieces, state.monitor,       state.statistics,
                                       state.queue,      state.warnings,   state.scene,         state.touches,
                                       sampler,          state.intentions, &state.frame_motions};
  dependencies.distances = &state.distances;
  if (state.parameters.initial().command_type != CommandSource::kNone) dependencies.commands = &state.commands;
  return dependencies;
}

}  // namespace

Parameters withAvailableDetector(Parameters parameters) {
  parameters.detector = sweep_guard_core::availableDetector(parameters.detector.name, parameters.detector.options);
  if (parameters.detector.replacesSelect()) {
    ROS_WARN("detector %s instead of select: %s", describe(parameters.detector).c_str(),
             parameters.detector.missing.c_str());
  }
  return parameters;
}

GuardRunner::GuardRunner(const ros::NodeHandle& private_node, GuardState& state)
    : state_(state),
      cross_check_(state.parameters, state.monitor),
      thread_(private_node, dependenciesOf(state, cross_check_.sampler())) {}

void GuardRunner::start() {
  thread_.start(state_.supervisor);
  cross_check_.start(state_.supervisor);
}

void GuardRunner::apply(const std::shared_ptr<const Parameters>& wanted) {
  const bool other_detector = detectorsDiffer(*state_.parameters.get(), *wanted);
  thread_.apply(other_detector ? std::make_shared<const Parameters>(withAvailableDetector(*wanted)) : wanted);
}

}  // namespace sweep_guard_ros
