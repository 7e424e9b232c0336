#pragma once

#include <memory>

#include "ros/camera/cameras.h"
#include "ros/connection/peer_watch.h"
#include "ros/guard/guard_state.h"
#include "ros/input/command_input.h"
#include "ros/input/mesh_input.h"
#include "ros/input/other_tools.h"
#include "ros/input/pose_input.h"

namespace sweep_guard_ros {

/// Receives what the guard needs to know: transforms, poses, meshes, other tools, images and commands, each in a thread of its own. Connects
/// them again to publishers that were out of reach.
class Inputs {
 public:
  /// @param master  looks for publishers; must be stopped before this is destroyed
  Inputs(const ros::NodeHandle& node, const ros::NodeHandle& private_node, GuardState& state, MasterThread& master);

  void start();
  void takeEarly() { meshes_.takeEarly(); }               ///< as MeshInput
  void applyLateChanges() { poses_.applyLateChanges(); }  ///< as PoseInput
  void addRestingPose() { poses_.addRestingPose(); }      ///< as PoseInput

  const PoseInput& poses() const { return poses_; }
  const MeshInput& meshes() const { return meshes_; }
  const Cameras& cameras() const { return cameras_; }
  const CommandInput* commands() const { return commands_.get(); }  ///< null: none is listened to

 private:
  GuardState& state_;
  PoseInput poses_;
  MeshInput meshes_;
  OtherTools other_tools_;
  Cameras cameras_;
  std::unique_ptr<CommandInput> commands_;
  PeerWatch peer_watch_;
};

}  // namespace sweep_guard_ros
