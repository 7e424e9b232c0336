// Searches on random arms.
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <limits>

#include "allocations.h"
#include "motion/random_arms.h"
#include "motion/random_scenes.h"

namespace sweep_guard_core {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using std::chrono::milliseconds;

// The gap of a ball along the way of the command from a state.
class GapOnTheWay {
 public:
  GapOnTheWay(const ArmCase& arm, const RobotState& from, const SeparatingPlane& plane, size_t ball)
      : arm_(arm), from_(from), plane_(plane), ball_(ball) {}

  double at(double way) const {
    const Vector3d center_W = centerOf(arm_, after(from_, arm_.command.velocities, way), plane_.piece, ball_);
    return plane_.normal_W.dot(center_W - plane_.point_W) - arm_.inputs.tool->pieces[plane_.piece][ball_].radius;
  }
  // Returns whether no gap on the way is below the standoff and what the surface comes nearer, or below what it is now.
  bool lasts(double whole_way, const StopOnPath& stop, double tolerance) const {
    constexpr int kSamples = 50;
    for (int i = 0; i <= kSamples; ++i) {
      const double way = whole_way * i / kSamples;
      const double comes = std::max(0.0, plane_.surface_speed) * stop.untilRest(stop.share(way));
      if (at(way) < std::min(at(0.0), 0.002 + comes) - tolerance) return false;
    }
    return true;
  }

