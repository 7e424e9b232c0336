#pragma once

#include <vector>

#include "sweep_guard/kinematics/kinematic_tree.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

/// The joints, predicted for a time after the newest observed positions.
struct PredictedJoints {
  std::vector<double> positions;  ///< most likely [rad or m]
  std::vector<double> variances;  ///< of their errors, >= 0
};

/// Predicts the motion of joints, each on its own, as PosePredictor predicts that of a pose. A joint is predicted to stop
/// at its limits; one that contradicts a limit (limitTolerance()) is predicted to go on as if it had none. Any thread may call it, one thread at a time.
///
/// Of the options, `max_turn_rate` limits joints that turn and `max_speed` the others; the largest of `degree` is that of
/// each joint. `constrained` does not count.
class JointPredictor {
 public:
  /// @throws InvalidInput as PosePredictor()
  JointPredictor(const PredictorOptions& options, const std::vector<JointVariable>& joints);
  ~JointPredictor();
  JointPredictor(JointPredictor&&) noexcept;
  JointPredictor& operator=(JointPredictor&&) noexcept;

  /// Adds the velocities that go to the robot, as PosePredictor::command(); anything else is ignored.
  void command(const SentCommand& command);

  /// Adds the newest positions, as PosePredictor::observe().
  /// @param positions  one of each joint, finite; not checked
  void observe(Time stamp, const std::vector<double>& positions);

  /// Returns whether a motion of every joint is known: two positions since the start, a gap, a jump or restart().
  bool knowsMotion() const;

  /// Predicts the positions; the motion must be known.
  /// @param ahead        after the stamp of the newest observed positions, > 0
  /// @param[out] joints  overwritten; its buffers are used again
  void predict(Duration ahead, PredictedJoints& joints) const;

  /// Returns whether the motion of a joint is predicted from its command.
  bool usesCommand() const;

  /// Forgets the positions, and keeps what was learned of the operator.
  void restart();

 private:
  struct Joint;
  std::vector<Joint> joints_;
};

}  // namespace sweep_guard_core
