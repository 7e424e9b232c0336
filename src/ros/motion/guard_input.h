#pragma once

#include <sweep_guard/Proximity.h>
#include <sweep_guard/ToolBalls.h>
#include <sweep_guard/Warning.h>

#include <string>

#include "common/guarded_by.h"
#include "common/pool.h"
#include "monitor/input_record.h"
#include "ros/connection/bounded.h"
#include "ros/motion/input_diagnostics.h"
#include "ros/motion/pose_source.h"
#include "ros/process/log_throttle.h"
#include "ros/threads/queue_thread.h"
#include "sweep_guard/motion/motion_guard.h"

namespace sweep_guard_ros {

/// Receives the planes, the balls of the tool and the warning of a guard, in a thread of its own, and keeps the newest of
/// each. One that is refused changes nothing: the guard then seems silent. So it does if several nodes publish.
class GuardInput {
 public:
  /// @param guard  name of its node
  /// @param tool   frames, and the silence after which another node may publish or stamps may go back
  GuardInput(const ros::NodeHandle& node, const std::string& guard, const PoseSource& tool);

  void start(Supervisor& supervisor) {
    thread_.start(supervisor, {"guard", sweep_guard_core::Stage::kReceive, /*watched=*/true, /*loses_latched=*/true});
  }

  /// Returns the newest inputs, without a tool pose. Any thread.
  /// @param[out] message  that the planes are from; null as long as there are no planes
  sweep_guard_core::MotionInputs inputs(sweep_guard::Proximity::ConstPtr* message = nullptr) const;

  void report(DiagnosticsLine& line) const;  ///< fills the line of the messages
  std::string absence() const;  ///< that nobody publishes the warning, and what to do; empty: somebody does

 private:
  template <typename Msg>
  BoundedSubscriber subscribe(const ros::NodeHandle& node, const std::string& topic,
                              sweep_guard_core::InputRecord& record,
                              void (GuardInput::*accept)(const ros::MessageEvent<const Msg>&));
  void acceptPlanes(const ros::MessageEvent<const sweep_guard::Proximity>& event);
  void acceptTool(const ros::MessageEvent<const sweep_guard::ToolBalls>& event);
  void acceptWarning(const ros::MessageEvent<const sweep_guard::Warning>& event);
  void refuse(const std::string& topic, const std::string& reason, sweep_guard_core::InputRecord& record);
  void checkStamp(sweep_guard_core::Timestamps& timestamps) const;
  void checkFrame(const std::string& frame, const std::string& expected) const;

  const std::string guard_;
  const std::string fixed_frame_;
  const std::string tool_frame_;
  const sweep_guard_core::Duration silence_;
  mutable sweep_guard_core::Mutex mutex_;
  sweep_guard_core::MotionInputs newest_ GUARDED_BY(mutex_);
  sweep_guard::Proximity::ConstPtr newest_planes_ GUARDED_BY(mutex_);
  sweep_guard_core::Pool<sweep_guard_core::PlaneSet> plane_sets_;  // used by the thread that receives
  sweep_guard_core::InputRecord planes_record_;
  sweep_guard_core::InputRecord tool_record_;
  sweep_guard_core::InputRecord warning_record_;
  LogThrottle log_;
  QueueThread thread_;  // before the subscribers, which use its queue
  BoundedSubscriber planes_;
  BoundedSubscriber tool_;
  BoundedSubscriber warning_;
};

}  // namespace sweep_guard_ros
