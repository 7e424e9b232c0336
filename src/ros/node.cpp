#include "ros/node.h"

#include <ros/console.h>

namespace sweep_guard_ros {

SweepGuardNode::SweepGuardNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Process process)
    : parameters_(withAvailableDetector(loadParameters(private_node))),
      master_watch_(private_node, [this] { return parameters_.get()->settings; }),
      state_(node, private_node, process, parameters_),
      guard_(private_node, state_),
      inputs_(node, private_node, state_, master_watch_.thread()),
      outputs_(node, private_node, state_, guard_, inputs_, master_watch_.thread()),
      watchdog_(state_, [this] {
        inputs_.applyLateChanges();
        inputs_.addRestingPose();
      }) {}

// Not in the constructor: where one thread cannot be started, the destructor ends the others.
void SweepGuardNode::start() {
  guard_.start();
  watchdog_.start();
  inputs_.start();
  outputs_.start();
  master_watch_.start(state_.supervisor);
  state_.supervisor.start();
  logStart();
}

SweepGuardNode::~SweepGuardNode() {
  state_.monitor.end();
  state_.warnings.publishFinal();
  outputs_.stopReports();
  master_watch_.stop();  // its thread uses what is declared after it
  guard_.stop();
  outputs_.stopServices();
}

void SweepGuardNode::logStart() const {
  const Parameters& initial = parameters_.initial();
  const MeshInput& meshes = inputs_.meshes();
  ROS_INFO("guarding '%s' (%s) in '%s' by %s, %s; poses from %s, meshes from %s and %s", initial.tool_frame.c_str(),
           initial.tool_description.c_str(), initial.fixed_frame.c_str(), describe(initial.detector).c_str(),
           sweep_guard_core::nameOf(initial.guard.sweep.volume).c_str(), inputs_.poses().source().c_str(),
           meshes.meshTopic().c_str(), meshes.verticesTopic().c_str());
  for (const sweep_guard_core::AllowedPair& pair : initial.guard.allowed)
    ROS_INFO("contact of %s is allowed (tool/allowed): it is no warning", describe(pair).c_str());
}

}  // namespace sweep_guard_ros
