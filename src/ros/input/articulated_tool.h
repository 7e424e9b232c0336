#pragma once

#include <sensor_msgs/JointState.h>

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "monitor/recent_conflict.h"
#include "ros/input/foreign_joints.h"
#include "ros/input/joint_names.h"
#include "ros/parameters/live_parameters.h"
#include "sweep_guard/guard/pose_with_frames.h"
#include "sweep_guard/kinematics/joint_timeline.h"

namespace sweep_guard_ros {

/// Turns positions of joints into poses of the bodies of an articulated tool. Between two states, it gives as many poses as
/// keep every body within 0.5 mm of how Motion joins them, at most 100; the poses tell the deviation bound. One thread.
class ArticulatedTool {
 public:
  /// @param live  with an articulated tool; its bodies may change, its joints do not
  explicit ArticulatedTool(const LiveParameters& live);

  /// Returns the first name in a message of a joint of the tool that moves; null: the message does not concern the tool.
  const std::string* firstJointIn(const sensor_msgs::JointState& message) const { return names_.firstIn(message); }
  /// Remembers the names of joints that are not the tool's, as long as silence() has use for them.
  void noteForeign(const sensor_msgs::JointState& message);

  /// Adds positions of joints; those that are not of the tool are passed over.
  /// @throws sweep_guard_core::InvalidInput as JointTimeline::add(), or if there are not as many positions as names
  void add(const std::string& publisher, const sensor_msgs::JointState& positions,
           sweep_guard_core::SteadyTime received);
  /// Adds a pose of the tool frame, as JointTimeline::addRoot(); not with ToolSource::kJointStates.
  void add(sweep_guard_core::Time stamp, const Eigen::Isometry3d& X_WT);

  /// Computes the poses up to the next state that is known; the last one is that of the state.
  /// @param X_WT        returns the pose of the tool frame at a time, with ToolSource::kJointStates; empty: the state waits for it.
  ///                    If it throws, the state is left out: the motion goes straight past it
  /// @param[out] poses  overwritten; without frames, nor when they were received
  /// @returns false if no other state is known yet
  bool next(const std::function<std::optional<Eigen::Isometry3d>(sweep_guard_core::Time)>& X_WT,
            std::vector<sweep_guard_core::PoseWithFrames>& poses);

  /// Returns whether the newest poses from next() go straight past positions that were dropped.
  bool leavesOut() const { return timeline_.leavesOut(); }

  /// Returns which joints of the tool, or its pose, have not been published yet, and which other joints came; else which
  /// one is silent; empty: none.
  /// @param now  as the stamps
  std::string silence(sweep_guard_core::Time now) const;

  /// Returns which joint two nodes publish, in words, for 1.5 s after positions were refused for it (RecentConflict); empty: none.
  std::string conflict(sweep_guard_core::SteadyTime now) const { return conflict_.text(now); }

  using PoseOfFrame = std::function<std::optional<Eigen::Isometry3d>(sweep_guard_core::Time)>;
  /// Moves the known poses of the tool frame with a frame whose static transform is replaced.
  /// @param X_WF   returns its pose at a time; empty: not known
  /// @param place  replaces it
  void placeAnew(const PoseOfFrame& X_WF, const std::function<void()>& place);

  void reset();  ///< forgets all positions, not a conflict

 private:
  bool isMissing(size_t variable) const;
  std::string shownJoint(size_t variable) const;
  std::string missingPose() const;
  std::string missingJoints() const;
  void place(sweep_guard_core::Time stamp, const sweep_guard_core::RobotState& state,
             std::vector<sweep_guard_core::PoseWithFrames>& poses);

  ArticulatedTool(const LiveParameters& live, const Parameters& parameters);
  const LiveParameters& live_;
  const std::shared_ptr<const RobotModel> model_;  // at the start
  const bool root_moves_;
  const sweep_guard_core::Duration root_timeout_;
  const std::vector<std::optional<double>> fixed_;  // by variable
  const JointNames names_;
  std::vector<sweep_guard_core::Duration> timeouts_;  // by variable
  sweep_guard_core::JointTimeline timeline_;
  std::vector<sweep_guard_core::JointTimeline::Position> named_;  // in the message
  sweep_guard_core::RecentConflict conflict_;
  ForeignJoints foreign_;                             // since a joint of the tool is missing
  std::optional<sweep_guard_core::Time> stamp_;       // of state_
  sweep_guard_core::RobotState state_;                // the newest
  std::optional<sweep_guard_core::Time> next_stamp_;  // of next_ while it waits
  sweep_guard_core::RobotState next_;
  std::vector<Eigen::Isometry3d> X_WB_;
};

}  // namespace sweep_guard_ros
