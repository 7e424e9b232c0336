#include "sweep_guard/motion/velocity_limiter.h"

#include <gtest/gtest.h>

#include <limits>

#include "allocations.h"
#include "common/floating_point.h"
#include "motion/floor.h"
#include "motion/random_scenes.h"
#include "refusal.h"

namespace sweep_guard_core {
namespace {

using Eigen::Vector3d;

constexpr double kTolerance = 1.6e-6;  // in speeds of the fastest tool point

const FacingBall kFloor{Vector3d::UnitZ(), Vector3d::Zero(), 0.04, 0.0};

Twist limit(const MotionScene& scene) {
  return VelocityLimiter(scene.facing.size()).limit(scene.command_W, scene.facing, scene.uncovered, scene.limits);
}

Twist limit(const Twist& command_W, const std::vector<FacingBall>& facing, const BrakingLimits& limits = kLimits) {
  return limit(MotionScene{command_W, facing, {}, limits});
}

bool isEqual(const Twist& a, const Twist& b) { return a.v_W == b.v_W && a.w_W == b.w_W; }

double distance(const Twist& a, const Twist& b, double radius) {
  return (a.v_W - b.v_W).norm() + std::max(radius, 0.01) * (a.w_W - b.w_W).norm();
}

// Returns how far a ball comes closer to its plane [m] until a robot is at rest that brakes along its path, at most.
double approachUntilRest(const FacingBall& ball, const Twist& twist_W, const BrakingLimits& limits) {
  const StopOnPath stop{limits.reaction_time, fastestPoint(twist_W, limits.tool_radius) / limits.deceleration};
  double most = 0.0;
  for (int i = 1; i <= 50; ++i) {
    const double way = stop.way(1.0) * i / 50;
    const double angle = twist_W.w_W.norm() * way;
    const Eigen::AngleAxisd turn(angle, angle > 0.0 ? twist_W.w_W.normalized() : Vector3d::UnitX());
    const Vector3d moved_W = way * twist_W.v_W + turn * ball.center_W - ball.center_W;
    most = std::max(most, -ball.normal_W.dot(moved_W));
  }
  return most;
}

bool stopsInTime(const FacingBall& ball, const Twist& output_W, const MotionScene& scene) {
  const double fastest = fastestPoint(output_W, scene.limits.tool_radius);
  const StopOnPath stop{scene.limits.reaction_time, fastest / scene.limits.deceleration};
  const double comes = std::max(0.0, ball.surface_speed) * stop.untilRest(1.0);
  const double tolerance = kTolerance * fastestPoint(scene.command_W, scene.limits.tool_radius) * stop.way(1.0);
  return approachUntilRest(ball, output_W, scene.limits) <=
         std::max(0.0, ball.gap - scene.limits.standoff - comes) + tolerance;
}

double limitOf(const FacingBall& ball, const Twist& command_W, const BrakingLimits& limits = kLimits) {
  return ClosingRow(ball, command_W, limits).limit;
}

TEST(VelocityLimiterTest, StoppingSpeedUsesUpTheDistance) {
  EXPECT_DOUBLE_EQ(stoppingSpeed(0.2 * 0.2 / 2.0 + 0.1 * 0.2, kLimits), 0.2);
  EXPECT_EQ(stoppingSpeed(0.0, kLimits), 0.0);
  EXPECT_EQ(stoppingSpeed(-1.0, kLimits), 0.0);
  EXPECT_EQ(stoppingSpeed(kInfinity, kLimits), kInfinity);
}

TEST(VelocityLimiterTest, AStraightApproachUsesUpTheDistance) {
  EXPECT_NEAR(limitOf(floorAt(0.04), {-0.4 * Vector3d::UnitZ(), Vector3d::Zero()}), 0.2, 1e-12);
  const FacingBall comes = floorAt(0.04, Vector3d::Zero(), 0.05);
  EXPECT_NEAR(limitOf(comes, {-0.4 * Vector3d::UnitZ(), Vector3d::Zero()}), 0.15, 1e-12);
}

TEST(VelocityLimiterTest, TheArcOfABallIsPaidUntilItIsAtRest) {
  RandomScenes random(2);
  for (int i = 0; i < 1000; ++i) {
    const MotionScene scene = random.scene();
    const Twist turn_W{Vector3d::Zero(), scene.command_W.w_W};
    const double time = random.logUniform(1e-3, 3.0);
    for (const FacingBall& ball : scene.facing) {
      const double closing = closingSpeed(ball, turn_W) + arcClosing(ball, turn_W.w_W, time);
      BrakingLimits limits = scene.limits;
      limits.reaction_time = time;
      limits.deceleration = 1e300;
      EXPECT_LE(approachUntilRest(ball, turn_W, limits), std::max(0.0, closing * time) + 1e-12);
    }
  }
}

TEST(VelocityLimiterTest, SlowsDownBeforeAWallAndSlidesAlongIt) {
  const Twist slowed = limit({{0.3, 0.0, -0.4}, Vector3d::Zero()}, {floorAt(0.04)});
  const double closing = -slowed.v_W.z();
  EXPECT_NEAR(closing * (0.1 + 0.5 * (closing + 0.3)), 0.04, 1e-12);
  EXPECT_TRUE(slowed.v_W.isApprox(Vector3d(0.3, 0.0, -closing), 1e-12));
}

TEST(VelocityLimiterTest, StopsWhatWouldCloseAtTheStandoff) {
  BrakingLimits limits = kLimits;
  limits.standoff = 0.04;
  EXPECT_TRUE(limit({{0.3, 0.0, -0.4}, Vector3d::Zero()}, {floorAt(0.04)}, limits).v_W.isApprox(Vector3d(0.3, 0, 0)));
  EXPECT_TRUE(isZero(limit({{0.0, 0.0, -0.4}, Vector3d::Zero()}, {floorAt(0.02)}, limits)));
}

TEST(VelocityLimiterTest, ATurnAloneIsSlowedAndNothingElseMoves) {
  const Twist slowed = limit({Vector3d::Zero(), {0.0, 4.0, 0.0}}, {floorAt(0.04, {0.1, 0.0, 0.0})});
  EXPECT_TRUE(slowed.v_W.isZero(0.0));
  EXPECT_TRUE(slowed.w_W.isApprox(Vector3d(0.0, 2.0, 0.0), 1e-12));
}

// If a distance in meters were smallest, the output would lose its turn as soon as there is a translation.
TEST(VelocityLimiterTest, ATinyTranslationCostsTheTurnNothing) {
  const std::vector<FacingBall> facing = {floorAt(0.04, {0.1, 0.0, 0.0})};
  const Twist alone = limit({Vector3d::Zero(), {0.0, 4.0, 0.0}}, facing);
  for (const double speed : {1e-3, 1e-6, 1e-12, 1e-100, 1e-300}) {
    const Twist with = limit({{speed, 0.0, 0.0}, {0.0, 4.0, 0.0}}, facing);
    EXPECT_LT(distance(with, alone, 0.1), 2.0 * speed + 1e-12);
  }
}

TEST(VelocityLimiterTest, BothEndsOfTheToolAreLimited) {
  const std::vector<FacingBall> facing = {floorAt(0.01, {0.0, 0.0, 0.0}), floorAt(0.04, {-0.3, 0.0, 0.0})};
  BrakingLimits limits = kLimits;
  limits.tool_radius = 0.3;
  const Twist slowed = limit({Vector3d::Zero(), {0.0, -1.0, 0.0}}, facing, limits);
  EXPECT_NEAR(closingSpeed(facing[1], slowed), 0.2, 1e-12);
}

TEST(VelocityLimiterTest, ASurfaceThatComesLeavesZeroAndRetreat) {
  const std::vector<FacingBall> facing = {floorAt(0.04, Vector3d::Zero(), /*surface_speed=*/0.5)};
  EXPECT_TRUE(isZero(limit({{0.0, 0.0, -0.4}, Vector3d::Zero()}, facing)));
  const Twist retreat{{0.1, 0.0, 0.1}, {0.2, 0.3, 0.4}};
  EXPECT_TRUE(isEqual(limit(retreat, facing), retreat));
}

// The turn closes at 0.7 m/s, of which the translation takes away 0.5 m/s. To rest, the fastest point has 1.2 m/s to lose.
TEST(VelocityLimiterTest, ATurnThatClosesWhileTheToolGoesAwayBrakesAlongItsPath) {
  const double closing = limitOf(floorAt(0.12, {0.1, 0.0, 0.0}), {0.5 * Vector3d::UnitZ(), 7.0 * Vector3d::UnitY()});
  EXPECT_LT(closing, 0.2);
  EXPECT_NEAR(closing * (0.1 + 0.5 * (closing + 1.0)), 0.12, 1e-12);
}

TEST(VelocityLimiterTest, ASurfaceThatGoesAwayCountsAsAtRest) {
  const Twist down_W{-0.4 * Vector3d::UnitZ(), Vector3d::Zero()};
  EXPECT_EQ(limitOf(floorAt(0.04, Vector3d::Zero(), -1.0), down_W), limitOf(floorAt(0.04), down_W));
}

TEST(VelocityLimiterTest, TheToolCanStopBeforeWhatNoPlaneStandsFor) {
  const MotionScene scene{{{0.4, 0.0, 0.0}, Vector3d::Zero()}, {}, {0.04, 0.05}, kLimits};
  EXPECT_TRUE(limit(scene).v_W.isApprox(Vector3d(0.15, 0.0, 0.0), 1e-12));
}

TEST(VelocityLimiterTest, EveryGapLastsUntilARobotIsAtRestThatBrakesAlongItsPath) {
  RandomScenes random(3);
  const std::uint64_t cases = caseCount(50000);
  std::uint64_t limited = 0;
  for (std::uint64_t i = 0; i < cases; ++i) {
    const MotionScene scene = random.scene();
    const Twist output_W = limit(scene);
    limited += isEqual(output_W, scene.command_W) ? 0 : 1;
    for (const FacingBall& ball : scene.facing) ASSERT_TRUE(stopsInTime(ball, output_W, scene)) << "case " << i;
    const double allowed = stoppingSpeed(scene.uncovered.distance - scene.limits.standoff, scene.limits);
    ASSERT_LE(fastestPoint(output_W, scene.limits.tool_radius), allowed * (1.0 + kTolerance)) << "case " << i;
  }
  EXPECT_GT(limited, cases / 2);
}

TEST(VelocityLimiterTest, NothingTurnsOrMovesThatWasNotCommandedAndNeitherPartIsFaster) {
  RandomScenes random(4);
  for (std::uint64_t i = 0, cases = caseCount(50000); i < cases; ++i) {
    const MotionScene scene = random.scene();
    const auto& [v_W, w_W] = scene.command_W;
    const Twist output_W = limit(scene);
    ASSERT_LE(output_W.v_W.norm(), v_W.norm() * (1.0 + 1e-12)) << "case " << i;
    ASSERT_LE(output_W.w_W.norm(), w_W.norm() * (1.0 + 1e-12)) << "case " << i;
    ASSERT_LE(output_W.w_W.cross(w_W).norm(), 1e-12 * w_W.squaredNorm()) << "case " << i;
    ASSERT_GE(output_W.w_W.dot(w_W), 0.0) << "case " << i;
  }
}

TEST(VelocityLimiterTest, ACommandThatOpensEveryGapUntilRestIsPassedOnBitForBit) {
  RandomScenes random(5);
  size_t balls = 0;
  for (std::uint64_t i = 0, cases = caseCount(50000); i < cases; ++i) {
    MotionScene scene = random.scene();
    scene.uncovered = {};
    const double fastest = fastestPoint(scene.command_W, scene.limits.tool_radius);
    const double time = scene.limits.reaction_time + 0.5 * fastest / scene.limits.deceleration;
    const double bend = 0.5 * scene.limits.tool_radius * scene.command_W.w_W.squaredNorm() * time;
    std::vector<FacingBall> opening;
    for (FacingBall& ball : scene.facing) {
      if (closingSpeed(ball, scene.command_W) > 0.0) ball.normal_W = -ball.normal_W;
      if (closingSpeed(ball, scene.command_W) <= -bend) opening.push_back(ball);
    }
    scene.facing = opening;
    balls += opening.size();
    ASSERT_TRUE(isEqual(limit(scene), scene.command_W)) << "case " << i;
  }
  EXPECT_GT(balls, 0U);
}

TEST(VelocityLimiterTest, FreeMotionIsPassedOnBitForBit) {
  RandomScenes random(6);
  for (std::uint64_t i = 0, cases = caseCount(50000); i < cases; ++i) {
    MotionScene scene = random.scene();
    const double fastest = fastestPoint(scene.command_W, scene.limits.tool_radius) + 0.2;
    const double until_rest = scene.limits.reaction_time + 2.0 * fastest / scene.limits.deceleration;
    const double bend = scene.limits.tool_radius * scene.command_W.w_W.squaredNorm() * until_rest;
    scene.uncovered = {(fastest + bend) * (until_rest + bend / scene.limits.deceleration) + scene.limits.standoff, 0.2};
    for (FacingBall& ball : scene.facing) ball.gap = scene.uncovered.distance * 1.000001;
    scene.uncovered.distance *= 1.000001;
    ASSERT_TRUE(isEqual(limit(scene), scene.command_W)) << "case " << i;
  }
}

// A path from one command and state to another.
class Path {
 public:
  explicit Path(RandomScenes& random) : from_(random.scene()), to_(from_) {
    from_.uncovered = {std::max(from_.uncovered.distance, from_.limits.standoff + 1e-3), 0.0};
    const MotionScene other = random.scene();
    to_.command_W = other.command_W;
    if (random.chance(0.3)) to_.command_W.v_W = -random.uniform(0.1, 2.0) * from_.command_W.v_W;
    if (random.chance(0.3)) to_.command_W.w_W = -random.uniform(0.1, 2.0) * from_.command_W.w_W;
    if (random.chance(0.3)) to_.command_W = from_.command_W;
    for (size_t i = 0; i < from_.facing.size(); ++i) changeBall(random, i);
  }

