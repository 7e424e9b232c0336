#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sweep_guard/common/error.h"
#include "sweep_guard/common/sample_buffer.h"
#include "sweep_guard/common/stamped_pose.h"
#include "sweep_guard/kinematics/robot_motion.h"

namespace sweep_guard_core {

/// The positions of all joints of a robot at one time.
struct StampedPositions {
  Time stamp;
  std::vector<double> positions;  ///< one of each variable of the tree [rad or m]
};

template <typename Value>
using Track = SampleBuffer<StampedValue<Value>>;

/// Refuses positions of a joint that two publishers name.
struct SeveralPublishers : InvalidInput {
  using InvalidInput::InvalidInput;
};
/// Refuses positions of a joint at an earlier time than its newest.
struct OutOfOrder : InvalidInput {
  using InvalidInput::InvalidInput;
};

/// Merges the positions of the joints of a robot, each with stamps of its own, into states of all of them. A joint
/// moves at constant speed between two of its positions, a continuous one the shorter way. A state comes out for every
/// stamp of any joint, once all joints are known up to it: joined by RobotMotion, the states are exactly the motion of
/// the joints, and nothing of it is left out except what leavesOut() reports. Nothing comes out before the first stamp
/// up to which all joints have been heard of.
///
/// The root may move as well: its poses are joined as Motion says.
class JointTimeline {
 public:
  /// @param tree   must outlive it
  /// @param fixed  position of each variable that needs none [rad or m]; empty: it comes by add()
  JointTimeline(const KinematicTree& tree, std::vector<std::optional<double>> fixed, bool root_moves);

  /// Position of one variable.
  struct Position {
    size_t variable;  ///< index in the tree
    double value;     ///< [rad or m]
  };

  /// Adds positions of some joints at one moment; all of them or, if it throws, none. Those of fixed joints are passed over.
  /// @param publisher  who says so; a joint belongs to the first who names it, until it was silent for 1 s
  /// @throws InvalidInput if a position is not finite or beyond 1e4, that of a continuous joint beyond 1e10, or a joint is
  ///     named twice
  /// @throws SeveralPublishers, OutOfOrder
  void add(const std::string& publisher, Time stamp, const std::vector<Position>& positions);

  /// Adds a pose of the root, which must move.
  /// @param stamp  not earlier than the previous one (asserted)
  /// @param X_WR   finite, rotation orthonormal; not checked
  void addRoot(Time stamp, const Eigen::Isometry3d& X_WR);

  /// Returns the next state, in the order of stamps; those of the same moment differ where a joint was at two places in it.
  /// The root is at the origin if it does not move.
  /// @param[out] state  overwritten; its buffers are used again
  /// @returns the stamp of the state; empty: none is known yet
  std::optional<Time> next(RobotState& state);

  /// Returns whether the newest state from next() was reached straight past positions that were dropped: a joint, or the
  /// root, was too far ahead of another one.
  bool leavesOut() const { return leaves_out_; }

  /// Returns whether a variable is not fixed.
  bool expects(size_t variable) const { return !joints_[variable].fixed; }
  /// Returns the newest stamp of a variable; empty before the first.
  std::optional<Time> newestOf(size_t variable) const;
  std::optional<Time> newestOfRoot() const;  ///< the same of a root that moves; empty also if it does not move

  /// Returns the stamps of the poses of the root that later states need.
  std::vector<Time> rootStamps() const;
  /// Moves these poses.
  /// @param motions_W  of each, in the frame that it is given in
  void moveRoot(const std::vector<Eigen::Isometry3d>& motions_W);

  void reset();  ///< forgets all positions

 private:
  struct Joint {
    std::optional<double> fixed;
    std::string publisher;
    Track<double> track;
  };

  void check(const std::string& publisher, Time stamp, const std::vector<Position>& positions) const;
  void checkPublisher(const std::string& publisher, Time stamp, const Position& position) const;
  double unwound(size_t variable, double value) const;
  std::optional<Time> commonStart() const;
  std::optional<Time> nextStamp() const;
  void advance(Time to, bool past_all);
  void stateAt(Time stamp, RobotState& state) const;
  template <typename Visit>
  void forEachTrack(const Visit& visit) const;

  const KinematicTree& tree_;
  std::vector<Joint> joints_;  // by variable
  bool root_moves_;
  Track<Eigen::Isometry3d> root_;
  bool begun_ = false;
  bool dropped_ = false;  // since the newest state
  bool leaves_out_ = false;
};

}  // namespace sweep_guard_core
