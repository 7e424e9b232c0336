#include "sweep_guard/motion/motion_guard.h"

#include <gtest/gtest.h>

#include <limits>

#include "allocations.h"
#include "motion/floor.h"
#include "motion/random_scenes.h"
#include "motion/times.h"
#include "refusal.h"
#include "scenes.h"
#include "sweep_guard/monitor/reason.h"

namespace sweep_guard_core {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using std::chrono::milliseconds;

// A needle from the origin of the tool frame to 0.1 m along x, 1 mm thick.
std::shared_ptr<const ToolBalls> needle() {
  return std::make_shared<const ToolBalls>(
      ToolBalls{1, {{{Vector3d::Zero(), 0.001}, {Vector3d(0.1, 0.0, 0.0), 0.001}}}});
}

// A wall at x = 0 before which the tool is at x > 0. Its planes were computed when the tool was there.
std::shared_ptr<const PlaneSet> wall(int ms) {
  PlaneSet planes{received(ms), at(ms + 150).stamp, true, 1, {}, {}};
  planes.planes.push_back({0, Vector3d::UnitX(), Vector3d::Zero(), 0.0, 0.0});
  return std::make_shared<const PlaneSet>(planes);
}

MotionInputs inputsAt(int ms, double x) {
  return {wall(ms), needle(), MotionInputs::ToolPose{along(x), received(ms)},
          MotionInputs::GuardWarning{WarningLevel::kClear, 0, at(ms).steady}};
}

// Nothing has a plane; what has none is at this distance from the tool at x.
std::shared_ptr<const PlaneSet> noPlanes(int ms, double x, double distance) {
  PlaneSet planes = *wall(ms);
  planes.planes.clear();
  planes.uncovered = {distance, 0.0};
  planes.X_WT = along(x);
  return std::make_shared<const PlaneSet>(planes);
}

MotionCommand moving(const Vector3d& v_W, int ms, const Vector3d& w_W = Vector3d::Zero()) {
  return {{v_W, w_W}, Vector3d::Zero(), received(ms), milliseconds(10), {}};
}

MotionGuardOptions withEscape() {
  MotionGuardOptions options;
  options.escape_speed = 0.01;
  return options;
}

TEST(MotionGuardTest, FreeMotionIsPassedOnBitForBit) {
  MotionGuard guard({});
  const MotionCommand command = moving({-0.1234567, 0.0531, 0.02}, 1000, {0.1, 0.2, -0.3});
  const GuardedMotion motion = guard.guard(inputsAt(1000, 0.8), command, at(1000));
  EXPECT_TRUE(motion.twist_W == command.twist_W);
  EXPECT_EQ(motion.scale, 1.0);
  EXPECT_FALSE(motion.limiting);
}

TEST(MotionGuardTest, SlowsDownBeforeAPlaneAndNamesIt) {
  MotionGuard guard({});
  const GuardedMotion motion = guard.guard(inputsAt(990, 0.011), moving({-0.5, 0.2, 0.0}, 1000), at(1000));
  // The period and the age of the planes, and 0.2 m/s beside.
  const BrakingLimits limits{1.0, 0.02 + 0.5 * 0.2, 0.002, 0.101};
  EXPECT_NEAR(motion.twist_W.v_W.x(), -stoppingSpeed(0.008, limits), 1e-9);
  EXPECT_NEAR(motion.twist_W.v_W.y(), 0.2, 1e-9);
  ASSERT_TRUE(motion.limiting);
  EXPECT_EQ(motion.limiting->plane, 0U);
  EXPECT_NEAR(motion.limiting->gap, 0.010, 1e-12);
  EXPECT_NEAR(motion.limiting->closing_limit, stoppingSpeed(0.008, limits), 1e-12);
  EXPECT_LT(motion.scale, 1.0);
  EXPECT_EQ(motion.planes_age, milliseconds(10));
}

TEST(MotionGuardTest, WhereNoCameraSeesItGoingTheFastestPointIsSlow) {
  MotionInputs inputs = inputsAt(1000, 0.8);
  inputs.warning = MotionInputs::GuardWarning{WarningLevel::kUnknown, kNotSeen, at(1000).steady};
  MotionGuard guard({});
  const MotionCommand fast = moving({0.0, 0.3, 0.4}, 1000, {0.0, 0.0, 2.0});
  const GuardedMotion motion = guard.guard(inputs, fast, at(1000));
  EXPECT_NEAR(motion.sent_speed, 0.05, 1e-9);
  EXPECT_NEAR(motion.scale, 0.05 / motion.commanded_speed, 1e-9);
  EXPECT_TRUE(motion.twist_W.v_W.isApprox(motion.scale * fast.twist_W.v_W));
  EXPECT_TRUE(motion.twist_W.w_W.isApprox(motion.scale * fast.twist_W.w_W));
  const MotionCommand slow = moving({0.0, 0.03, 0.0}, 1000);
  EXPECT_TRUE(guard.guard(inputs, slow, at(1000)).twist_W == slow.twist_W);
}

TEST(MotionGuardTest, WhereNoCameraSeesItGoingPlanesLimitItToo) {
  MotionInputs inputs = inputsAt(1000, 0.0021);
  inputs.warning = MotionInputs::GuardWarning{WarningLevel::kUnknown, kNotSeen, at(1000).steady};
  const GuardedMotion motion = MotionGuard({}).guard(inputs, moving({-0.5, 0.0, 0.0}, 1000), at(1000));
  EXPECT_LT(motion.sent_speed, 0.01);
  EXPECT_TRUE(motion.limiting);
}

TEST(MotionGuardTest, ARetreatIsPassedOnBitForBitAtAnyGap) {
  for (const double x : {-0.01, 0.0, 0.001, 0.003, 0.01}) {
    MotionGuard guard({});
    const MotionCommand command = moving({0.37, 0.0, 0.0}, 1000);
    EXPECT_TRUE(guard.guard(inputsAt(1000, x), command, at(1000)).twist_W == command.twist_W) << x;
  }
}

TEST(MotionGuardTest, TheRobotsLagCountsAsReactionTime) {
  MotionGuardOptions options;
  options.dead_time = milliseconds(30);
  options.time_constant = milliseconds(40);
  MotionGuard guard(options);
  const GuardedMotion motion = guard.guard(inputsAt(990, 0.011), moving({-0.5, 0.0, 0.0}, 1000), at(1000));
  EXPECT_NEAR(motion.twist_W.v_W.x(), -stoppingSpeed(0.008, {1.0, 0.09, 0.002, 0.101}), 1e-9);
}

TEST(MotionGuardTest, CountsWhatIsInFlight) {
  MotionGuardOptions options;
  options.dead_time = milliseconds(50);
  MotionGuard guard(options);
  const double first = guard.guard(inputsAt(1000, 0.03), moving({-0.2, 0.0, 0.0}, 1000), at(1000)).twist_W.v_W.x();
  double last = first;
  for (int ms = 1010; ms <= 1050; ms += 10) {  // the pose does not show yet what was sent
    last = guard.guard(inputsAt(ms, 0.03), moving({-0.2, 0.0, 0.0}, ms), at(ms)).twist_W.v_W.x();
  }
  EXPECT_LT(first, -0.15);
  EXPECT_GT(last, first + 0.01);
}

TEST(MotionGuardTest, TheRestOfARobotThatFollowsPosesCounts) {
  MotionGuard guard({});
  MotionCommand command = moving({-0.1, 0.0, 0.0}, 1000);
  command.rest_WT = along(0.003);  // at the standoff
  EXPECT_NEAR(guard.guard(inputsAt(1000, 0.5), command, at(1000)).twist_W.v_W.x(), 0.0, 1e-9);
}

TEST(MotionGuardTest, WhatNoPlaneStandsForBoundsTheSpeedAsAWhole) {
  MotionInputs inputs = inputsAt(1000, 0.5);
  inputs.planes = noPlanes(1000, 0.5, 0.05);
  MotionGuard guard({});
  const GuardedMotion motion = guard.guard(inputs, moving({0.0, 1.0, 0.0}, 1000), at(1000));
  EXPECT_NEAR(motion.twist_W.v_W.norm(), stoppingSpeed(0.048, {1.0, 0.01, 0.002, 0.101}), 1e-9);
  EXPECT_FALSE(motion.limiting);
}

TEST(MotionGuardTest, AMotionInFlightBringsWhatNoPlaneStandsForNearer) {
  MotionInputs inputs = inputsAt(1000, 0.5);
  inputs.planes = noPlanes(1000, 0.5, 0.05);
  MotionGuard guard({});
  MotionCommand command = moving({0.0, 1.0, 0.0}, 1000);
  command.rest_WT = along(0.48);
  EXPECT_NEAR(guard.guard(inputs, command, at(1000)).twist_W.v_W.norm(),
              stoppingSpeed(0.028, {1.0, 0.01, 0.002, 0.101}), 1e-9);
}

TEST(MotionGuardTest, WhatNoPlaneStandsForIsNearerSinceThePlanesByTheWayOfTheFarthestToolPoint) {
  MotionInputs inputs = inputsAt(1000, 0.5);
  inputs.pose->X_WT.rotate(Eigen::AngleAxisd(0.3, Vector3d::UnitZ()));
  inputs.planes = noPlanes(1000, 0.52, 0.1);
  MotionGuard guard({});
  MotionCommand command = moving({0.0, 1.0, 0.0}, 1000);
  command.point_T = Vector3d(0.05, 0.0, 0.0);
  const double left = 0.1 - 0.02 - 0.3 * 0.101;
  EXPECT_NEAR(guard.guard(inputs, command, at(1000)).twist_W.v_W.norm(),
              stoppingSpeed(left - 0.002, {1.0, 0.01, 0.002, 0.051}), 1e-9);
}

// Its origin and its tip turn by as much, but not as far.
TEST(MotionGuardTest, WhatNoPlaneStandsForIsAsNearAsTheFarthestPointBringsIt) {
  MotionInputs inputs = inputsAt(1000, 0.5);
  inputs.planes = noPlanes(1000, 0.5, 0.05);
  inputs.tool = std::make_shared<const ToolBalls>(ToolBalls{1, {{{Vector3d(0.5, 0.0, 0.0), 0.0}}}});
  MotionCommand command = moving({0.0, 1.0, 0.0}, 1000);
  command.point_T = Vector3d(0.5, 0.0, 0.0);
  command.rest_WT = inputs.pose->X_WT * Eigen::AngleAxisd(0.1, Vector3d::UnitZ());
  MotionGuard guard({});
  EXPECT_TRUE(isZero(guard.guard(inputs, command, at(1000)).twist_W));
}

// The tool drives at a wall that no plane stands for. The distance is that of a pose which is older than the newest one.
TEST(MotionGuardTest, StopsBeforeWhatNoPlaneStandsForHoweverOldTheDistanceIs) {
  for (const int age_ms : {1, 20, 50, 100}) {
    for (const double deceleration : {1.0, 5.0, 20.0}) {
      MotionGuardOptions options;
      options.deceleration = deceleration;
      MotionGuard guard(options);
      std::vector<double> path = {0.1};
      for (int ms = 0; ms < 3000; ++ms) {
        const int before = std::max(0, ms - age_ms);
        const double x = path[static_cast<size_t>(before)];
        MotionInputs inputs = inputsAt(ms, path.back());
        inputs.planes = noPlanes(before, x, x - 0.001);
        MotionCommand command = moving({-1.0, 0.0, 0.0}, ms);
        command.period = milliseconds(1);
        path.push_back(path.back() + 1e-3 * guard.guard(inputs, command, at(ms)).twist_W.v_W.x());
      }
      EXPECT_GE(path.back(), 0.003 - 1e-6) << age_ms << " ms, " << deceleration << " m/s^2";
      EXPECT_LE(path.back(), 0.003 + 1e-4) << age_ms << " ms, " << deceleration << " m/s^2";
    }
  }
}

TEST(MotionGuardTest, StopsWithoutAWarningPlanesAPoseATool) {
  const auto stops = [](const MotionInputs& inputs, PermissionCause cause) {
    MotionGuard guard(withEscape());
    const GuardedMotion motion = guard.guard(inputs, moving({0.1, 0.0, 0.0}, 1000), at(1000));
    EXPECT_EQ(std::string(textOf(motion.decision.cause)), textOf(cause));
    EXPECT_EQ(motion.decision.permission, Permission::kStop);
    EXPECT_TRUE(isZero(motion.twist_W));
    EXPECT_EQ(motion.scale, 0.0);
  };
  stops({}, PermissionCause::kNoWarning);
  MotionInputs inputs = inputsAt(1000, 0.1);
  inputs.pose.reset();
  stops(inputs, PermissionCause::kNoPose);
  inputs = inputsAt(1000, 0.1);
  inputs.planes.reset();
  stops(inputs, PermissionCause::kNoPlanes);
  inputs = inputsAt(1000, 0.1);
  inputs.tool.reset();
  stops(inputs, PermissionCause::kNoTool);
  inputs = inputsAt(1000, 0.1);
  inputs.tool = std::make_shared<const ToolBalls>(ToolBalls{2, needle()->pieces});
  stops(inputs, PermissionCause::kNoTool);
  inputs.tool = std::make_shared<const ToolBalls>(ToolBalls{1, {}});
  stops(inputs, PermissionCause::kNoTool);
}

TEST(MotionGuardTest, PlanesOfAToolThatJointsMoveLetNothingThroughOfACommandOfARigidOne) {
  MotionGuard guard(withEscape());
  MotionInputs inputs = inputsAt(1000, 0.1);
  PlaneSet planes = *inputs.planes;
  planes.joints = {"elbow"};
  planes.positions = {0.0};
  inputs.planes = std::make_shared<const PlaneSet>(planes);
  for (const WarningLevel level : {WarningLevel::kClear, WarningLevel::kUnknown}) {
    inputs.warning->level = level;
    const GuardedMotion motion = guard.guard(inputs, moving({0.1, 0.0, 0.0}, 1000), at(1000));
    EXPECT_EQ(std::string(textOf(motion.decision.cause)), textOf(PermissionCause::kMovingJoints));
    EXPECT_TRUE(isZero(motion.twist_W));
  }
}

TEST(MotionGuardTest, EscapesSlowlyAndOnlyAway) {
  MotionGuard guard(withEscape());
  MotionInputs inputs = inputsAt(1000, 0.01);
  inputs.warning->level = WarningLevel::kUnknown;
  inputs.warning->reasons = kPoseStale;
  const GuardedMotion away = guard.guard(inputs, moving({0.1, 0.0, 0.0}, 1000), at(1000));
  EXPECT_EQ(away.decision.permission, Permission::kEscape);
  EXPECT_NEAR(away.twist_W.v_W.x(), 0.01, 1e-12);
  EXPECT_TRUE(isZero(guard.guard(inputs, moving({-0.1, 0.0, 0.0}, 1000), at(1000)).twist_W));
  EXPECT_TRUE(isZero(guard.guard(inputs, moving({0.0, 0.1, 0.0}, 1000), at(1000)).twist_W));
}

TEST(MotionGuardTest, AnOldCommandIsZero) {
  MotionGuard guard({});
  EXPECT_TRUE(isZero(guard.guard(inputsAt(1000, 0.5), moving({0.1, 0.0, 0.0}, 899), at(1000)).twist_W));
}

// The needle points at the wall with its far end. A turn about that end brings nothing to the wall.
TEST(MotionGuardTest, LimitsTheCommandedPointAndNotTheOrigin) {
  MotionInputs inputs = inputsAt(1000, 0.0);
  inputs.pose->X_WT.linear() = Eigen::AngleAxisd(std::acos(-1.0), Vector3d::UnitZ()).toRotationMatrix();
  inputs.pose->X_WT.translation().x() = 0.103;  // the far end is at the standoff
  MotionGuard guard({});
  MotionCommand command = moving({0.0, 0.0, 0.0}, 1000, {0.0, 0.0, 0.3});
  command.point_T = Vector3d(0.1, 0.0, 0.0);
  const GuardedMotion about_tip = guard.guard(inputs, command, at(1000));
  EXPECT_EQ(about_tip.twist_W.v_W, Vector3d::Zero());
  command.twist_W = {{-0.1, 0.0, 0.0}, Vector3d::Zero()};
  EXPECT_NEAR(guard.guard(inputs, command, at(1000)).twist_W.v_W.x(), 0.0, 1e-9);
}

TEST(MotionGuardTest, ACommandThatIsNotFiniteIsRefused) {
  MotionGuard guard({});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(guard.guard(inputsAt(1000, 0.5), moving({nan, 0.0, 0.0}, 1000), at(1000)), InvalidInput);
  EXPECT_THROW(guard.guard(inputsAt(1000, 0.5), moving({1e300, 0.0, 0.0}, 1000), at(1000)), InvalidInput);
}

TEST(MotionGuardTest, OptionsOutOfRangeAreRefused) {
  MotionGuardOptions options;
  options.deceleration = 0.0;
  EXPECT_TRUE(has(refusal([&] { MotionGuard guard(options); }), "deceleration"));
  options = {};
  options.standoff = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(has(refusal([&] { MotionGuard guard(options); }), "standoff"));
  options = {};
  options.dead_time = milliseconds(-1);
  EXPECT_TRUE(has(refusal([&] { MotionGuard guard(options); }), "lag"));
  options = {};
  options.escape_speed = -1.0;
  EXPECT_TRUE(has(refusal([&] { MotionGuard guard(options); }), "escape"));
}

// A tool of some pieces among planes, and a command of some point.
struct Case {
  MotionInputs inputs;
  MotionCommand command;
};

std::vector<ToolBall> randomPiece(RandomScenes& random) {
  std::vector<ToolBall> balls;
  const size_t count = 1 + random.count(6);
  for (size_t i = 0; i < count; ++i) balls.push_back({random.uniform(0.0, 0.2) * random.direction(), 0.002});
  return balls;
}

Isometry3d randomPose(RandomScenes& random) {
  Isometry3d X_WT(Eigen::AngleAxisd(random.uniform(0.0, 3.0), random.direction()));
  X_WT.translation() = random.uniform(0.0, 1.0) * random.direction();
  return X_WT;
}

Case randomCase(RandomScenes& random) {
  ToolBalls tool{1, {}};
  const size_t pieces = 1 + random.count(3);
  for (size_t i = 0; i < pieces; ++i) tool.pieces.push_back(randomPiece(random));
  Case drawn{inputsAt(1000, 0.0), moving(random.logUniform(1e-3, 1.0) * random.direction(), 1000)};
  drawn.inputs.pose->X_WT = randomPose(random);
  PlaneSet planes{received(1000 - static_cast<int>(random.count(100))), at(1100).stamp, true, 1, {}, {}};
  const size_t count = random.count(12);
  for (size_t i = 0; i < count; ++i) {
    const Vector3d normal_W = random.direction();
    const double offset = random.uniform(-0.01, 0.4);
    planes.planes.push_back({random.count(pieces), normal_W, drawn.inputs.pose->X_WT.translation() - offset * normal_W,
                             0.0, random.chance(0.7) ? 0.0 : random.uniform(-0.1, 0.1)});
  }
  if (random.chance(0.2)) planes.uncovered.distance = random.uniform(0.0, 0.5);
  planes.X_WT = drawn.inputs.pose->X_WT;
  drawn.inputs.planes = std::make_shared<const PlaneSet>(planes);
  drawn.inputs.tool = std::make_shared<const ToolBalls>(tool);
  if (random.chance(0.5)) drawn.command.twist_W.w_W = random.logUniform(1e-3, 1.0) * random.direction();
  if (random.chance(0.3)) drawn.command.point_T = random.uniform(0.0, 0.2) * random.direction();
  return drawn;
}

// All balls before their planes, in the pose, seen from the commanded point.
std::vector<FacingBall> facing(const Case& drawn, const Isometry3d& X_WT) {
  std::vector<FacingBall> facing;
  for (const SeparatingPlane& plane : drawn.inputs.planes->planes) {
    addFacingBalls(plane, drawn.inputs.tool->pieces[plane.piece], X_WT, facing);
  }
  for (FacingBall& ball : facing) ball.center_W -= X_WT.linear() * drawn.command.point_T;
  return facing;
}

TEST(MotionGuardTest, NoOutputClosesFasterThanItMayAtTheNewestAndTheExpectedPose) {
  RandomScenes random(71);
  int limited = 0;
  int passed_on = 0;
  for (std::uint64_t i = 0; i < caseCount(10'000); ++i) {
    Case drawn = randomCase(random);
    const Isometry3d& X_WT = drawn.inputs.pose->X_WT;
    if (random.chance(0.5)) drawn.command.rest_WT = Eigen::Translation3d(0.01 * random.direction()) * X_WT;
    MotionGuard guard({});
    const GuardedMotion motion = guard.guard(drawn.inputs, drawn.command, at(1000));
    const Twist& command_W = drawn.command.twist_W;
    const double reaction = 0.01 + toSeconds(age(drawn.inputs.planes->timestamps, at(1000)));
    const BrakingLimits limits{1.0, reaction, 0.002, radiusAbout(drawn.command.point_T, *drawn.inputs.tool)};
    for (const Isometry3d& pose_WT : {X_WT, drawn.command.rest_WT.value_or(X_WT)}) {
      for (const FacingBall& ball : facing(drawn, pose_WT)) {
        const double tolerance = 2e-6 * fastestPoint(command_W, limits.tool_radius) + 1e-12;
        EXPECT_LE(closingSpeed(ball, motion.twist_W), ClosingRow(ball, command_W, limits).limit + tolerance);
      }
    }
    EXPECT_LE(motion.twist_W.v_W.norm(), command_W.v_W.norm() * (1.0 + 1e-12));
    EXPECT_LE(motion.twist_W.w_W.cross(command_W.w_W).norm(), 1e-12);
    EXPECT_LE(motion.twist_W.w_W.norm(), command_W.w_W.norm() * (1.0 + 1e-12));
    if (!motion.limiting && drawn.inputs.planes->uncovered.distance > 1.0) {
      EXPECT_TRUE(motion.twist_W == command_W);
      ++passed_on;
    } else {
      ++limited;
    }
  }
  EXPECT_GT(limited, 1000);
  EXPECT_GT(passed_on, 500);
}

double difference(const Twist& a, const Twist& b) { return (a.v_W - b.v_W).norm() + (a.w_W - b.w_W).norm(); }

// The bound is the largest slope that the limiter may have between planes at a small angle, times the step.
TEST(MotionGuardTest, IsContinuousInCommandPoseAndAge) {
  RandomScenes random(72);
  int compared = 0;
  for (std::uint64_t i = 0; i < caseCount(2'000); ++i) {
    const Case drawn = randomCase(random);
    const auto output = [&](double step) {
      Case moved = drawn;
      moved.command.twist_W.v_W += step * Vector3d(0.3, -0.5, 0.8);
      moved.inputs.pose->X_WT = Eigen::Translation3d(step * Vector3d(-0.2, 0.9, 0.4)) * drawn.inputs.pose->X_WT;
      moved.command.period += fromSeconds(step);
      return MotionGuard({}).guard(moved.inputs, moved.command, at(1000)).twist_W;
    };
    const std::vector<FacingBall> balls = facing(drawn, drawn.inputs.pose->X_WT);
    const bool at_standoff = std::any_of(balls.begin(), balls.end(), [](const FacingBall& b) { return b.gap < 0.004; });
    if (at_standoff || drawn.inputs.planes->uncovered.distance < 0.004) continue;
    const double small = difference(output(0.0), output(1e-9));
    EXPECT_LE(small, 1e-4) << i;
    ++compared;
  }
  EXPECT_GT(compared, 200);
}

TEST(MotionGuardTest, AllocatesNothing) {
  RandomScenes random(73);
  MotionGuard guard(withEscape());
  for (int i = 0; i < 200; ++i) {
    Case drawn = randomCase(random);
    if (i % 3 == 0) drawn.inputs.warning->level = WarningLevel::kUnknown;
    const Allocations allocations;
    guard.guard(drawn.inputs, drawn.command, at(1000 + i));
    guard.stop(at(1000 + i).steady);
    EXPECT_EQ(allocations.count(), 0U) << allocations.stacks();
  }
}

}  // namespace
}  // namespace sweep_guard_core