  Twist output(double share) const { return limit(at(share)); }
  double radius() const { return from_.limits.tool_radius; }

 private:
  void changeBall(RandomScenes& random, size_t i) {
    keepFree(from_.facing[i]);
    FacingBall& ball = to_.facing[i];
    ball.gap *= random.uniform(0.5, 1.5);
    ball.normal_W = (ball.normal_W + random.uniform(0.0, 0.3) * random.direction()).normalized();
    ball.center_W += 0.1 * radius() * random.direction();
    keepFree(ball);
  }

  // The output jumps only at the standoff: from there a gap must not shrink at all.
  void keepFree(FacingBall& ball) const {
    ball.surface_speed = 0.0;
    ball.gap = std::max(ball.gap, from_.limits.standoff + 1e-3);
  }

  MotionScene at(double share) const {
    const auto between = [&](const auto& a, const auto& b) { return ((1.0 - share) * a + share * b).eval(); };
    MotionScene scene = from_;
    scene.command_W = {between(from_.command_W.v_W, to_.command_W.v_W),
                       between(from_.command_W.w_W, to_.command_W.w_W)};
    for (size_t i = 0; i < scene.facing.size(); ++i) {
      FacingBall& ball = scene.facing[i];
      ball.normal_W = between(ball.normal_W, to_.facing[i].normal_W).normalized();
      ball.center_W = between(ball.center_W, to_.facing[i].center_W);
      ball.gap = (1.0 - share) * ball.gap + share * to_.facing[i].gap;
    }
    return scene;
  }

