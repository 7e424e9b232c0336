#include "ros/haptics/haptics_node.h"

#include <ros/console.h>

#include "ros/output/flush.h"

namespace sweep_guard_ros {
namespace {

constexpr auto kClockPeriod = std::chrono::milliseconds(20);
constexpr auto kDiagnosticsPeriod = std::chrono::seconds(1);
constexpr size_t kMaxTransforms = 64 << 20;  // size of a message [bytes]

}  // namespace

HapticsNode::HapticsNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Process process)
    : parameters_(loadHapticsParameters(private_node)),
      master_watch_(private_node, [this] { return parameters_.settings; }),
      supervisor_(process),
      frames_(node, kMaxTransforms, [](const std::string& /*parent*/, const std::string& /*child*/) {}),
      guard_(node, parameters_.guard),
      tool_pose_(node, parameters_.tool, frames_),
      axes_(frames_, parameters_.guard.fixed_frame, parameters_.device_frame),
      priority_(parameters_.realtime_priority, "realtime_priority") {
  if (parameters_.device_tells_pose) device_pose_.emplace(node, parameters_.device(), frames_);
  cycle_.emplace(node, parameters_, ForceCycleSources{guard_, tool_pose_, device(), axes_});
  output_watch_.emplace(cycle_->topic());
  diagnostics_.emplace(
      node, private_node,
      HapticsDiagnosticsSources{*cycle_, axes_, priority_, guard_, tool_pose_, device(), *output_watch_});
  forces_.every(ForceCycle::kPeriod, [this] { cycle_->tick(); });
  reports_.every(kClockPeriod, [this] { frames_.checkClock(); });
  reports_.every(kDiagnosticsPeriod, [this] { diagnostics_->publish(); });
}

// Not in the constructor: where one thread cannot be started, the destructor ends the others.
void HapticsNode::start() {
  frames_.start(supervisor_);
  guard_.start(supervisor_);
  tool_pose_.start(supervisor_);
  if (device_pose_) device_pose_->start(supervisor_, "device poses");
  forces_.start(supervisor_, {"forces", sweep_guard_core::Stage::kPublish}, [this] { priority_.make(); });
  reports_.start(supervisor_, {"reports", sweep_guard_core::Stage::kPublish});
  output_watch_->start(supervisor_);
  master_watch_.start(supervisor_);
  supervisor_.start();
  ROS_INFO("forces of the surfaces around '%s' in '%s' go to %s along the axes of '%s', planes come from %s",
           parameters_.guard.tool_frame.c_str(), parameters_.guard.fixed_frame.c_str(), cycle_->topic().c_str(),
           parameters_.device_frame.c_str(), parameters_.guard.guard.c_str());
}

HapticsNode::~HapticsNode() {
  forces_.stop();
  cycle_->stop();
  flush();
  reports_.stop();
  master_watch_.stop();  // its thread uses the supervisor, which is declared after it
}

}  // namespace sweep_guard_ros
