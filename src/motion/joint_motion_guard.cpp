#include "sweep_guard/motion/joint_motion_guard.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr size_t kRows = 8192;            // before buffers grow
constexpr double kMaxJointSpeed = 1e6;    // of a command [rad/s], [m/s]
constexpr double kAgreement = 1e-3;       // of the guard's robot and this one [m]
constexpr double kJointRounding = 1e-11;  // of a closing speed, in commanded speeds of the fastest tool point
constexpr int kMostSteps = 32;            // along the way of a command
constexpr double kLeastStep = 1e-4;       // of the way

void requireUsableCommand(const JointCommand& command, const std::vector<double>& positions, size_t variables) {
  const auto& velocities = command.velocities;
  if (static_cast<size_t>(velocities.size()) != variables || !(velocities.array().abs() <= kMaxJointSpeed).all())
    throw InvalidInput("commanded joint velocities refused: each joint needs one that is finite and within 1e6");
  const auto finite = [](double position) { return std::isfinite(position); };
  const bool complete = positions.empty() || positions.size() == variables;
  if (!complete || !std::all_of(positions.begin(), positions.end(), finite))
    throw InvalidInput("joint positions refused: each joint needs one that is finite");
}

const double* sweptPosition(const PlaneSet& planes, const JointVariable& joint) {
  const auto found = std::find(planes.joints.begin(), planes.joints.end(), joint.name);
  const auto index = static_cast<size_t>(found - planes.joints.begin());
  return index < planes.positions.size() ? &planes.positions[index] : nullptr;
}

PermissionCause ofJoints(PermissionCause cause) {
  if (cause == PermissionCause::kNoPose) return PermissionCause::kNoJoints;
  if (cause == PermissionCause::kPoseSilent) return PermissionCause::kJointsSilent;
  return cause == PermissionCause::kOldPose ? PermissionCause::kOldJoints : cause;
}

}  // namespace

JointMotionGuard::JointMotionGuard(const MotionGuardOptions& options, std::shared_ptr<const KinematicTree> tree)
    : options_(options),
      tree_(std::move(tree)),
      in_flight_(tree_->variables().size()),
      velocities_(static_cast<Eigen::Index>(tree_->variables().size())),
      swept_(tree_),
      measured_(tree_),
      expected_(tree_) {
  requireUsable(options_);
  facing_.reserve(kRows);
  rows_.reserve(kRows);
}

GuardedMotion JointMotionGuard::guard(const MotionInputs& inputs, const MeasuredJoints& joints,
                                      const JointCommand& command, const Instant& now) {
  requireUsableCommand(command, joints.state.positions, tree_->variables().size());
  GuardedMotion motion;
  motion.decision = permission(inputs, joints, command.timestamps, now);
  if (inputs.planes) motion.planes_age = age(inputs.planes->timestamps, now);
  const Duration age_of_inputs = std::max(motion.planes_age, age(joints.timestamps, now));
  const BrakingLimits limits = options_.brakingLimits(command.period, age_of_inputs);
  motion.commanded_speed = command.velocities.isZero(0.0) ? 0.0 : std::numeric_limits<double>::quiet_NaN();
  if (inputs.tool && !joints.state.positions.empty() && hasLinksOf(*tree_, *inputs.tool)) {
    measured_.place(joints.state, *inputs.tool, command.velocities);
    motion.commanded_speed = measured_.fastest();
  }
  if (motion.decision.permission != Permission::kStop) {
    requireGuarded(*inputs.planes, command);
    placeExpectedAndSwept(inputs, joints, command, now);
    limit(inputs, joints, command, limits, motion);
  }
  velocities_ = motion.scale * command.velocities;
  in_flight_.add(velocities_, now.steady);
  return motion;
}

PermissionDecision JointMotionGuard::permission(const MotionInputs& inputs, const MeasuredJoints& joints,
                                                const Timestamps& command, const Instant& now) const {
  MotionInputs placed = inputs;
  placed.pose.reset();
  if (!joints.state.positions.empty()) placed.pose = MotionInputs::ToolPose{joints.state.X_WR, joints.timestamps};
  const PermissionDecision decision = decidePermission(placed, command, now, options_);
  if (decision.cause == PermissionCause::kNoPose && !inputs.planes)
    return {Permission::kStop, PermissionCause::kNoPlanes};
  const bool decided = decision.permission == Permission::kStop && decision.cause != PermissionCause::kNoPose;
  if (decided || !inputs.planes || !inputs.toolIsKnown() || isPlacedBy(*tree_, *inputs.planes, *inputs.tool))
    return {decision.permission, ofJoints(decision.cause)};
  return {Permission::kStop, PermissionCause::kOtherJoints};
}

