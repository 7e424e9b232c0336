#pragma once

#include <sensor_msgs/JointState.h>

#include <memory>
#include <string>
#include <vector>

#include "common/guarded_by.h"
#include "monitor/input_record.h"
#include "ros/connection/bounded.h"
#include "ros/input/foreign_joints.h"
#include "ros/motion/input_diagnostics.h"
#include "ros/motion/source_parameters.h"
#include "ros/process/log_throttle.h"
#include "ros/threads/queue_thread.h"
#include "sweep_guard/kinematics/joint_timeline.h"
#include "sweep_guard/motion/joint_motion_guard.h"

namespace sweep_guard_ros {

/// Keeps the newest position of each joint of a robot, from `joint_states`.
class JointInput {
 public:
  /// @param source   not null
  /// @param silence  after which stamps may go back
  JointInput(const ros::NodeHandle& node, JointSource source, sweep_guard_core::Duration silence);

  void start(Supervisor& supervisor) { thread_.start(supervisor, {"joints", sweep_guard_core::Stage::kReceive}); }

  /// Finds where the joints are now that planes name; false: none of them was heard of, or two nodes publish one. One that was never heard of, though
  /// others were, is fixed by the guard: it is where the planes say, and as old. Any thread.
  /// @param[out] joints  overwritten; its buffer is used again
  bool newest(const sweep_guard_core::PlaneSet& planes, sweep_guard_core::MeasuredJoints& joints) const;

  void report(DiagnosticsLine& line) const;  ///< fills the line of the joints
  std::string absence() const;               ///< what to do if newest() finds nothing; empty: it does
  std::string oldest() const;                ///< names the joint that was heard of longest ago; empty: none was

 private:
  void onMessage(const std::string& publisher, const sensor_msgs::JointState& msg);

  struct Joint {
    double position = 0.0;  // [rad or m]
    sweep_guard_core::Timestamps timestamps;
    std::string publisher;  // empty: none was heard of
  };
  void check(const std::string& publisher, const sweep_guard_core::JointTimeline::Position& named,
             const sweep_guard_core::Timestamps& timestamps) REQUIRES(mutex_);
  bool disputed() const REQUIRES(mutex_);
  void refuse(const std::string& reason);

  const JointSource source_;
  const sweep_guard_core::Duration silence_;
  mutable sweep_guard_core::Mutex mutex_;
  std::vector<Joint> joints_ GUARDED_BY(mutex_);  // by variable
  ForeignJoints foreign_ GUARDED_BY(mutex_);
  std::string dispute_ GUARDED_BY(mutex_);  // which joint two nodes publish, and since when it is known
  sweep_guard_core::SteadyTime disputed_at_ GUARDED_BY(mutex_);
  std::vector<sweep_guard_core::JointTimeline::Position> named_;  // used by the thread that receives
  sweep_guard_core::InputRecord record_;
  LogThrottle log_;
  QueueThread thread_;  // before the subscriber, which uses its queue
  BoundedSubscriber subscriber_;
};

}  // namespace sweep_guard_ros
