#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "sweep_guard/guard/pose_with_frames.h"
#include "sweep_guard/guard/prediction.h"
#include "sweep_guard/kinematics/kinematic_tree.h"
#include "sweep_guard/kinematics/robot_path.h"
#include "sweep_guard/prediction/horizon.h"
#include "sweep_guard/prediction/joint_predictor.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

/// Predicts the motion of a tool: that of the tool frame by PosePredictor and, of a robot, that of its joints by
/// JointPredictor. The bodies of a robot are where its predicted joints put them, which is where they can go. Their
/// covariances are those of frame and joints to first order, J * C * J^T with the geometric Jacobian J of each body, and
/// what the arcs of the joints add to the position. The errors of the joints count as independent of each other.
///
/// The joints of a trajectory under way (PredictedMotion::trajectory) are predicted by it instead, as long as they follow it.
class MotionPredictor {
 public:
  /// @param robot  of which joints move; null: a tool of one rigid body
  /// @throws InvalidInput as PosePredictor()
  explicit MotionPredictor(const PredictorOptions& options, std::shared_ptr<const Robot> robot = nullptr);

  /// Adds what goes to the robot, to the tool frame or to its joints, as PosePredictor::command().
  void command(const SentCommand& command);

  /// Adds the newest pose, as PosePredictor::observe().
  /// @param pose  of a robot: with the state of its joints; not checked
  void observe(const PoseWithFrames& pose);

  /// Predicts the paths after the newest pose, which `motion.from` is, as PosePredictor::predict(). Reads the trajectory of
  /// `motion`.
  ///
  /// The bodies of a robot do not move as a Motion from pose to pose. A step of the horizon in which one deviates by more
  /// than 0.5 mm (in the reflex interval) or 5 mm (later) is cut into up to four; PredictedPose::deviation_bound has what
  /// is left. Along a trajectory, no step is longer than kTrajectoryStep.
  /// @param[in,out] motion  its paths, `reflex_sweeps` and `source` are overwritten, all or none of the paths empty
  void predict(const Horizon& horizon, PredictedMotion& motion) const;

  /// Forgets the poses, and keeps what was learned of the operator.
  void restart();
  /// The same of the tool frame alone: its joints go on.
  void restartTool() { tool_.restart(); }

  /// Exchanges the robot for one with the same joints.
  void exchange(std::shared_ptr<const Robot>& robot) { std::swap(robot_, robot); }
  bool isRigid() const { return robot_ == nullptr; }  ///< the tool is one body

 private:
  std::vector<RobotState> statesAlong(const PredictedMotion& motion) const;
  Horizon cut(const Horizon& horizon, const PredictedMotion& motion) const;
  void predictJoints(const PredictedMotion& motion, Duration ahead, PredictedJoints& joints) const;
  void predictBodies(PredictedMotion& motion) const;

  PosePredictor tool_;
  std::shared_ptr<const Robot> robot_;
  std::optional<JointPredictor> joints_;
};

}  // namespace sweep_guard_core