// One that moves nothing that is guarded may rest anywhere.
void JointMotionGuard::requireGuarded(const PlaneSet& planes, const JointCommand& command) const {
  for (size_t i = 0; i < tree_->variables().size(); ++i) {
    const JointVariable& joint = tree_->variables()[i];
    if (command.velocities[static_cast<Eigen::Index>(i)] == 0.0 || sweptPosition(planes, joint)) continue;
    throw InvalidInput("joint '" + joint.name +
                       "' moves no link of the guard's tool: leave it out, or add its links there");
  }
}

void JointMotionGuard::stop(SteadyTime now) {
  velocities_.setZero();
  in_flight_.add(velocities_, now);
}

void JointMotionGuard::placeExpectedAndSwept(const MotionInputs& inputs, const MeasuredJoints& joints,
                                             const JointCommand& command, const Instant& now) {
  expected_state_ = joints.state;
  in_flight_.addUp(now.steady, age(joints.timestamps, now) + options_.settlingTime(), velocities_);
  Eigen::Map<Eigen::VectorXd>(expected_state_.positions.data(), velocities_.size()) += velocities_;
  expected_.place(expected_state_, *inputs.tool, command.velocities);
  later_state_.X_WR = inputs.planes->X_WT;
  later_state_.positions = joints.state.positions;
  for (size_t i = 0; i < later_state_.positions.size(); ++i) {
    if (const double* const swept = sweptPosition(*inputs.planes, tree_->variables()[i]))
      later_state_.positions[i] = *swept;
  }
  swept_.place(later_state_, *inputs.tool, command.velocities);
  requireAgreement(inputs);
}

// The balls hold the piece, so that none of its planes is farther from the nearest of them.
void JointMotionGuard::requireAgreement(const MotionInputs& inputs) {
  for (const SeparatingPlane& plane : inputs.planes->planes) {
    facing_.clear();
    addFacingBalls(plane, inputs.tool->pieces[plane.piece], swept_.pieces()[plane.piece].X_WL, facing_);
    const auto farther = [&](const FacingBall& ball) { return ball.gap > plane.gap + kAgreement; };
    if (std::all_of(facing_.begin(), facing_.end(), farther))
      throw InvalidInput("links are not where the guard has them: give both the same robot description and tool_frame");
  }
}

void JointMotionGuard::limit(const MotionInputs& inputs, const MeasuredJoints& joints, const JointCommand& command,
                             const BrakingLimits& limits, GuardedMotion& motion) {
  const double fastest = std::max(measured_.fastest(), expected_.fastest());
  double allowed = allowedSpeed(uncovered(inputs), limits);
  const bool escapes = motion.decision.permission == Permission::kEscape;
  if (escapes) allowed = std::min(allowed, options_.escape_speed);
  if (motion.decision.cause == PermissionCause::kUnseen) allowed = std::min(allowed, options_.unseen_speed);
  motion.scale = fastest > allowed ? allowed / fastest : 1.0;

  const StopOnPath stop{limits.reaction_time, fastest / limits.deceleration};
  const auto limit_from = [&](const RobotState& from, MovingTool& tool) {
    const auto [time, row] = lasting(inputs, from, tool, command, limits, stop);
    const double share = row ? stop.share(time) : 1.0;
    if (share >= motion.scale) return;
    motion.scale = share;
    motion.limiting = GuardedMotion::Limiting{row->plane, row->ball.normal_W, row->ball.gap, share * row->closing};
  };
  limit_from(joints.state, measured_);
  limit_from(expected_state_, expected_);
  if (escapes) stopUnlessEveryGapOpens(inputs, command, limits, motion);
  motion.sent_speed = motion.scale * motion.commanded_speed;
}

// Planes are carried by the newest state. A distance as a whole cannot be: any point may have come nearer.
UncoveredSurfaces JointMotionGuard::uncovered(const MotionInputs& inputs) const {
  UncoveredSurfaces uncovered = inputs.planes->uncovered;
  requireUsable(uncovered);
  uncovered.distance -= std::max(measured_.largestDisplacement(swept_, *inputs.tool),
                                 expected_.largestDisplacement(swept_, *inputs.tool));
  return uncovered;
}

