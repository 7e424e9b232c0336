#pragma once

#include <ros/node_handle.h>
#include <std_srvs/Trigger.h>

#include <memory>
#include <optional>
#include <string>

#include "common/guarded_by.h"
#include "monitor/input_record.h"
#include "ros/motion/command_frames.h"
#include "ros/motion/command_port.h"
#include "ros/motion/guard_input.h"
#include "ros/motion/hold_publisher.h"
#include "ros/motion/motion_parameters.h"
#include "ros/motion/status_publisher.h"
#include "ros/motion/tool_pose_input.h"
#include "ros/threads/queue_thread.h"
#include "sweep_guard/motion/command_gaps.h"
#include "sweep_guard/motion/command_period.h"
#include "sweep_guard/motion/motion_guard.h"

namespace sweep_guard_ros {

struct CommandCycleSources {
  const GuardInput& guard;
  const ToolPoseInput* tool_pose;  ///< null for commands of joints
  const JointInput* joints;        ///< null for others
  const Frames& frames;
  StatusPublisher& status;
};

/// Sends what is let through of each command, in the thread that receives it. Between commands, tick() limits the
/// newest one again if it is late or may no longer be let through, and repeats it each kRepeatPeriod, so that what
/// follows may stop on a shorter silence than the commands'. When the commands stop, it sends zeros.
class CommandCycle {
 public:
  CommandCycle(const ros::NodeHandle& node, const ros::NodeHandle& private_node, const MotionParameters& parameters,
               const CommandCycleSources& sources);
  ~CommandCycle();

  void start(Supervisor& supervisor) { thread_.start(supervisor, {"commands", sweep_guard_core::Stage::kReceive}); }

  static constexpr sweep_guard_core::Duration kTickPeriod = std::chrono::milliseconds(5);
  static constexpr sweep_guard_core::Duration kRepeatPeriod = std::chrono::milliseconds(50);
  void tick();  ///< to be called each kTickPeriod

  /// Publishes whether a command would be let through now in some part: the guard knows, and is not silent. If not, zero
  /// is sent before.
  void publishHold(HoldPublisher& hold);

  void stop();  ///< takes no command any more; sends zero if the last command was another one

  const CommandPort& port() const { return *port_; }
  const sweep_guard_core::InputRecord& record() const { return record_; }
  sweep_guard_core::Duration period() const;  ///< the longest for which a command stays without being limited anew
  std::string rarity() const;                 ///< CommandGaps::rarity()

 private:
  using Trigger = std_srvs::Trigger;
  enum class Sending { kNew, kRepeated, kIfChanged };

  void onCommand(const CommandPort::Message& message, const sweep_guard_core::Timestamps& timestamps);
  void refuse(const std::string& reason);
  ros::ServiceServer advertiseRebase(ros::NodeHandle node);
  bool onRebase(Trigger::Request& request, Trigger::Response& response);
  void update(const sweep_guard_core::Instant& at) REQUIRES(mutex_);
  bool letsThrough(const sweep_guard_core::Instant& at) REQUIRES(mutex_);
  sweep_guard_core::Duration longestInForce() const REQUIRES(mutex_);
  CommandPort::Cycle cycleAt(const sweep_guard_core::Instant& at) const REQUIRES(mutex_);
  sweep_guard_core::MotionInputs inputs(sweep_guard::Proximity::ConstPtr* planes = nullptr) const;
  void limitNewest(const sweep_guard_core::Instant& at, Sending sending) REQUIRES(mutex_);
  void explain(sweep_guard_core::PermissionCause cause, const sweep_guard_core::Instant& at,
               sweep_guard::MotionStatus& status) const REQUIRES(mutex_);
  void sendZero(const sweep_guard_core::Instant& at) REQUIRES(mutex_);
  void halt(const sweep_guard_core::Instant& at) REQUIRES(mutex_);

  const MotionParameters& parameters_;
  const CommandCycleSources sources_;
  const std::string topic_;  // resolved, of the commands
  sweep_guard_core::InputRecord record_;
  LogThrottle log_;
  mutable sweep_guard_core::Mutex mutex_;  // of what follows
  sweep_guard_core::CommandPeriod period_ GUARDED_BY(mutex_);
  sweep_guard_core::CommandGaps gaps_ GUARDED_BY(mutex_);
  std::optional<sweep_guard_core::Timestamps> command_ GUARDED_BY(mutex_);  // newest one; empty: nothing is to be sent
  sweep_guard_core::Permission permission_ GUARDED_BY(mutex_) =
      sweep_guard_core::Permission::kStop;  // of what was sent last
  std::optional<sweep_guard_core::GuardedMotion> sent_motion_
      GUARDED_BY(mutex_);                                 // for the newest command; empty: zero, for it is refused
  sweep_guard_core::SteadyTime sent_ GUARDED_BY(mutex_);  // or limited anew with the same outcome
  sweep_guard_core::SteadyTime published_ GUARDED_BY(mutex_);
  int halts_ GUARDED_BY(mutex_) = 0;  // zeros since the commands have stopped

  QueueThread thread_;  // before the port and the service, which use its queue
  std::unique_ptr<CommandPort> port_;
  ros::ServiceServer rebase_;
};

}  // namespace sweep_guard_ros
