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
constexpr double kLeastStep = 1e-4;       // of the way so far
constexpr double kLeastWay = 1e-6;        // of all of it
constexpr size_t kMostSamples = 64;       // of the speeds on that way
constexpr double kLeastSample = 0.02;     // between two of them, of the way
constexpr double kMostSample = 0.25;
constexpr double kSampledAngle = 0.3;  // by all joints together [rad]

void requireUsableCommand(const JointCommand& command, const RobotState& state, size_t variables) {
  const std::vector<double>& positions = state.positions;
  const auto& velocities = command.velocities;
  if (static_cast<size_t>(velocities.size()) != variables || !(velocities.array().abs() <= kMaxJointSpeed).all())
    throw InvalidInput("commanded joint velocities refused: each joint needs one that is finite and within 1e6");
  const auto finite = [](double position) { return std::isfinite(position); };
  const bool complete = positions.empty() || positions.size() == variables;
  if (!complete || !std::all_of(positions.begin(), positions.end(), finite))
    throw InvalidInput("joint positions refused: each joint needs one that is finite");
  if (!positions.empty() && !state.X_WR.matrix().allFinite())
    throw InvalidInput("pose of the robot's root refused: it is not finite");
}

const double* sweptPosition(const PlaneSet& planes, const JointVariable& joint) {
  const auto found = std::find(planes.joints.begin(), planes.joints.end(), joint.name);
  const auto index = static_cast<size_t>(found - planes.joints.begin());
  return index < planes.positions.size() ? &planes.positions[index] : nullptr;
}

template <typename Visit>
void forEachMovingBall(const PlaneSet& planes, const ToolBalls& tool, const MovingTool& state, const Visit& visit) {
  for (size_t i = 0; i < planes.planes.size(); ++i) {
    const size_t piece = planes.planes[i].piece;
    const size_t first = state.pieces()[piece].first_ball;
    for (size_t ball = first; ball < first + tool.pieces[piece].size(); ++ball) {
      const MovingTool::Ball& moving = state.balls()[ball];
      if (moving.speed > 0.0 || moving.acceleration > 0.0) visit(i, ball);
    }
  }
}

double gapOf(const SeparatingPlane& plane, const MovingTool::Ball& ball) {
  return plane.normal_W.dot(ball.center_W - plane.point_W) - ball.radius;
}

double closingOf(const SeparatingPlane& plane, const MovingTool::Ball& ball) { return -plane.normal_W.dot(ball.v_W); }

// What a gap must keep on the way of a command until rest [m], and how fast its surface uses up what it has more, as seen along
// that way [m/s]. A ball that comes no nearer than it is keeps its gap, whatever its surface does.
struct KeptGap {
  KeptGap(const SeparatingPlane& plane, double first_gap, double until_rest, const BrakingLimits& limits,
          const StopOnPath& stop) {
    const double surface = std::max(0.0, plane.surface_speed);
    gap = std::min(first_gap, limits.standoff + surface * until_rest);
    coming = gap < first_gap ? surface * stop.braking_time / until_rest : 0.0;
  }
  double gap;
  double coming;
};

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
  rows_.reserve(kRows);
  pieces_.reserve(kRows);
  stops_.reserve(kMostSamples);
}

GuardedMotion JointMotionGuard::guard(const MotionInputs& inputs, const MeasuredJoints& joints,
                                      const JointCommand& command, const Instant& now) {
  requireUsableCommand(command, joints.state, tree_->variables().size());
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
  requireUsable(*inputs.planes);
  for (const SeparatingPlane& plane : inputs.planes->planes) {
    const auto first = swept_.balls().begin() + static_cast<std::ptrdiff_t>(swept_.pieces()[plane.piece].first_ball);
    const auto end = first + static_cast<std::ptrdiff_t>(inputs.tool->pieces[plane.piece].size());
    const auto farther = [&](const MovingTool::Ball& ball) { return gapOf(plane, ball) > plane.gap + kAgreement; };
    if (std::all_of(first, end, farther))
      throw InvalidInput("links are not where the guard has them: give both the same robot description and tool_frame");
  }
}