  MotionScene from_;
  MotionScene to_;
};

struct Jump {
  double from;
  double to;
  double size;
};

Jump largestJump(const Path& path, double from, double to, int steps) {
  Jump largest{from, to, 0.0};
  Twist before = path.output(from);
  for (int i = 0; i < steps; ++i) {
    const double next = from + (to - from) * (i + 1) / steps;
    const Twist after = path.output(next);
    const double size = distance(before, after, path.radius());
    if (size > largest.size) largest = {from + (to - from) * i / steps, next, size};
    before = after;
  }
  return largest;
}

TEST(VelocityLimiterTest, OutputIsContinuousInCommandAndState) {
  RandomScenes random(7, /*least_angle=*/1e-5);
  for (std::uint64_t i = 0, cases = caseCount(50000) / 50; i < cases; ++i) {
    const Path path(random);
    Jump jump = largestJump(path, 0.0, 1.0, 64);
    for (int finer = 0; finer < 10; ++finer) jump = largestJump(path, jump.from, jump.to, 16);
    ASSERT_LT(jump.size, 1e-5) << "path " << i << " at " << jump.from;
  }
}

TEST(VelocityLimiterTest, OppositeParallelAndRepeatedPlanesLeaveTheMotionBetweenThem) {
  const auto wall = [](double x) { return FacingBall{{x, 0.0, 0.0}, Vector3d::Zero(), 0.0, 0.0}; };
  const std::vector<FacingBall> facing = {wall(1.0), wall(-1.0), wall(1.0), wall(-1.0), floorAt(0.04), floorAt(0.04)};
  const Twist output_W = limit({{0.5, 0.3, -0.4}, {0.0, 0.0, 1.0}}, facing);
  EXPECT_TRUE(output_W.v_W.isApprox(Vector3d(0.0, 0.3, output_W.v_W.z()), 1e-12));
  EXPECT_NEAR(-output_W.v_W.z(), limitOf(facing[4], {{0.5, 0.3, -0.4}, {0.0, 0.0, 1.0}}), 1e-12);
  EXPECT_EQ(output_W.w_W, Vector3d::UnitZ());
}

TEST(VelocityLimiterTest, AToolThatTouchesAllAroundRests) {
  std::vector<FacingBall> facing;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {1.0, -1.0}) {
      const Vector3d normal = side * Vector3d::Unit(axis);
      facing.push_back({normal, -0.1 * normal + 0.05 * Vector3d::Unit((axis + 1) % 3), 0.0, 0.0});
      facing.push_back({normal, -0.1 * normal - 0.05 * Vector3d::Unit((axis + 1) % 3), 0.0, 0.0});
    }
  }
  const Twist output_W = limit({{0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}}, facing);
  EXPECT_LT(fastestPoint(output_W, 0.1), 1e-12);
}

