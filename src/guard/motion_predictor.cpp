#include "sweep_guard/guard/motion_predictor.h"

#include <algorithm>
#include <utility>

namespace sweep_guard_core {
namespace {

constexpr double kReflexDeviation = 5e-4;      // [m], of a body from a Motion
constexpr double kConsideredDeviation = 5e-3;  // [m]
constexpr size_t kMostParts = 4;               // of a step

// Carries the errors of a frame to a point that moves with it, at r from its origin: dx + dtheta x r.
Matrix6d carried(const Matrix6d& covariance, const Eigen::Vector3d& r) {
  Matrix6d A = Matrix6d::Identity();
  A.topRightCorner<3, 3>() << 0.0, r.z(), -r.y(), -r.z(), 0.0, r.x(), r.y(), -r.x(), 0.0;
  return A * covariance * A.transpose();
}

// Of the error that J leaves out, to second order: joints i and j that err by q_i and q_j move a point by q_i q_j times the
// change of column j with joint i, which is no longer than the turn of one times the way of the other, and half of that if
// they are the same joint. The mean of its square counts along all axes.
double curvatureVariance(const Jacobian& J, const std::vector<double>& variances) {
  const auto column = [&](size_t i) { return J.col(static_cast<Eigen::Index>(i)); };
  double sum = 0.0;
  for (size_t i = 0; i < variances.size(); ++i) {
    for (size_t j = 0; j <= i; ++j) {
      const double change = std::min(column(i).head<3>().squaredNorm() * column(j).tail<3>().squaredNorm(),
                                     column(j).head<3>().squaredNorm() * column(i).tail<3>().squaredNorm());
      sum += (i == j ? 0.75 : 1.0) * change * variances[i] * variances[j];
    }
  }
  return sum;
}

// Both rows of vectors along the axes of W instead of R.
Jacobian turnedJacobian(const Jacobian& J_R, const Eigen::Matrix3d& R_WR) {
  Jacobian J_W(6, J_R.cols());
  J_W << R_WR * J_R.topRows<3>(), R_WR * J_R.bottomRows<3>();
  return J_W;
}

}  // namespace

MotionPredictor::MotionPredictor(const PredictorOptions& options, std::shared_ptr<const Robot> robot)
    : tool_(options), robot_(std::move(robot)) {
  if (robot_) joints_.emplace(options, robot_->tree.variables());
}

void MotionPredictor::command(const SentCommand& command) {
  tool_.command(command);
  if (joints_) joints_->command(command);
}

void MotionPredictor::observe(const PoseWithFrames& pose) {
  tool_.observe({pose.stamp, pose.X_WT});
  if (joints_) joints_->observe(pose.stamp, pose.state.positions);
}

void MotionPredictor::predict(const Horizon& horizon, PredictedMotion& motion) const {
  motion.body_paths.resize(robot_ ? robot_->bodies.size() : 0);
  for (PredictedPath& path : motion.body_paths) path.clear();
  motion.path.clear();
  const bool from_command = tool_.usesCommand() || (joints_ && joints_->usesCommand());
  motion.source = from_command ? PredictionSource::kCommand : PredictionSource::kMeasured;
  if (joints_ && !joints_->knowsMotion()) return;
  tool_.predict(horizon.ends, motion.path);
  motion.reflex_sweeps = horizon.reflex_sweeps;
  if (!joints_ || motion.path.empty()) return;
  const PoseWithFrames& from = motion.from;
  if (motion.trajectory && motion.trajectory->isFollowed(from.stamp, from.state.positions))
    motion.source = PredictionSource::kTrajectory;
  const Horizon shorter = cut(horizon, motion);
  tool_.predict(shorter.ends, motion.path);
  motion.reflex_sweeps = shorter.reflex_sweeps;
  predictBodies(motion);
}

void MotionPredictor::predictJoints(const PredictedMotion& motion, Duration ahead, PredictedJoints& joints) const {
  joints_->predict(ahead, joints);
  if (motion.source != PredictionSource::kTrajectory) return;
  motion.trajectory->predict(motion.from.stamp, motion.from.state.positions, ahead, joints.positions, joints.variances);
}

// The first is that of the newest pose. The tool frame and the root are one rigid body.
std::vector<RobotState> MotionPredictor::statesAlong(const PredictedMotion& motion) const {
  const Eigen::Isometry3d X_TR = motion.from.X_WT.inverse() * motion.from.state.X_WR;
  std::vector<RobotState> states = {motion.from.state};
  PredictedJoints joints;
  for (const PredictedPose& pose : motion.path) {
    predictJoints(motion, pose.ahead, joints);
    states.push_back({pose.X_WT * X_TR, joints.positions});
  }
  return states;
}

Horizon MotionPredictor::cut(const Horizon& horizon, const PredictedMotion& motion) const {
  const std::vector<RobotState> states = statesAlong(motion);
  const bool planned = motion.source == PredictionSource::kTrajectory;
  Horizon shorter;
  Duration begin{};
  for (size_t i = 0; i < horizon.ends.size(); ++i) {
    const bool reflex = i < horizon.reflex_sweeps;
    const RobotMotion step(robot_->tree, robot_->bodies, states[i], states[i + 1]);
    const Duration::rep samples = planned ? (horizon.ends[i] - begin - Duration(1)) / kTrajectoryStep + 1 : 1;
    const auto parts = std::max(samples, static_cast<Duration::rep>(step.partsFor(
                                             reflex ? kReflexDeviation : kConsideredDeviation, kMostParts)));
    for (Duration::rep part = 1; part < parts; ++part)
      shorter.ends.push_back(begin + (horizon.ends[i] - begin) * part / parts);
    begin = horizon.ends[i];
    shorter.ends.push_back(begin);
    if (reflex) shorter.reflex_sweeps = shorter.ends.size();
  }
  return shorter;
}

void MotionPredictor::predictBodies(PredictedMotion& motion) const {
  const std::vector<RobotState> states = statesAlong(motion);
  PredictedJoints joints;
  std::vector<Eigen::Isometry3d> X_RL;
  Jacobian J_R;
  for (size_t i = 0; i < motion.path.size(); ++i) {
    const auto& [ahead, X_WT, covariance, none] = motion.path[i];
    const RobotState& state = states[i + 1];
    predictJoints(motion, ahead, joints);
    robot_->tree.poses(state.positions, X_RL);
    const RobotMotion step(robot_->tree, robot_->bodies, states[i], state);
    const auto variances =
        Eigen::Map<const Eigen::VectorXd>(joints.variances.data(), static_cast<Eigen::Index>(joints.variances.size()));
    for (size_t body = 0; body < robot_->bodies.size(); ++body) {
      const size_t link = robot_->bodies[body].link;
      geometricJacobian(robot_->tree, X_RL, link, J_R);
      const Jacobian J_W = turnedJacobian(J_R, state.X_WR.linear());
      PredictedPose pose{ahead, state.X_WR * poseOf(link, X_RL)};
      pose.covariance = carried(covariance, pose.X_WT.translation() - X_WT.translation());
      pose.covariance += J_W * variances.asDiagonal() * J_W.transpose();
      pose.covariance.diagonal().head<3>().array() += curvatureVariance(J_R, joints.variances);
      pose.deviation_bound = step.deviationBound(body, 1);
      motion.body_paths[body].push_back(pose);
    }
  }
}

void MotionPredictor::restart() {
  tool_.restart();
  if (joints_) joints_->restart();
}

}  // namespace sweep_guard_core
