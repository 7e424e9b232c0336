#include "ros/camera/cameras.h"

namespace sweep_guard_ros {

Cameras::Cameras(const ros::NodeHandle& node, const CameraInputDependencies& dependencies) {
  for (const CameraParameters& camera : dependencies.parameters.initial().cameras)
    all_.push_back(std::make_unique<CameraInput>(thread_.on(node), camera, dependencies));
}

void Cameras::start(Supervisor& supervisor) {
  if (all_.empty()) return;
  for (const auto& camera : all_) camera->start(supervisor);
  thread_.start(supervisor, {"cameras", sweep_guard_core::Stage::kReceive});
}

}  // namespace sweep_guard_ros
