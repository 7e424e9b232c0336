#include "sweep_guard/motion/joint_motion_guard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "motion/random_arms.h"
#include "refusal.h"
#include "sweep_guard/monitor/reason.h"

namespace sweep_guard_core {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;

// A slide along x that carries a ball of 1 mm, before a wall at x = 0, and a wheel about z, of which a ball is 0.5 m from the axis.
ArmCase slideAndWheel(double x) {
  TreeLink slide;
  slide.name = "slide";
  slide.joint = "slide_joint";
  slide.type = JointType::kPrismatic;
  slide.axis_J = Vector3d::UnitX();
  TreeLink wheel;
  wheel.name = "wheel";
  wheel.joint = "wheel_joint";
  wheel.type = JointType::kRevolute;
  wheel.variable = 1;
  ArmCase arm;
  arm.tree = std::make_shared<const KinematicTree>(
      KinematicTree({JointVariable{"slide_joint"}, JointVariable{"wheel_joint"}}, {slide, wheel}));
  arm.joints = {{Eigen::Isometry3d::Identity(), {x, 0.0}}, received(1000)};
  arm.command = {Eigen::Vector2d(-0.5, 0.0), received(1000), milliseconds(10)};
  arm.inputs.tool = std::make_shared<const ToolBalls>(
      ToolBalls{1, {{{Vector3d::Zero(), 0.001}}, {{Vector3d(0.0, 0.5, 0.0), 0.0}}}, {"slide", "wheel"}});
  PlaneSet planes{received(1000), at(1150).stamp, true, 1, {}, {}, {}, {"wheel_joint", "slide_joint"}, {0.0, x}};
  planes.X_WT = Eigen::Isometry3d::Identity();
  planes.planes.push_back({0, Vector3d::UnitX(), Vector3d::Zero(), x - 0.001, 0.0});
  arm.inputs.planes = std::make_shared<const PlaneSet>(planes);
  arm.inputs.warning = MotionInputs::GuardWarning{WarningLevel::kClear, 0, at(1000).steady};
  return arm;
}

TEST(JointMotionGuardTest, ScalesTheWholeCommandBeforeAPlaneAndNamesIt) {
  ArmCase arm = slideAndWheel(0.011);
  arm.command.velocities[1] = 0.2;
  const GuardedMotion motion = guardOnce(arm);
  const double allowed = stoppingSpeed(0.008, {1.0, 0.01, 0.002, 0.0});
  EXPECT_NEAR(motion.scale, allowed / 0.5, 1e-12);
  EXPECT_NEAR(motion.commanded_speed, 0.5, 1e-12);
  EXPECT_NEAR(motion.sent_speed, allowed, 1e-12);
  ASSERT_TRUE(motion.limiting);
  EXPECT_EQ(motion.limiting->plane, 0U);
  EXPECT_EQ(motion.limiting->normal_W, Vector3d::UnitX());
  EXPECT_NEAR(motion.limiting->gap, 0.010, 1e-12);
  EXPECT_NEAR(motion.limiting->closing_limit, allowed, 1e-12);
}

TEST(JointMotionGuardTest, AnArcIsPaidUntilTheRobotIsAtRest) {
  ArmCase arm = slideAndWheel(1.0);
  arm.command.velocities = Eigen::Vector2d(0.0, 1.0);
  editable(arm).planes = {{1, Vector3d::UnitX(), Vector3d(-0.01, 0.0, 0.0), 0.01, 0.0}};
  const double share = guardOnce(arm).scale;
  const double turn = share * (0.01 + share * 0.5 / 2.0);  // [rad] until at rest, from 0.5 m/s at 1 m/s^2
  EXPECT_NEAR(0.5 * std::sin(turn), 0.008, 1e-6);
}

// The path does not bend, so all of the motion brakes for the part that closes.
TEST(JointMotionGuardTest, AGrazingMotionBrakesAlongItsPath) {
  ArmCase arm = slideAndWheel(0.051);
  arm.command.velocities = Eigen::Vector2d(-0.2, 2.0);  // the wheel's ball, which closes on nothing, goes at 1 m/s
  const double share = guardOnce(arm).scale;
  EXPECT_NEAR(0.2 * share * (0.01 + share * 1.0 / 2.0), 0.048, 1e-9);
}

TEST(JointMotionGuardTest, ASurfaceComesUntilTheRobotIsAtRest) {
  ArmCase arm = slideAndWheel(0.051);
  editable(arm).planes[0].surface_speed = 0.1;
  const double share = guardOnce(arm).scale;
  EXPECT_NEAR(0.5 * share * (0.01 + share * 0.5 / 2.0) + 0.1 * (0.01 + share * 0.5), 0.048, 1e-5);
  editable(arm).planes[0].surface_speed = -0.1;
  EXPECT_NEAR(0.5 * guardOnce(arm).scale, stoppingSpeed(0.048, {1.0, 0.01, 0.002, 0.0}), 1e-9);
}

TEST(JointMotionGuardTest, TheRobotsLagAndTheAgeOfPlanesCountAsReactionTime) {
  MotionGuardOptions options;
  options.dead_time = milliseconds(30);
  options.time_constant = milliseconds(40);
  ArmCase arm = slideAndWheel(0.011);
  EXPECT_NEAR(0.5 * guardOnce(arm, options).scale, stoppingSpeed(0.008, {1.0, 0.08, 0.002, 0.0}), 1e-9);
  editable(arm).timestamps = received(960);
  EXPECT_NEAR(0.5 * guardOnce(arm, options).scale, stoppingSpeed(0.008, {1.0, 0.12, 0.002, 0.0}), 1e-9);
  arm.joints.timestamps = received(950);
  EXPECT_NEAR(0.5 * guardOnce(arm, options).scale, stoppingSpeed(0.008, {1.0, 0.13, 0.002, 0.0}), 1e-9);
}

TEST(JointMotionGuardTest, CountsWhatIsInFlight) {
  MotionGuardOptions options;
  options.dead_time = milliseconds(50);
  ArmCase arm = slideAndWheel(0.03);
  arm.command.velocities[0] = -0.2;
  JointMotionGuard guard(options, arm.tree);
  const double first = guard.guard(arm.inputs, arm.joints, arm.command, at(1000)).scale;
  const double second = guard.guard(arm.inputs, arm.joints, arm.command, at(1020)).scale;
  const BrakingLimits limits{1.0, 0.08, 0.002, 0.0};  // 20 ms after positions and planes
  EXPECT_NEAR(0.2 * second, stoppingSpeed(0.027 - 0.02 * 0.2 * first, limits), 1e-9);
  guard.stop(at(1020).steady);
  const double third = guard.guard(arm.inputs, arm.joints, arm.command, at(1040)).scale;
  EXPECT_NEAR(0.2 * third, stoppingSpeed(0.027 - 0.02 * 0.2 * first, {1.0, 0.1, 0.002, 0.0}), 1e-9);
}

TEST(JointMotionGuardTest, WhatNoPlaneStandsForBoundsTheFastestPointOfAllLinks) {
  ArmCase arm = slideAndWheel(0.5);
  arm.command.velocities = Eigen::Vector2d(0.1, 2.0);  // the wheel's ball goes at 1 m/s
  PlaneSet& planes = editable(arm);
  planes.planes.clear();
  planes.uncovered = {0.05, 0.0};
  const GuardedMotion motion = guardOnce(arm);
  EXPECT_NEAR(motion.commanded_speed, 1.0, 1e-12);
  EXPECT_NEAR(motion.scale, stoppingSpeed(0.048, {1.0, 0.01, 0.002, 0.0}), 1e-9);
  EXPECT_FALSE(motion.limiting);
  planes.positions[1] = 0.52;  // the slide came 20 mm since
  EXPECT_NEAR(guardOnce(arm).scale, stoppingSpeed(0.028, {1.0, 0.01, 0.002, 0.0}), 1e-9);
}

// Three links in a row, whose last one is at rest for an instant while the elbows leave the line, and then comes back to the base.
TEST(JointMotionGuardTest, ALinkThatRestsForAnInstantIsLimited) {
  ArmCase arm = slideAndWheel(1.0);
  std::vector<JointVariable> joints;
  std::vector<TreeLink> links;
  for (size_t i = 0; i < 3; ++i) {
    TreeLink link;
    link.name = "link" + std::to_string(i);
    link.joint = "joint" + std::to_string(i);
    link.type = JointType::kRevolute;
    link.variable = i;
    if (i > 0) {
      link.parent = i - 1;
      link.X_PJ.translation().x() = 0.5;
    }
    joints.push_back({link.joint});
    links.push_back(link);
  }
  arm.tree = std::make_shared<const KinematicTree>(KinematicTree(joints, links));
  arm.joints.state.positions = {0.0, 0.0, 0.0};
  arm.command.velocities = Vector3d(1.0, -2.0, 1.0);
  arm.inputs.tool = std::make_shared<const ToolBalls>(
      ToolBalls{1, {{{0.5 * Vector3d::UnitX(), 0.0}}, {{Vector3d::Zero(), 0.01}}}, {"link0", "link2"}});
  PlaneSet& planes = editable(arm);
  planes.joints = {"joint0", "joint1", "joint2"};
  planes.positions = {0.0, 0.0, 0.0};
  planes.planes = {{1, Vector3d::UnitX(), 0.98 * Vector3d::UnitX(), 0.01, 0.0}};
  const double share = guardOnce(arm).scale;
  const double turn = share * (0.01 + share * 0.5 / 2.0);  // [rad] until at rest: an elbow goes at 0.5 m/s
  EXPECT_LT(share, 1.0);
  EXPECT_NEAR(std::cos(turn), 0.992, 1e-5);
}

TEST(JointMotionGuardTest, ALinkWithoutAPlaneCostsNothing) {
  ArmCase arm = slideAndWheel(0.0031);
  arm.command.velocities = Eigen::Vector2d(0.0, 3.0);
  EXPECT_EQ(guardOnce(arm).scale, 1.0);
}

TEST(JointMotionGuardTest, WhereNoCameraSeesItGoingTheFastestPointIsSlow) {
  ArmCase arm = slideAndWheel(0.5);
  arm.inputs.warning = MotionInputs::GuardWarning{WarningLevel::kUnknown, kNotSeen, at(1000).steady};
  arm.command.velocities = Eigen::Vector2d(0.1, 2.0);
  const GuardedMotion motion = guardOnce(arm);
  EXPECT_NEAR(motion.sent_speed, 0.05, 1e-12);
  EXPECT_EQ(motion.decision.cause, PermissionCause::kUnseen);
  arm.command.velocities = Eigen::Vector2d(0.01, 0.02);
  EXPECT_EQ(guardOnce(arm).scale, 1.0);
}

TEST(JointMotionGuardTest, EscapesSlowlyAndOnlyAway) {
  MotionGuardOptions options;
  options.escape_speed = 0.01;
  ArmCase arm = slideAndWheel(0.01);
  arm.inputs.warning->level = WarningLevel::kUnknown;
  arm.inputs.warning->reasons = kPoseStale;
  const auto sent = [&](double slide, double wheel) {
    arm.command.velocities = Eigen::Vector2d(slide, wheel);
    const GuardedMotion motion = guardOnce(arm, options);
    EXPECT_EQ(motion.decision.permission, Permission::kEscape);
    return motion.sent_speed;
  };
  EXPECT_NEAR(sent(0.1, 0.0), 0.01, 1e-12);
  EXPECT_EQ(sent(-0.1, 0.0), 0.0);
  EXPECT_NEAR(sent(0.0, 0.1), 0.01, 1e-12);  // the slide is at rest, the wheel is before no plane
  editable(arm).planes.push_back({1, Vector3d::UnitY(), Vector3d::Zero(), 0.5, 0.0});
  EXPECT_EQ(sent(0.1, 0.1), 0.0);  // the arc of the wheel leads to its plane
}

TEST(JointMotionGuardTest, ZeroIsAlwaysAllowed) {
  ArmCase arm = slideAndWheel(-0.1);
  arm.command.velocities.setZero();
  editable(arm).uncovered = {0.0, 1.0};
  EXPECT_EQ(guardOnce(arm).scale, 1.0);
  EXPECT_EQ(guardOnce(arm).sent_speed, 0.0);
}

TEST(JointMotionGuardTest, AJointThatThePlanesDoNotNameMayRestAndMustNotMove) {
  ArmCase arm = slideAndWheel(0.5);
  editable(arm).joints = {"slide_joint"};
  editable(arm).positions = {0.5};
  arm.command.velocities << 0.1, 0.0;
  EXPECT_EQ(guardOnce(arm).decision.cause, PermissionCause::kGuarded);
  arm.command.velocities << 0.1, 0.2;
  EXPECT_TRUE(has(refusal([&] { guardOnce(arm); }), "moves no link of the guard's tool"));
}

TEST(JointMotionGuardTest, LinksThatAreElsewhereByThisDescriptionAreRefused) {
  ArmCase arm = slideAndWheel(0.5);
  EXPECT_EQ(guardOnce(arm).decision.cause, PermissionCause::kGuarded);
  editable(arm).positions[1] = 0.6;  // the ball would be farther from the wall than the guard found it
  EXPECT_TRUE(has(refusal([&] { guardOnce(arm); }), "links are not where the guard has them"));
}

TEST(JointMotionGuardTest, StopsWithACauseOfItsOwn) {
  const auto stops = [](const ArmCase& arm, PermissionCause cause) {
    MotionGuardOptions options;
    options.escape_speed = 0.01;
    JointMotionGuard guard(options, arm.tree);
    const GuardedMotion motion = guard.guard(arm.inputs, arm.joints, arm.command, at(1000));
    EXPECT_EQ(std::string(textOf(motion.decision.cause)), textOf(cause));
    EXPECT_EQ(guard.permission(arm.inputs, arm.joints, arm.command.timestamps, at(1000)).cause, cause);
    EXPECT_EQ(motion.scale, 0.0);
    EXPECT_EQ(motion.sent_speed, 0.0);
  };
  const ArmCase usual = slideAndWheel(0.5);
  ArmCase arm = usual;
  arm.command.velocities[0] = 0.1;
  EXPECT_EQ(guardOnce(arm).decision.cause, PermissionCause::kGuarded);
  arm.joints = {};
  stops(arm, PermissionCause::kNoJoints);
  arm = usual;
  arm.joints.timestamps.received = at(849).steady;
  stops(arm, PermissionCause::kJointsSilent);
  arm = usual;
  arm.joints.timestamps.stamp = at(499).stamp;
  stops(arm, PermissionCause::kOldJoints);
  arm = usual;
  editable(arm).joints.clear();
  editable(arm).positions.clear();
  stops(arm, PermissionCause::kOtherJoints);
  arm = usual;
  editable(arm).joints[0] = "joint_of_another_robot";
  stops(arm, PermissionCause::kOtherJoints);
  arm = usual;
  arm.inputs.tool = std::make_shared<const ToolBalls>(ToolBalls{1, arm.inputs.tool->pieces, {"slide", "elsewhere"}});
  stops(arm, PermissionCause::kOtherJoints);
  arm = usual;
  arm.inputs.planes.reset();
  stops(arm, PermissionCause::kNoPlanes);
  arm = usual;
  arm.inputs.tool.reset();
  stops(arm, PermissionCause::kNoTool);
  arm = usual;
  arm.inputs.warning.reset();
  stops(arm, PermissionCause::kNoWarning);
  arm = usual;
  arm.command.timestamps = received(899);
  stops(arm, PermissionCause::kOldCommand);
}

TEST(JointMotionGuardTest, WhatIsNotFiniteOrOfOtherJointsIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const ArmCase& arm, const std::string& what) {
    EXPECT_TRUE(has(refusal([&] { guardOnce(arm); }), what)) << what;
  };
  const ArmCase usual = slideAndWheel(0.5);
  ArmCase arm = usual;
  arm.command.velocities[1] = nan;
  refused(arm, "commanded joint velocities");
  arm.command.velocities[1] = 2e6;
  refused(arm, "commanded joint velocities");
  arm.command.velocities = Eigen::Vector3d::Zero();
  refused(arm, "commanded joint velocities");
  arm = usual;
  arm.joints.state.positions[0] = nan;
  refused(arm, "joint positions");
  arm.joints.state.positions = {0.0};
  refused(arm, "joint positions");
  arm = usual;
  arm.joints.state.X_WR.translation().x() = nan;
  refused(arm, "robot's root");
  arm = usual;
  editable(arm).planes[0].point_W.x() = nan;
  refused(arm, "separating plane");
  arm = usual;
  editable(arm).uncovered.distance = nan;
  refused(arm, "distance");
  PlaneSet planes = *usual.inputs.planes;
  planes.positions[0] = nan;
  EXPECT_TRUE(has(refusal([&] { requireUsable(planes); }), "position of each joint"));
  EXPECT_TRUE(has(refusal([] { requireUsable(ToolBalls{1, {{}, {}}, {"slide"}}); }), "one frame of each piece"));
  MotionGuardOptions options;
  options.deceleration = 0.0;
  EXPECT_TRUE(has(refusal([&] { JointMotionGuard guard(options, usual.tree); }), "deceleration"));
}

}  // namespace
}  // namespace sweep_guard_core
