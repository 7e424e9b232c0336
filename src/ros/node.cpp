#include "ros/node.h"

#include <ros/console.h>

#include <utility>

namespace sweep_guard_ros {
namespace {

const ros::WallDuration kViewPeriod(1.0 / 60.0);
const ros::WallDuration kDiagnosticsPeriod(1.0);

}  // namespace

SweepGuardNode::SweepGuardNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node)
    : parameters_(loadParameters(private_node)),
      master_watch_(private_node, parameters_),
      monitor_(
          parameters_.initial().limits, [this] { warnings_.publishIfChanged(); },
          [this] { return queue_.waitingSince(); }),
      warnings_(private_node, parameters_, monitor_),
      scene_(private_node, parameters_, monitor_),
      statistics_(parameters_.initial().guard.cycle),
      frames_(node, parameters_.initial().max_message_size,
              [this](const std::string& parent, const std::string& child) {
                monitor_.timeJumped("static transform from '" + child + "' to '" + parent + "' has changed");
              }),
      workpieces_([this](const auto& workpieces) { monitor_.setWorkpieces(workpieces); }),
      cross_check_(parameters_, monitor_),
      guard_thread_(private_node, {parameters_, workpieces_, monitor_, statistics_, queue_, warnings_, scene_,
                                   cross_check_.sampler()}),
      poses_(node, parameters_.initial(), {frames_, workpieces_, monitor_, queue_}),
      meshes_(node, parameters_.initial(), workpieces_, monitor_),
      check_sweep_(private_node, parameters_, frames_, workpieces_, monitor_),
      predict_(private_node, parameters_, workpieces_,
               [this](sweep_guard_core::Duration horizon) { return guard_thread_.predictMotion(horizon); }),
      controls_(private_node, monitor_, workpieces_, [this] { guard_thread_.reset(); }),
      reconfigure_server_(private_node, parameters_, [this](const auto& next) { apply(next); }),
      diagnostics_(node, private_node,
                   {parameters_, poses_, meshes_, workpieces_, monitor_, statistics_, reconfigure_server_}),
      watchdog_(node, monitor_, workpieces_, warnings_),
      peer_watch_(monitor_) {
  createTimers(node);
  guard_thread_.start();
  cross_check_.start();
  watchdog_.start();
  meshes_.start();
  poses_.start();
  check_sweep_.start();
  predict_.start();
  controls_.start();
  reconfigure_server_.start();
  timer_thread_.start();
  master_watch_.start();
  peer_watch_.start();
  logStart();
}

SweepGuardNode::~SweepGuardNode() {
  monitor_.end();
  warnings_.publishFinal();
  guard_thread_.stop();
}

void SweepGuardNode::apply(const std::shared_ptr<const Parameters>& next) {
  guard_thread_.apply(next);
  marker_timer_.setPeriod(ros::WallDuration(1.0 / next->marker_rate));
  warnings_.publishIfChanged();
}

void SweepGuardNode::createTimers(const ros::NodeHandle& node) {
  ros::NodeHandle timers = timer_thread_.on(node);
  marker_timer_ = timers.createSteadyTimer(ros::WallDuration(1.0 / parameters_.initial().marker_rate),
                                           [this](const ros::SteadyTimerEvent&) { scene_.publishMarkers(); });
  view_timer_ = timers.createSteadyTimer(kViewPeriod, [this](const ros::SteadyTimerEvent&) { scene_.publishView(); });
  diagnostics_timer_ =
      timers.createSteadyTimer(kDiagnosticsPeriod, [this](const ros::SteadyTimerEvent&) { diagnostics_.publish(); });
}

void SweepGuardNode::logStart() const {
  const Parameters& initial = parameters_.initial();
  ROS_INFO("guarding '%s' (%s) in '%s' by %s, %s; poses from %s, meshes from %s and %s", initial.tool_frame.c_str(),
           initial.tool_description.c_str(), initial.fixed_frame.c_str(), initial.detector_description.c_str(),
           sweep_guard_core::nameOf(initial.guard.sweep.volume).c_str(), poses_.source().c_str(),
           meshes_.meshTopic().c_str(), meshes_.verticesTopic().c_str());
}

}  // namespace sweep_guard_ros