void JointMotionGuard::limit(const MotionInputs& inputs, const MeasuredJoints& joints, const JointCommand& command,
                             const BrakingLimits& limits, GuardedMotion& motion) {
  double allowed = allowedSpeed(uncovered(inputs), limits);
  sampleSpeeds(inputs, command, limits);
  const auto& [stop, way] = stops_.back();
  const double fastest = stop.braking_time * limits.deceleration;
  const bool escapes = motion.decision.permission == Permission::kEscape;
  if (escapes) allowed = std::min(allowed, options_.escape_speed);
  if (motion.decision.cause == PermissionCause::kUnseen) allowed = std::min(allowed, options_.unseen_speed);
  motion.scale = std::min(fastest > allowed ? allowed / fastest : 1.0, way < stop.way(1.0) ? shareWithin(way) : 1.0);

  const auto limit_from = [&](const RobotState& from, MovingTool& tool) {
    const auto [time, row] = lasting(inputs, from, tool, command, limits, motion.scale);
    if (!row) return;
    const SeparatingPlane& plane = inputs.planes->planes[row->plane];
    motion.scale = std::min(motion.scale, shareWithin(time));
    const double closing = std::max(0.0, closingOf(plane, tool.balls()[row->ball]));
    motion.limiting = GuardedMotion::Limiting{row->plane, plane.normal_W, row->first_gap, motion.scale * closing};
  };
  limit_from(expected_state_, expected_);
  limit_from(joints.state, measured_);
  if (escapes) stopUnlessEveryGapOpens(inputs, command, motion);
  motion.sent_speed = motion.scale * motion.commanded_speed;
}

// What unfolds becomes faster on its way, and braking takes as long as its fastest point there needs. Between two samples that is
// faster than in both by the square of the angle between them / 8 at most, as far as its jerk is its speed times the square of the
// turn rates: a hundredth.
void JointMotionGuard::sampleSpeeds(const MotionInputs& inputs, const JointCommand& command,
                                    const BrakingLimits& limits) {
  double turn_rate = 0.0;
  for (const TreeLink& joint : tree_->links()) {
    if (joint.moves())
      turn_rate += std::abs(joint.multiplier * command.velocities[static_cast<Eigen::Index>(joint.variable)]);
  }
  stops_.assign(
      1, {{limits.reaction_time, std::max(measured_.fastest(), expected_.fastest()) / limits.deceleration}, 0.0});
  while (stops_.size() < kMostSamples && stops_.back().way < stops_.back().stop.way(1.0)) {
    Sample sample = stops_.back();
    const double whole_way = sample.stop.way(1.0);
    const double left = std::max(whole_way - sample.way, kLeastSample * whole_way);
    sample.way += std::min({left, kMostSample * whole_way, kSampledAngle / turn_rate});
    moveOn(expected_state_, command, sample.way);
    swept_.place(later_state_, *inputs.tool, command.velocities);
    sample.stop.braking_time = std::max(sample.stop.braking_time, swept_.fastest() / limits.deceleration);
    stops_.push_back(sample);
  }
}

// Returns the largest share of a command that is at rest within a way.
double JointMotionGuard::shareWithin(double way) const {
  double share = 0.0;
  for (const Sample& sample : stops_) {
    share = std::max(share, sample.stop.share(std::min(sample.way, way)));
    if (sample.way >= way) break;
  }
  return share;
}

// Planes are carried by the newest state. A distance as a whole cannot be: any point may have come nearer.
UncoveredSurfaces JointMotionGuard::uncovered(const MotionInputs& inputs) const {
  UncoveredSurfaces uncovered = inputs.planes->uncovered;
  uncovered.distance -= std::max(measured_.largestDisplacement(swept_, *inputs.tool),
                                 expected_.largestDisplacement(swept_, *inputs.tool));
  return uncovered;
}