 private:
  const ArmCase& arm_;
  const RobotState& from_;
  const SeparatingPlane& plane_;
  size_t ball_;
};

// Returns how an arm comes to rest from a share of its command whose fastest point on the way brakes at the deceleration.
StopOnPath stopFrom(const ArmCase& arm, const RobotState& from, double fastest, const BrakingLimits& limits,
                    double share) {
  MovingTool tool(arm.tree);
  StopOnPath stop{limits.reaction_time, fastest / limits.deceleration};
  for (double way = 0.0; way < stop.way(share) && way < 10.0; way += 0.01 * stop.way(share)) {
    tool.place(after(from, arm.command.velocities, way), *arm.inputs.tool, arm.command.velocities);
    stop.braking_time = std::max(stop.braking_time, tool.fastest() / limits.deceleration);
  }
  return stop;
}

bool everyGapLasts(const ArmCase& arm, const RobotState& from, double way, const StopOnPath& stop, double tolerance) {
  const auto& planes = arm.inputs.planes->planes;
  return std::all_of(planes.begin(), planes.end(), [&](const SeparatingPlane& plane) {
    for (size_t i = 0; i < arm.inputs.tool->pieces[plane.piece].size(); ++i) {
      if (!GapOnTheWay(arm, from, plane, i).lasts(way, stop, tolerance)) return false;
    }
    return true;
  });
}

// Returns whether no gap shrinks on the way, and each that changes grows by at least a hundredth of its ball's way.
bool leadsAway(const ArmCase& arm, double whole_way) {
  constexpr int kSamples = 50;
  for (const SeparatingPlane& plane : arm.inputs.planes->planes) {
    for (size_t i = 0; i < arm.inputs.tool->pieces[plane.piece].size(); ++i) {
      const GapOnTheWay gap(arm, arm.joints.state, plane, i);
      const auto center = [&](double way) {
        return centerOf(arm, after(arm.joints.state, arm.command.velocities, way), plane.piece, i);
      };
      for (int j = 0; j < kSamples; ++j) {
        const double from = whole_way * j / kSamples;
        const double to = whole_way * (j + 1) / kSamples;
        if (gap.at(to) - gap.at(from) < 0.01 * (center(to) - center(from)).norm() - 1e-15) return false;
      }
    }
  }
  return true;
}

TEST(JointMotionGuardSearchTest, EveryGapLastsUntilTheRobotIsAtRestAndTheScaleIsHardlySmallerThanNeeded) {
  Random random(91);
  int limited = 0;
  int whole = 0;
  int too_small = 0;
  MotionGuardOptions options;
  options.dead_time = milliseconds(30);
  for (std::uint64_t i = 0; i < caseCount(1'000); ++i) {
    ArmCase arm = randomArm(random, random.below(6));
    if (random.chance(0.2)) editable(arm).uncovered.distance = random.uniform(0.0, 0.5);
    JointMotionGuard guard(options, arm.tree);
    ArmCase before = arm;
    before.command.velocities = velocitiesOf(*arm.tree, random, 0.3);
    const double sent = guard.guard(before.inputs, before.joints, before.command, at(1000)).scale;
    const double scale = guard.guard(arm.inputs, arm.joints, arm.command, at(1010)).scale;
    ASSERT_GE(scale, 0.0);
    ASSERT_LE(scale, 1.0);
    const BrakingLimits limits{1.0, 0.05, 0.002, 0.0};
    const RobotState expected = after(arm.joints.state, before.command.velocities, 0.01 * sent);
    MovingTool swept(arm.tree);
    swept.place(arm.joints.state, *arm.inputs.tool, arm.command.velocities);
    MovingTool tool(arm.tree);
    tool.place(expected, *arm.inputs.tool, arm.command.velocities);
    const double at_first = std::max(swept.fastest(), tool.fastest());
    StopOnPath stop = stopFrom(arm, expected, at_first, limits, scale);
    stop.braking_time /= 1.01;  // the guard knows the speed on the way as exactly
    const double more = std::min(1.0, 1.1 * scale + 0.01);
    const StopOnPath longer = stopFrom(arm, expected, at_first, limits, more);
    bool more_is_too_much = scale == 1.0;
    for (const RobotState& state : {arm.joints.state, expected}) {
      EXPECT_TRUE(everyGapLasts(arm, state, stop.way(scale), stop, 1e-9)) << i << ": " << scale;
      more_is_too_much = more_is_too_much || !everyGapLasts(arm, state, longer.way(more), longer, -1e-4);
    }
    UncoveredSurfaces uncovered = arm.inputs.planes->uncovered;
    uncovered.distance -= tool.largestDisplacement(swept, *arm.inputs.tool);
    const double allowed = allowedSpeed(uncovered, limits) / limits.deceleration;
    EXPECT_LE(scale * stop.braking_time, allowed + 1e-9);
    more_is_too_much = more_is_too_much || more * longer.braking_time > allowed;
    too_small += more_is_too_much ? 0 : 1;
    ++(scale == 1.0 ? whole : limited);
  }
  RecordProperty("limited", limited);
  RecordProperty("too_small", too_small);
  EXPECT_GT(limited, 100);
  EXPECT_GT(whole, 100);
  EXPECT_LE(too_small, limited / 20);
}

TEST(JointMotionGuardSearchTest, FreeMotionIsPassedOnBitForBit) {
  Random random(92);
  for (int i = 0; i < 1000; ++i) {
    ArmCase arm = randomArm(random, 6, 10.0, 20.0);
    arm.command.velocities *= 0.3;
    EXPECT_EQ(guardOnce(arm).scale, 1.0) << i;
  }
}

TEST(JointMotionGuardSearchTest, ARetreatIsPassedOnBitForBitAtAnyGap) {
  Random random(93);
  int retreats = 0;
  while (retreats < 1000) {
    ArmCase arm = randomArm(random, 1 + random.below(2), -0.02, 0.02);
    for (int sign = 0; sign < 2; ++sign) {
      arm.command.velocities *= -1.0;
      MovingTool tool(arm.tree);
      tool.place(arm.joints.state, *arm.inputs.tool, arm.command.velocities);
      const StopOnPath stop = stopFrom(arm, arm.joints.state, tool.fastest(), {1.0, 0.01, 0.002, 0.0}, 1.0);
      if (!leadsAway(arm, 1.05 * stop.way(1.0))) continue;
      EXPECT_EQ(guardOnce(arm).scale, 1.0);
      ++retreats;
    }
  }
}

TEST(JointMotionGuardSearchTest, IsContinuousInTheCommand) {
  Random random(94);
  int compared = 0;
  for (std::uint64_t i = 0; i < caseCount(2'000); ++i) {
    ArmCase arm = randomArm(random, 4, 0.005, 0.2);
    const double before = guardOnce(arm).scale;
    arm.command.velocities += 1e-9 * velocitiesOf(*arm.tree, random, 1.0);
    EXPECT_NEAR(guardOnce(arm).scale, before, 1e-4) << i;
    compared += before < 1.0 ? 1 : 0;
  }
  EXPECT_GT(compared, 100);
}

TEST(JointMotionGuardSearchTest, OlderPlanesSlowDownMore) {
  Random random(95);
  int slower = 0;
  for (int i = 0; i < 500; ++i) {
    ArmCase arm = randomArm(random, 4, 0.005, 0.1);
    const double fresh = guardOnce(arm).scale;
    editable(arm).timestamps = received(950);
    const double old = guardOnce(arm).scale;
    EXPECT_LE(old, fresh);
    if (fresh < 1.0 && old < fresh) ++slower;
  }
  EXPECT_GT(slower, 50);
}

TEST(JointMotionGuardSearchTest, AllocatesNothing) {
  Random random(96);
  MotionGuardOptions options;
  options.escape_speed = 0.01;
  for (int i = 0; i < 50; ++i) {
    ArmCase arm = randomArm(random, 64, 0.0, 0.5);
    if (i % 3 == 0) arm.inputs.warning->level = WarningLevel::kUnknown;
    JointMotionGuard guard(options, arm.tree);
    guard.guard(arm.inputs, arm.joints, arm.command, at(1000));
    const Allocations allocations;
    for (int ms = 1001; ms < 1010; ++ms) guard.guard(arm.inputs, arm.joints, arm.command, at(ms));
    guard.stop(at(1010).steady);
    EXPECT_EQ(allocations.count(), 0U) << allocations.stacks();
  }
}

// A robot that follows commands after a dead time and with a first-order lag, and brakes no harder than the guard counts on.
class LaggingArm {
 public:
  LaggingArm(const ArmCase& arm, int dead_time_ms, int lag_ms, double deceleration)
      : state_(arm.joints.state),
        lag_ms_(lag_ms),
        deceleration_(deceleration),
        tool_(arm.inputs.tool),
        robot_(arm.tree),
        followed_(VectorXd::Zero(size())),
        velocity_(followed_) {
    for (int i = 0; i < dead_time_ms; ++i) sent_.emplace_back(VectorXd::Zero(size()));
  }

  const RobotState& state() const { return state_; }
  const RobotState& measured(int age_ms) const {
    return age_ms < static_cast<int>(past_.size()) ? *(past_.rbegin() + age_ms) : past_.front();
  }
  void step(const VectorXd& command) {
    past_.push_back(state_);
    sent_.push_back(command);
    followed_ += (sent_.front() - followed_) / std::max(1, lag_ms_);
    sent_.pop_front();
    velocity_ = changed(robot_, state_, *tool_, deceleration_, velocity_, followed_);
    state_ = after(state_, velocity_, 1e-3);
  }

 private:
  Eigen::Index size() const { return static_cast<Eigen::Index>(state_.positions.size()); }

  RobotState state_;
  int lag_ms_;
  double deceleration_;
  std::shared_ptr<const ToolBalls> tool_;
  MovingTool robot_;
  VectorXd followed_;  // without the limit of braking
  VectorXd velocity_;
  std::deque<VectorXd> sent_;
  std::vector<RobotState> past_;
};

double leastGap(const ArmCase& arm, const RobotState& state) {
  double least = std::numeric_limits<double>::infinity();
  for (const SeparatingPlane& plane : arm.inputs.planes->planes) {
    const auto& balls = arm.inputs.tool->pieces[plane.piece];
    for (size_t i = 0; i < balls.size(); ++i) {
      const Vector3d from_plane = centerOf(arm, state, plane.piece, i) - plane.point_W;
      least = std::min(least, plane.normal_W.dot(from_plane) - balls[i].radius);
    }
  }
  return least;
}

// Returns the least gap of an arm in 2 s. Planes and positions are 10 ms old.
double leastGapInALoop(ArmCase& arm, const MotionGuardOptions& options) {
  const auto ms = [](Duration duration) { return static_cast<int>(std::lround(1e3 * toSeconds(duration))); };
  JointMotionGuard guard(options, arm.tree);
  LaggingArm robot(arm, ms(options.dead_time), ms(options.time_constant), options.deceleration);
  robot.step(VectorXd::Zero(arm.command.velocities.size()));
  VectorXd output;
  double least = leastGap(arm, robot.state());
  for (int ms = 0; ms < 2000; ++ms) {
    if (ms % 10 == 0) {
      arm.joints = {robot.measured(10), received(ms - 10)};
      editable(arm).timestamps = received(ms - 10);
      editable(arm).valid_until = at(ms + 100).stamp;
      arm.inputs.warning->received = at(ms).steady;
      arm.command.timestamps = received(ms);
      output = guard.guard(arm.inputs, arm.joints, arm.command, at(ms)).scale * arm.command.velocities;
    }
    robot.step(output);
    if (ms % 5 == 4) least = std::min(least, leastGap(arm, robot.state()));
  }
  return least;
}

TEST(JointMotionGuardSearchTest, AnArmWithDelaysAndLimitedBrakingDoesNotPassTheStandoff) {
  Random random(97);
  int came = 0;
  for (std::uint64_t i = 0; i < caseCount(40); ++i) {
    ArmCase arm = randomArm(random, 3, 0.003, 0.2);
    for (SeparatingPlane& plane : editable(arm).planes) plane.surface_speed = 0.0;
    MotionGuardOptions options;
    options.dead_time = milliseconds(random.below(50));
    options.time_constant = milliseconds(random.below(50));
    options.deceleration = random.logUniform(0.5, 5.0);
    const double least = leastGapInALoop(arm, options);
    EXPECT_GT(least, options.standoff - 1e-6) << i << ": " << toSeconds(options.dead_time) << " s, "
                                              << toSeconds(options.time_constant) << " s, " << options.deceleration;
    came += least < options.standoff + 0.002 ? 1 : 0;
  }
  EXPECT_GT(came, 5);
}

// The tip turns nine times as fast as the joint that is commanded, in the other sense, so that its speed changes on the way.
TEST(JointMotionGuardSearchTest, SpeedsOnTheWayAreSampledByTheTurnsOfJointsThatMimic) {
  TreeLink arm_link;
  arm_link.name = "arm";
  arm_link.joint = "arm_joint";
  arm_link.type = JointType::kRevolute;
  TreeLink tip = arm_link;
  tip.name = "tip";
  tip.joint = "tip_joint";
  tip.multiplier = -10.0;
  tip.parent = 0;
  tip.X_PJ.translation().x() = 0.9;
  ArmCase arm;
  arm.tree = std::make_shared<const KinematicTree>(KinematicTree({JointVariable{"arm_joint"}}, {arm_link, tip}));
  arm.inputs.tool = std::make_shared<const ToolBalls>(ToolBalls{1, {{{0.1 * Vector3d::UnitX(), 0.0}}}, {"tip"}});
  arm.inputs.warning = MotionInputs::GuardWarning{WarningLevel::kClear, 0, at(1000).steady};
  const double allowed = stoppingSpeed(0.05, {1.0, 0.01, 0.002, 0.0});
  for (double speed = 0.3; speed < 1.5; speed += 0.1) {
    for (double first = 0.0; first < 0.6; first += 0.1) {
      arm.joints = {{Eigen::Isometry3d::Identity(), {first}}, received(1000)};
      arm.command = {Eigen::VectorXd::Constant(1, speed), received(1000), milliseconds(10)};
      PlaneSet planes{received(1000), at(1150).stamp, true, 1, {}, {0.052, 0.0}, {}, {"arm_joint"}, {first}};
      planes.X_WT = Eigen::Isometry3d::Identity();
      arm.inputs.planes = std::make_shared<const PlaneSet>(planes);
      const StopOnPath stop = stopFrom(arm, arm.joints.state, 0.0, {1.0, 0.01, 0.002, 0.0}, 1.0);
      EXPECT_LE(guardOnce(arm).scale * stop.braking_time, 1.02 * allowed) << speed << " rad/s, " << first << " rad";
    }
  }
}

// A turntable that carries a slide outwards, before a wall: the ball on it is the faster, the farther out it is.
TEST(JointMotionGuardSearchTest, AnArmThatUnfoldsBrakesByTheSpeedsOnItsWay) {
  TreeLink table;
  table.name = "table";
  table.joint = "table_joint";
  table.type = JointType::kRevolute;
  TreeLink slide;
  slide.name = "slide";
  slide.joint = "slide_joint";
  slide.type = JointType::kPrismatic;
  slide.axis_J = Vector3d::UnitX();
  slide.parent = 0;
  slide.variable = 1;
  for (const double outwards : {0.25, 0.5}) {
    ArmCase arm;
    arm.tree = std::make_shared<const KinematicTree>(
        KinematicTree({JointVariable{"table_joint"}, JointVariable{"slide_joint"}}, {table, slide}));
    arm.joints = {{Eigen::Isometry3d::Identity(), {0.0, 0.2}}, received(1000)};
    arm.command = {Eigen::Vector2d(1.0, outwards), received(1000), milliseconds(10)};
    arm.inputs.tool = std::make_shared<const ToolBalls>(ToolBalls{1, {{{Vector3d::Zero(), 0.0}}}, {"slide"}});
    PlaneSet planes{received(1000), at(1150).stamp, true, 1, {}, {}, {}, {"table_joint", "slide_joint"}, {0.0, 0.2}};
    planes.X_WT = Eigen::Isometry3d::Identity();
    planes.planes.push_back({0, -Vector3d::UnitY(), 0.3 * Vector3d::UnitY(), 0.3, 0.0});
    arm.inputs.planes = std::make_shared<const PlaneSet>(planes);
    arm.inputs.warning = MotionInputs::GuardWarning{WarningLevel::kClear, 0, at(1000).steady};
    EXPECT_GT(leastGapInALoop(arm, {}), 0.0015) << outwards << " m/s";
  }
}

}  // namespace
}  // namespace sweep_guard_core
