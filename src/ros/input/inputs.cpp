#include "ros/input/inputs.h"

#include <cstdint>

#include "sweep_guard/monitor/reason.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

constexpr std::uint32_t kSilentInputs =
    sweep_guard_core::kNoPose | sweep_guard_core::kPoseStale | sweep_guard_core::kTfFail | sweep_guard_core::kNoMesh |
    sweep_guard_core::kMeshStale | sweep_guard_core::kNotCovered | sweep_guard_core::kDisabled;

}  // namespace

Inputs::Inputs(const ros::NodeHandle& node, const ros::NodeHandle& private_node, GuardState& state,
               MasterThread& master)
    : state_(state),
      poses_(node, state.parameters,
             {state.frames, state.workpieces, state.monitor, state.queue, state.frame_motions, state.recent_poses}),
      meshes_(node, state.parameters.initial(), state.workpieces, state.monitor),
      other_tools_(node, state.parameters.initial(),
                   {[this](const Worker::Job& job) { meshes_.changeStore(job); }, state.workpieces, state.frame_motions,
                    state.monitor}),
      cameras_(node, {private_node, state.frames, state.parameters, state.monitor, state.recent_poses,
                      [&state](const auto& image) { return state.queue.show(image); }}),
      commands_(state.parameters.initial().command_type == CommandSource::kNone
                    ? nullptr
                    : std::make_unique<CommandInput>(node, state.parameters.initial(), state.frames, state.commands)),
      peer_watch_(master, [&state, warning = sweep_guard_core::Warning()]() mutable {
        state.monitor.warning(now(), warning);
        return (warning.reasons & kSilentInputs) != 0;
      }) {
  state.monitor.require(requiredIds(state.parameters.initial()));
}

void Inputs::start() {
  state_.frames.start(state_.supervisor);
  meshes_.start(state_.supervisor);
  other_tools_.start(state_.supervisor);
  cameras_.start(state_.supervisor);
  if (commands_) commands_->start(state_.supervisor);
  poses_.start(state_.supervisor);
}

}  // namespace sweep_guard_ros