// By conservative advancement [Mirtich 1996]: from where each gap lasts for sure, the next step begins. What lasts to the end is
// seen no more.
JointMotionGuard::Lasting JointMotionGuard::lasting(const MotionInputs& inputs, const RobotState& from,
                                                    MovingTool& tool, const JointCommand& command,
                                                    const BrakingLimits& limits, double scale) {
  const StopOnPath& stop = stops_.back().stop;
  const double way = stop.way(scale);
  const double tolerance = kJointRounding * stop.braking_time * limits.deceleration;
  tool.boundAccelerations(*inputs.tool, command.velocities, way);
  collectRows(inputs, tool, limits, stop, way);
  Lasting lasts{0.0, {}};
  for (int step = 0; step < kMostSteps; ++step) {
    if (step > 0) moveRowsOn(inputs, from, command, lasts.time);
    const double left = way - lasts.time;
    const double until_rest = stop.untilRest(stop.share(lasts.time));
    double least = left;
    const auto lasts_to_the_end = [&](const Row& row) {
      const KeptGap kept(inputs.planes->planes[row.plane], row.first_gap, until_rest, limits, stop);
      const double closing = row.closing + kept.coming;
      const double time = timeUntilClosed(std::max(0.0, row.gap - kept.gap),
                                          std::abs(closing) > tolerance ? closing : 0.0, row.acceleration);
      if (time >= left) return true;
      if (time < least) lasts.row = row;
      least = std::min(least, time);
      return false;
    };
    rows_.erase(std::remove_if(rows_.begin(), rows_.end(), lasts_to_the_end), rows_.end());
    if (rows_.empty()) return {way, {}};
    lasts.time += least;
    if (least < kLeastStep * std::max(lasts.time, kLeastWay * way) && lasts.row->closing > -tolerance) break;
  }
  return lasts;
}

// Without those that no motion at their speed brings near their planes on the way.
void JointMotionGuard::collectRows(const MotionInputs& inputs, const MovingTool& state, const BrakingLimits& limits,
                                   const StopOnPath& stop, double way) {
  rows_.clear();
  const double until_rest = stop.untilRest(stop.share(way));
  forEachMovingBall(*inputs.planes, *inputs.tool, state, [&](size_t plane_index, size_t ball_index) {
    const SeparatingPlane& plane = inputs.planes->planes[plane_index];
    const MovingTool::Ball& ball = state.balls()[ball_index];
    const double gap = gapOf(plane, ball);
    const double travel = (ball.speed + 0.5 * ball.acceleration * way) * way;
    if (gap - limits.standoff - std::max(0.0, plane.surface_speed) * until_rest > travel) return;
    rows_.push_back({plane_index, ball_index, gap, gap, closingOf(plane, ball), ball.acceleration});
  });
}

void JointMotionGuard::moveOn(const RobotState& from, const JointCommand& command, double way) {
  later_state_ = from;
  Eigen::Map<Eigen::VectorXd>(later_state_.positions.data(), command.velocities.size()) += way * command.velocities;
}

void JointMotionGuard::moveRowsOn(const MotionInputs& inputs, const RobotState& from, const JointCommand& command,
                                  double way) {
  const auto& planes = inputs.planes->planes;
  moveOn(from, command, way);
  pieces_.clear();
  for (const Row& row : rows_) {
    const size_t piece = planes[row.plane].piece;
    if (std::find(pieces_.begin(), pieces_.end(), piece) == pieces_.end()) pieces_.push_back(piece);
  }
  swept_.placeAgain(later_state_, *inputs.tool, command.velocities, pieces_);
  for (Row& row : rows_) {
    row.gap = gapOf(planes[row.plane], swept_.balls()[row.ball]);
    row.closing = closingOf(planes[row.plane], swept_.balls()[row.ball]);
  }
}

void JointMotionGuard::stopUnlessEveryGapOpens(const MotionInputs& inputs, const JointCommand& command,
                                               GuardedMotion& motion) {
  const StopOnPath& stop = stops_.back().stop;
  const double scale = motion.scale;
  for (MovingTool* const state : {&expected_, &measured_}) {
    state->boundAccelerations(*inputs.tool, command.velocities, stop.way(scale));
    forEachMovingBall(*inputs.planes, *inputs.tool, *state, [&](size_t plane_index, size_t ball_index) {
      const SeparatingPlane& plane = inputs.planes->planes[plane_index];
      const MovingTool::Ball& ball = state->balls()[ball_index];
      if (motion.scale == 0.0 || opens(plane.surface_speed, closingOf(plane, ball), ball.acceleration, stop, scale))
        return;
      motion.scale = 0.0;
      motion.limiting = GuardedMotion::Limiting{plane_index, plane.normal_W, gapOf(plane, ball), 0.0};
    });
  }
}

}  // namespace sweep_guard_core