void JointMotionGuard::collectRows(const MotionInputs& inputs, const MovingTool& state) {
  for (size_t i = 0; i < inputs.planes->planes.size(); ++i) {
    const SeparatingPlane& plane = inputs.planes->planes[i];
    const MovingTool::Piece& piece = state.pieces()[plane.piece];
    facing_.clear();
    addFacingBalls(plane, inputs.tool->pieces[plane.piece], piece.X_WL, facing_);
    for (size_t j = 0; j < facing_.size(); ++j) {
      requireUsable(facing_[j]);
      const MovingTool::Ball& ball = state.balls()[piece.first_ball + j];
      if (!(ball.speed > 0.0)) continue;
      const double closing = closingSpeed(facing_[j], piece.twist_W);
      rows_.push_back({facing_[j], i, piece.first_ball + j, closing, ball.acceleration, facing_[j].gap, closing});
    }
  }
}

void JointMotionGuard::moveRowsOn(const MotionInputs& inputs, const RobotState& from, double way,
                                  const JointCommand& command) {
  later_state_ = from;
  Eigen::Map<Eigen::VectorXd>(later_state_.positions.data(), command.velocities.size()) += way * command.velocities;
  swept_.place(later_state_, *inputs.tool, command.velocities);
  for (Row& row : rows_) {
    const SeparatingPlane& plane = inputs.planes->planes[row.plane];
    const MovingTool::Piece& piece = swept_.pieces()[plane.piece];
    const Eigen::Vector3d& center_W = swept_.balls()[row.index].center_W;
    const double radius = inputs.tool->pieces[plane.piece][row.index - piece.first_ball].radius;
    row.later_gap = plane.normal_W.dot(center_W - plane.point_W) - radius;
    row.later_closing = -plane.normal_W.dot(atPoint(piece.twist_W, center_W - piece.X_WL.translation()).v_W);
  }
}

// By conservative advancement [Mirtich 1996]: from where each gap lasts for sure, the next step begins. What lasts to the end is
// seen no more.
JointMotionGuard::Lasting JointMotionGuard::lasting(const MotionInputs& inputs, const RobotState& from,
                                                    MovingTool& tool, const JointCommand& command,
                                                    const BrakingLimits& limits, const StopOnPath& stop) {
  const double whole_way = stop.way(1.0);
  tool.boundAccelerations(*inputs.tool, command.velocities, whole_way);
  rows_.clear();
  collectRows(inputs, tool);
  Lasting lasts{0.0, {}};
  for (int step = 0; step < kMostSteps; ++step) {
    if (step > 0) moveRowsOn(inputs, from, lasts.time, command);
    double least = whole_way - lasts.time;
    const auto lasts_to_the_end = [&](const Row& row) {
      const double time = timeUntilClosed(row, lasts.time, limits, stop);
      if (time >= whole_way - lasts.time) return true;
      if (time < least) lasts.row = row;
      least = std::min(least, time);
      return false;
    };
    rows_.erase(std::remove_if(rows_.begin(), rows_.end(), lasts_to_the_end), rows_.end());
    if (rows_.empty()) return {whole_way, {}};
    lasts.time += least;
    if (least < kLeastStep * whole_way && lasts.row->later_closing > 0.0) break;
  }
  return lasts;
}

// A ball that comes no nearer than it is keeps its gap, whatever its surface does.
double JointMotionGuard::timeUntilClosed(const Row& row, double way, const BrakingLimits& limits,
                                         const StopOnPath& stop) const {
  const double until_rest = stop.untilRest(stop.share(way));
  const double surface = std::max(0.0, row.ball.surface_speed);
  const double kept = std::min(row.ball.gap, limits.standoff + surface * until_rest);
  const double coming = kept < row.ball.gap ? surface * stop.braking_time / until_rest : 0.0;
  const double closing = row.later_closing + coming;
  const double tolerance = kJointRounding * stop.braking_time * limits.deceleration;
  return sweep_guard_core::timeUntilClosed(std::max(0.0, row.later_gap - kept),
                                           std::abs(closing) > tolerance ? closing : 0.0, row.acceleration);
}

void JointMotionGuard::stopUnlessEveryGapOpens(const MotionInputs& inputs, const JointCommand& command,
                                               const BrakingLimits& limits, GuardedMotion& motion) {
  rows_.clear();
  for (MovingTool* const state : {&measured_, &expected_}) {
    state->boundAccelerations(*inputs.tool, command.velocities, limits.reaction_time);
    collectRows(inputs, *state);
  }
  const double scale = motion.scale;
  const auto closes = std::find_if(rows_.begin(), rows_.end(), [&](const Row& row) {
    return !opens(row.ball, scale * row.closing, scale * scale * row.acceleration, limits);
  });
  if (closes == rows_.end()) return;
  motion.scale = 0.0;
  motion.limiting = GuardedMotion::Limiting{closes->plane, closes->ball.normal_W, closes->ball.gap, 0.0};
}

}  // namespace sweep_guard_core
