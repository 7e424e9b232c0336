#include "ros/motion/motion_guard_node.h"

#include <ros/console.h>

#include "ros/output/flush.h"

namespace sweep_guard_ros {
namespace {

constexpr auto kHoldPeriod = std::chrono::milliseconds(20);
constexpr auto kStatusPeriod = std::chrono::milliseconds(10);
constexpr auto kDiagnosticsPeriod = std::chrono::seconds(1);
constexpr size_t kMaxTransforms = 64 << 20;  // size of a message [bytes]

}  // namespace

MotionGuardNode::MotionGuardNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Process process)
    : parameters_(loadMotionParameters(private_node)),
      master_watch_(private_node, [this] { return parameters_.settings; }),
      supervisor_(process),
      frames_(node, kMaxTransforms, [](const std::string& /*parent*/, const std::string& /*child*/) {}),
      guard_(node, parameters_.guardSource()),
      tool_pose_(node, parameters_.poseSource(), frames_),
      status_(private_node, parameters_.fixed_frame),
      hold_(private_node),
      cycle_(node, private_node, parameters_, {guard_, tool_pose_, frames_, status_, hold_}),
      output_watch_(cycle_.port().guardedTopic()),
      diagnostics_(node, private_node, {cycle_, guard_, tool_pose_, status_, output_watch_}) {
  ticks_.every(CommandCycle::kTickPeriod, [this] { cycle_.tick(); });
  ticks_.every(kHoldPeriod, [this] { cycle_.publishHold(hold_); });
  ticks_.every(kHoldPeriod, [this] { frames_.checkClock(); });
  ticks_.every(kStatusPeriod, [this] { status_.publishIfDue(); });
  reports_.every(kDiagnosticsPeriod, [this] { diagnostics_.publish(); });
}

// Not in the constructor: where one thread cannot be started, the destructor ends the others.
void MotionGuardNode::start() {
  frames_.start(supervisor_);
  guard_.start(supervisor_);
  tool_pose_.start(supervisor_);
  cycle_.start(supervisor_);
  ticks_.start(supervisor_, {"ticks", sweep_guard_core::Stage::kPublish});
  reports_.start(supervisor_, {"reports", sweep_guard_core::Stage::kPublish});
  output_watch_.start(supervisor_);
  master_watch_.start(supervisor_);
  supervisor_.start();
  ROS_INFO("guarding the motion of '%s' in '%s': commands from %s, guarded ones to %s, planes from %s",
           parameters_.tool_frame.c_str(), parameters_.fixed_frame.c_str(), cycle_.port().commandTopic().c_str(),
           cycle_.port().guardedTopic().c_str(), parameters_.guard.c_str());
}

MotionGuardNode::~MotionGuardNode() {
  ticks_.stop();
  cycle_.stop();
  flush();  // the zero first
  hold_.hold();
  flush();
  reports_.stop();
  master_watch_.stop();  // its thread uses the supervisor, which is declared after it
}

}  // namespace sweep_guard_ros
