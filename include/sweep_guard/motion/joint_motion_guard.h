#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/kinematics/robot_motion.h"
#include "sweep_guard/motion/motion_guard.h"
#include "sweep_guard/motion/moving_tool.h"

namespace sweep_guard_core {

/// A commanded velocity of the joints of a robot.
struct JointCommand {
  Eigen::VectorXd velocities;  ///< of each variable of the tree [rad/s or m/s]; 0: the joint is at rest
  Timestamps timestamps;       ///< without a stamp of its own, that of its receipt
  Duration period{};           ///< until the next command, > 0
};

/// The joints of a robot as they were measured.
struct MeasuredJoints {
  RobotState state;       ///< without positions: none have arrived yet
  Timestamps timestamps;  ///< of the oldest position
};

/// Limits commanded velocities of joints so that every point of every link can stop before the surfaces around it. The
/// command is scaled as a whole, so that the path does not bend. One thread at a time. After the first calls it allocates
/// nothing.
class JointMotionGuard {
 public:
  /// @param tree  of all links that planes name, and maybe more; its root is the tool frame
  /// @throws InvalidInput  if an option is NaN or out of range
  JointMotionGuard(const MotionGuardOptions& options, std::shared_ptr<const KinematicTree> tree);

  /// Returns what to send for a command, and remembers that it was sent: `scale` is the share of it, bit for bit 1 if nothing
  /// limits it; `twist_W` has no meaning. `limiting` is the plane that sets the scale.
  /// @param inputs  without a pose; the balls' frames are links of the tree
  /// @param now     not before that of the last call
  /// @throws InvalidInput  if the command, the joints or the planes are not finite or out of range, or not of the tree, or if a
  ///     joint shall move that the planes do not name; then stop() has to be sent
  GuardedMotion guard(const MotionInputs& inputs, const MeasuredJoints& joints, const JointCommand& command,
                      const Instant& now);

  /// Decides how much of a command is let through, as guard() does, and remembers nothing.
  /// @param command  without a stamp of its own, that of its receipt
  PermissionDecision permission(const MotionInputs& inputs, const MeasuredJoints& joints, const Timestamps& command,
                                const Instant& now) const;

  /// Remembers that zero was sent.
  void stop(SteadyTime now);

  const MotionGuardOptions& options() const { return options_; }

 private:
  // A ball that the command moves, before a plane: where its way begins, and then on it.
  struct Row {
    size_t plane;
    size_t ball;          // index into MovingTool::balls()
    double first_gap;     // [m]
    double gap;           // [m]
    double closing;       // by the command [m/s]
    double acceleration;  // bound on that of the ball until the robot is at rest [m/s^2]
  };
  // How the robot stops within a way of the command [s] by the fastest point on it.
  struct Sample {
    StopOnPath stop;
    double way;
  };
  // For how long a command may go on as a whole, and the row that says so.
  struct Lasting {
    double time;  // [s]
    std::optional<Row> row;
  };

  void placeExpectedAndSwept(const MotionInputs& inputs, const MeasuredJoints& joints, const JointCommand& command,
                             const Instant& now);
  void limit(const MotionInputs& inputs, const MeasuredJoints& joints, const JointCommand& command,
             const BrakingLimits& limits, GuardedMotion& motion);
  void requireGuarded(const PlaneSet& planes, const JointCommand& command) const;
  void requireAgreement(const MotionInputs& inputs);
  UncoveredSurfaces uncovered(const MotionInputs& inputs) const;
  void sampleSpeeds(const MotionInputs& inputs, const JointCommand& command, const BrakingLimits& limits);
  double shareWithin(double way) const;
  Lasting lasting(const MotionInputs& inputs, const RobotState& from, MovingTool& tool, const JointCommand& command,
                  const BrakingLimits& limits, double scale);
  void collectRows(const MotionInputs& inputs, const MovingTool& state, const BrakingLimits& limits,
                   const StopOnPath& stop, double way);
  void moveOn(const RobotState& from, const JointCommand& command, double way);
  void moveRowsOn(const MotionInputs& inputs, const RobotState& from, const JointCommand& command, double way);
  void stopUnlessEveryGapOpens(const MotionInputs& inputs, const JointCommand& command, GuardedMotion& motion);

  const MotionGuardOptions options_;
  const std::shared_ptr<const KinematicTree> tree_;
  MotionInFlight in_flight_;
  RobotState expected_state_;
  RobotState later_state_;  // on the way of the command, or swept
  Eigen::VectorXd velocities_;
  MovingTool swept_;  // then on the way of the command
  MovingTool measured_;
  MovingTool expected_;
  std::vector<Row> rows_;
  std::vector<size_t> pieces_;  // of the rows
  std::vector<Sample> stops_;   // from the expected state on
};

}  // namespace sweep_guard_core