TEST(VelocityLimiterTest, NoPlaneAndNoCommandAreNoSpecialCase) {
  const Twist command{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
  EXPECT_TRUE(isEqual(limit(command, {}), command));
  EXPECT_TRUE(isZero(limit({}, {floorAt(0.0), floorAt(-1.0)})));
}

TEST(VelocityLimiterTest, RefusesWhatIsNotFiniteOrOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto message = [](const auto& change) {
    MotionScene scene{{{0.1, 0.0, 0.0}, Vector3d::Zero()}, {kFloor}, {}, kLimits};
    change(scene);
    return refusal([&] { limit(scene); });
  };
  EXPECT_EQ(message([](MotionScene&) {}), "");
  EXPECT_TRUE(has(message([=](auto& s) { s.command_W.v_W.x() = nan; }), "commanded velocity"));
  EXPECT_TRUE(has(message([=](auto& s) { s.command_W.w_W.z() = kInfinity; }), "commanded velocity"));
  EXPECT_TRUE(has(message([=](auto& s) { s.facing[0].normal_W.x() = nan; }), "not a unit vector"));
  EXPECT_TRUE(has(message([=](auto& s) { s.facing[0].normal_W *= 2.0; }), "not a unit vector"));
  EXPECT_TRUE(has(message([=](auto& s) { s.facing[0].center_W.y() = nan; }), "gap"));
  EXPECT_TRUE(has(message([=](auto& s) { s.facing[0].gap = nan; }), "gap"));
  EXPECT_TRUE(has(message([=](auto& s) { s.facing[0].surface_speed = nan; }), "speed of its surface"));
  EXPECT_TRUE(has(message([=](auto& s) { s.uncovered.distance = nan; }), "without a plane"));
  EXPECT_TRUE(has(message([=](auto& s) { s.uncovered.speed = nan; }), "without a plane"));
  EXPECT_TRUE(has(message([=](auto& s) { s.limits.deceleration = 0.0; }), "deceleration"));
  EXPECT_TRUE(has(message([=](auto& s) { s.limits.reaction_time = nan; }), "reaction time"));
  EXPECT_TRUE(has(message([=](auto& s) { s.limits.standoff = -1.0; }), "standoff"));
  EXPECT_TRUE(has(message([=](auto& s) { s.limits.tool_radius = nan; }), "tool radius"));
}

TEST(VelocityLimiterTest, AllocatesNothing) {
  RandomScenes random(8);
  VelocityLimiter limiter(1000);
  for (int i = 0; i < 1000; ++i) {
    const MotionScene scene = random.scene();
    const Allocations allocations;
    limiter.limit(scene.command_W, scene.facing, scene.uncovered, scene.limits);
    ASSERT_EQ(allocations.count(), 0U) << allocations.stacks();
  }
}

}  // namespace
}  // namespace sweep_guard_core
