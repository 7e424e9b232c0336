#include "sweep_guard/detection/time_of_impact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/rotation_between.h"
#include "geometry/libccd_overlap.h"
#include "scenes.h"
#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

constexpr double kDegree = 0.017453292519943295;

Isometry3d at(const Vector3d& place, const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity()) {
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = turn;
  pose.translation() = place;
  return pose;
}

Eigen::Matrix3d turned(double angle, const Vector3d& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

Motion motion(const Isometry3d& start, const Isometry3d& end) {
  Motion between;
  between.X_MT_start = start;
  between.X_MT_end = end;
  return between;
}

Motion slide(const Vector3d& from, const Vector3d& to, const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity()) {
  return motion(at(from, turn), at(to, turn));
}

MovingTriangle resting(const Corners& corners) { return {corners, corners}; }

Corners placed(const Corners& corners, const Isometry3d& X) { return {X * corners[0], X * corners[1], X * corners[2]}; }

// Large enough to be a plane z = 0, an edge along y = z = 0, and a corner at the origin.
const Corners kPlane = {Vector3d(-10, -10, 0), Vector3d(20, -10, 0), Vector3d(-10, 20, 0)};
const Corners kEdge = {Vector3d(-10, 0, 0), Vector3d(10, 0, 0), Vector3d(0, 0, -10)};
const Corners kCorner = {Vector3d(0, 0, 0), Vector3d(-3, 1, -10), Vector3d(3, 1, -10)};

struct Truth {
  double time_of_impact;
  Vector3d normal;
  double depth;
};

// A case in closed form, at the origin in units of metres.
struct Case {
  const char* name;
  ConvexShape shape_T;
  Motion motion;
  Corners corners;
  Truth truth;
};

const double kRadius = 0.01;
const Vector3d kZ = Vector3d::UnitZ();
const Eigen::Matrix3d kTilt = turned(0.3, Vector3d::UnitX());
const Eigen::Matrix3d kAlongX = turned(90.0 * kDegree, Vector3d::UnitY());

// Everything `scale` times as large.
std::vector<Case> straightCases(double scale = 1.0) {
  const ConvexShape ball = ConvexShape::sphere(scale * kRadius);
  const ConvexShape drill = ConvexShape::cylinder(scale * 0.005, scale * 0.1);
  const ConvexShape box = ConvexShape::box(scale * Vector3d(0.01, 0.02, 0.03));
  const ConvexShape segment = ConvexShape::hull({scale * Vector3d(0, -0.1, 0), scale * Vector3d(0, 0.1, 0)});
  const double tilt = 0.005 * std::sin(0.3) + 0.1 * std::cos(0.3);  // how far it reaches below its tip, upside down
  const Eigen::Matrix3d down = turned(180.0 * kDegree, Vector3d::UnitX());
  const Vector3d off_edge(0.0, 0.6, 0.8);
  const Vector3d aslant(0.48, -0.36, 0.8);
  const Eigen::Matrix3d on_tip = rotationBetween(Vector3d(1, 2, 3), -kZ).matrix();
  const Eigen::Matrix3d across = turned(0.2, kZ) * kAlongX;
  const double root = std::sqrt(14.0);
  const Motion landing = slide({0.001, 0.002, 0.02}, {0.001, 0.002, -0.005}, down);
  std::vector<Case> cases = {
      {"ball on plane", ball, slide({0, 0, 0.05}, {0.01, 0, -0.002}), kPlane, {0.04 / 0.052, kZ, 0.012}},
      {"ball on edge", ball, slide({0, 0.006, 0.048}, {0, 0.006, -0.002}), kEdge, {0.8, off_edge, 0.008}},
      {"ball on corner",
       ball,
       slide({0.0048, -0.0036, 0.048}, {0.0048, -0.0036, -0.002}),
       kCorner,
       {0.8, aslant, 0.008}},
      {"drill's face on plane", drill, slide({0, 0, 0.01}, {0, 0, -0.01}, down), kPlane, {0.5, kZ, 0.01}},
      {"drill's rim on plane", drill, slide({0, 0, tilt + 0.01}, {0, 0, tilt - 0.01}, kTilt), kPlane, {0.5, kZ, 0.01}},
      {"drill's side on plane", drill, slide({0, 0, 0.025}, {0, 0, 0}, kAlongX), kPlane, {0.8, kZ, 0.005}},
      {"drill's side on edge", drill, slide({0.05, 0, 0.025}, {0.05, 0, 0}, across), kEdge, {0.8, kZ, 0.005}},
      {"drill's side on corner",
       drill,
       slide({0.05, 0.003, 0.054}, {0.05, 0.003, 0}, kAlongX),
       kCorner,
       {0.05 / 0.054, off_edge, 0.0032}},
      {"drill's face on corner", drill, landing, kCorner, {0.8, kZ, 0.005}},
      {"drill's face on edge", drill, landing, kEdge, {0.8, kZ, 0.005}},
      {"box's corner on plane", box, slide({0, 0, 0.1}, {0, 0, 0}, on_tip), kPlane, {1 - root / 10, kZ, root / 100}},
      {"point on plane", ConvexShape::hull({{0, 0, 0}}), slide({0, 0, 0.04}, {0, 0, -0.01}), kPlane, {0.8, kZ, 0.01}},
      {"segment on edge", segment, slide({0, 0, 0.04}, {0, 0, -0.01}), kEdge, {0.8, kZ, 0.01}},
  };
  for (Case& c : cases) {
    c.motion.X_MT_start.translation() *= scale;
    c.motion.X_MT_end.translation() *= scale;
    for (Vector3d& p : c.corners) p *= scale;
    c.truth.depth *= scale;
  }
  return cases;
}

void expectTruth(const std::optional<Impact>& impact, const Truth& truth, double scale, double slack) {
  ASSERT_TRUE(impact);
  EXPECT_LE(impact->time_of_impact, truth.time_of_impact + slack);
  EXPECT_GE(impact->time_of_impact, truth.time_of_impact - 1e-4);
  EXPECT_NEAR(impact->depth, truth.depth, 1e-6 * scale);
  EXPECT_LT((impact->normal_M - truth.normal).norm(), 1e-3);
  EXPECT_NEAR(impact->normal_M.norm(), 1.0, 1e-14);
}

TEST(TimeOfImpactTest, IsExactWhereTheToolGoesStraight) {
  for (const Case& c : straightCases()) {
    SCOPED_TRACE(c.name);
    expectTruth(timeOfImpact(c.shape_T, {c.motion}, resting(c.corners), 0.0), c.truth, 1.0, 1e-12);
  }
}

TEST(TimeOfImpactTest, IsExactAtEveryScale) {
  for (const double scale : {1e-3, 1e-2, 1e2, 1e3}) {
    for (const Case& c : straightCases(scale)) {
      SCOPED_TRACE(std::string(c.name) + ", " + std::to_string(scale) + " times as large");
      expectTruth(timeOfImpact(c.shape_T, {c.motion}, resting(c.corners), 0.0), c.truth, scale, 1e-12);
    }
  }
}

// Wherever it is, the oracle's own coordinates are rounded there.
TEST(TimeOfImpactTest, IsTheSameElsewhere) {
  Random random(/*seed=*/1);
  for (const Case& c : straightCases()) {
    for (const double away : {1.0, 1e3, 1e6}) {
      SCOPED_TRACE(std::string(c.name) + ", " + std::to_string(away) + " m away");
      const Isometry3d X = random.pose(away * random.direction());
      Motion there = motion(X * c.motion.X_MT_start, X * c.motion.X_MT_end);
      Truth truth = c.truth;
      truth.normal = X.linear() * truth.normal;
      expectTruth(timeOfImpact(c.shape_T, {there}, resting(placed(c.corners, X)), 0.0), truth, 1.0, 1e-7);
    }
  }
}

TEST(TimeOfImpactTest, StaysOutByTheMarginAndTheDeviationBound) {
  const ConvexShape ball = ConvexShape::sphere(kRadius);
  Motion down = slide({0, 0, 0.05}, {0, 0, 0.012});
  EXPECT_FALSE(timeOfImpact(ball, {down}, resting(kPlane), 0.001));
  down.deviation_bound = 0.003;
  const std::optional<Impact> impact = timeOfImpact(ball, {down}, resting(kPlane), 0.001);
  ASSERT_TRUE(impact);
  EXPECT_NEAR(impact->time_of_impact, 0.036 / 0.038, 1e-4);
  EXPECT_LE(impact->time_of_impact, 0.036 / 0.038);
  EXPECT_EQ(impact->depth, 0.0);
}

TEST(TimeOfImpactTest, IsOfATriangleThatJumpsOverATool) {
  const ConvexShape ball = ConvexShape::sphere(kRadius);
  const Isometry3d rest = at({1.0, 2.0, 0.0});
  MovingTriangle jumping = resting(kPlane);
  for (size_t i = 0; i < 3; ++i) {
    jumping.start_M[i].z() = -0.06;
    jumping.end_M[i].z() = 0.04;
  }
  expectTruth(timeOfImpact(ball, {motion(rest, rest)}, jumping, 0.0), {0.5, kZ, 0.05}, 1.0, 1e-12);
  const Motion along = motion(rest, at({1.0, 2.0, 0.05}));  // so that it closes half as fast
  expectTruth(timeOfImpact(ball, {along}, jumping, 0.0), {1.0, kZ, 0.0}, 1.0, 1e-12);
  const Motion against = motion(rest, at({1.0, 2.0, -0.1}));
  expectTruth(timeOfImpact(ball, {against}, jumping, 0.0), {0.25, kZ, 0.15}, 1.0, 1e-12);
}

TEST(TimeOfImpactTest, IsOfATriangleThatChangesItsShape) {
  const ConvexShape point = ConvexShape::hull({{0, 0, 0}});
  MovingTriangle flap = resting({Vector3d(-1, 1, 0), Vector3d(-1, -1, 0), Vector3d(1, 0, 0)});
  flap.end_M[2].z() = 2.0;  // the middle of the triangle comes up half as fast
  const Isometry3d rest = at({0, 0, 0.6});
  const std::optional<Impact> impact = timeOfImpact(point, {motion(rest, rest)}, flap, 0.0);
  ASSERT_TRUE(impact);
  EXPECT_NEAR(impact->time_of_impact, 0.6, 1e-6);
  EXPECT_LE(impact->time_of_impact, 0.6 + 1e-12);
}

// A point 0.1 m off the axis, turning about z through the origin: it meets the plane y = 0.06 at asin(0.6).
TEST(TimeOfImpactTest, IsExactForAPointThatTurns) {
  const ConvexShape point = ConvexShape::hull({{0.1, 0, 0}});
  const Corners wall = {Vector3d(-10, 0.06, -10), Vector3d(20, 0.06, -10), Vector3d(-10, 0.06, 20)};
  for (const double angle : {50.0, 89.0, 120.0, 175.0}) {
    const Motion turn = motion(at({0, 0, 0}), at({0, 0, 0}, turned(angle * kDegree, kZ)));
    const double end = 0.1 * std::sin(angle * kDegree);
    const Truth truth{std::asin(0.6) / (angle * kDegree), -Vector3d::UnitY(), std::max(0.0, end - 0.06)};
    expectTruth(timeOfImpact(point, split(turn, 90.0 * kDegree), resting(wall), 0.0), truth, 1.0, 1e-12);
  }
}

// The side of a cylinder sweeps round and meets the corner when that is a radius off its axis.
TEST(TimeOfImpactTest, IsExactForACylinderThatTurnsOntoACorner) {
  const ConvexShape drill = ConvexShape::cylinder(0.005, 0.1);
  const Corners corner = {Vector3d(0, 0.05, -0.05), Vector3d(5, 5, -5), Vector3d(-5, 5, -5)};
  const double full = 70.0 * kDegree;
  const Motion turn = motion(at({0, 0, 0}), at({0, 0, 0}, turned(full, Vector3d::UnitX())));
  const double distance = std::hypot(0.05, 0.05);
  const double met = 45.0 * kDegree - std::asin(0.005 / distance);
  const std::optional<Impact> impact = timeOfImpact(drill, split(turn, 10.0 * kDegree), resting(corner), 0.0);
  ASSERT_TRUE(impact);
  EXPECT_LE(impact->time_of_impact, met / full + 1e-12);
  EXPECT_GE(impact->time_of_impact, met / full - 1e-4);
  EXPECT_LT((impact->normal_M - Vector3d(0, -std::cos(met), -std::sin(met))).norm(), 1e-6);
  EXPECT_LT((impact->point_M - corner[0]).norm(), 1e-6);
}

// Against a plane the truth is the first root of the tool's support, here found by dense sampling and bisection.
TEST(TimeOfImpactTest, IsExactForACylinderThatTurnsAboveAPlane) {
  Random random(/*seed=*/2);
  const ConvexShape drill = ConvexShape::cylinder(0.005, 0.1);
  int impacts = 0;
  for (int i = 0; i < 300; ++i) {
    const Isometry3d start = random.pose({0, 0, random.uniform(0.11, 0.15)});
    const Isometry3d end =
        at({0.01, 0, random.uniform(0.0, 0.1)}, random.turn(random.uniform(0.0, 3.0)) * start.linear());
    const Motion trajectory = motion(start, end);
    const auto height = [&](double t) { return -support(drill, trajectory.at(t), -kZ); };
    constexpr int kSamples = 2000;
    int first = 0;
    while (first <= kSamples && height(static_cast<double>(first) / kSamples) > 0.0) ++first;
    const std::optional<Impact> impact = timeOfImpact(drill, split(trajectory, 10.0 * kDegree), resting(kPlane), 0.0);
    if (first > kSamples) {
      continue;
    }
    double low = static_cast<double>(first - 1) / kSamples;
    double high = static_cast<double>(first) / kSamples;
    for (int k = 0; k < 60; ++k) (height(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
    ++impacts;
    ASSERT_TRUE(impact) << i;
    EXPECT_LE(impact->time_of_impact, high + 1e-12) << i;
    EXPECT_GE(impact->time_of_impact, high - 1e-4) << i;
    EXPECT_NEAR(impact->depth, std::max(0.0, -height(1.0)), 1e-6) << i;
    EXPECT_LT((impact->normal_M - kZ).norm(), 1e-6) << i;
  }
  EXPECT_GT(impacts, 50);
}

TEST(TimeOfImpactTest, ProvesThatATouchIsMissedByAMicrometre) {
  const double close = 1e-6;
  const ConvexShape ball = ConvexShape::sphere(kRadius);
  const ConvexShape drill = ConvexShape::cylinder(0.005, 0.1);
  const ConvexShape point = ConvexShape::hull({{0.1, 0, 0}});
  for (const double gap : {close, -close}) {
    const bool met = gap < 0.0;
    const auto meets = [&](const ConvexShape& shape, const Motion& trajectory, const Corners& corners) {
      return timeOfImpact(shape, split(trajectory, 10.0 * kDegree), resting(corners), 0.0).has_value();
    };
    const double height = kRadius + gap;
    EXPECT_EQ(meets(ball, slide({-0.1, 0, height}, {0.1, 0.02, height}), kPlane), met);
    EXPECT_EQ(meets(ball, slide({0, -0.1, height}, {0.01, 0.1, height}), kEdge), met);
    EXPECT_EQ(meets(ball, slide({0, -0.1, height}, {0, 0.1, height}), kCorner), met);
    // A drill that spins, one that turns on its face, one that passes over an edge while it spins.
    const Isometry3d lying = at({0, 0, 0.005 + gap}, kAlongX);
    const Isometry3d spun = at({0, 0, 0.005 + gap}, turned(3.0, Vector3d::UnitX()) * kAlongX);
    EXPECT_EQ(meets(drill, motion(lying, spun), kPlane), met);
    EXPECT_EQ(meets(drill, motion(at({0, 0, 0.1 + gap}), at({0, 0, 0.1 + gap}, turned(3.0, kZ))), kPlane), met);
    Isometry3d left = lying;
    Isometry3d right = spun;
    left.translation().y() = -0.1;
    right.translation().y() = 0.1;
    EXPECT_EQ(meets(drill, motion(left, right), kEdge), met);
    // The arc of a point has its top there.
    const Corners wall = {Vector3d(-10, 0.1 + gap, -10), Vector3d(20, 0.1 + gap, -10), Vector3d(-10, 0.1 + gap, 20)};
    EXPECT_EQ(meets(point, motion(at({0, 0, 0}), at({0, 0, 0}, turned(3.0, kZ))), wall), met);
  }
}

std::optional<Impact> atRest(const ConvexShape& shape, const Isometry3d& pose, const Corners& corners) {
  return timeOfImpact(shape, {motion(pose, pose)}, resting(corners), 0.0);
}

TEST(TimeOfImpactTest, FindsTheLeastDepthWhereToolAndTriangleOverlapAtTheStart) {
  const auto check = [](const std::optional<Impact>& impact, const Vector3d& normal, double depth) {
    ASSERT_TRUE(impact);
    EXPECT_EQ(impact->time_of_impact, 0.0);
    EXPECT_NEAR(impact->depth, depth, 1e-6);
    EXPECT_LT((impact->normal_M - normal).norm(), 1e-3) << impact->normal_M.transpose();
  };
  const ConvexShape ball = ConvexShape::sphere(kRadius);
  const ConvexShape drill = ConvexShape::cylinder(0.005, 0.1);
  check(atRest(ball, at({0, 0, 0.003}), kPlane), kZ, 0.007);
  check(atRest(ball, at({0, 0, -0.003}), kPlane), -kZ, 0.007);
  check(atRest(ball, at({0, 0.0006, 0.0008}), kEdge), {0, 0.6, 0.8}, 0.009);
  check(atRest(ball, at({0.0048, -0.0036, 0.006}), kCorner), Vector3d(0.48, -0.36, 0.6) / std::sqrt(0.72),
        0.01 - 0.01 * std::sqrt(0.72));
  check(atRest(drill, at({0, 0, -0.02}, turned(180 * kDegree, Vector3d::UnitX())), kPlane), kZ, 0.02);
  check(atRest(drill, at({0, 0, 0.02}), kPlane), -kZ, 0.02);
  check(atRest(drill, at({0.05, 0.0, 0.003}, kAlongX), kEdge), kZ, 0.002);
  // Triangles of no area: a segment and a point inside of the ball.
  const Vector3d end(0, 0, 0.004);
  check(atRest(ball, at({0, 0, 0}), {Vector3d(-1, 0, 0.004), Vector3d(1, 0, 0.004), Vector3d(0, 0, 0.004)}), -kZ,
        0.006);
  check(atRest(ball, at({0, 0, 0}), {end, end, end}), -kZ, 0.006);
}

TEST(TimeOfImpactTest, KeepsTheContactNormalWhereToolAndTriangleOverlapAtTheStart) {
  const ConvexShape ball = ConvexShape::sphere(kRadius);
  const Motion push = slide({0, 0, -0.02}, {0, 0, -0.03});
  const std::optional<Impact> impact = timeOfImpact(ball, {push}, resting(kPlane), 0.0, kZ);
  EXPECT_FALSE(impact);  // it has gone through: nothing is met any more
  const Motion within = slide({0, 0, -0.005}, {0, 0, -0.03});
  const std::optional<Impact> kept = timeOfImpact(ball, {within}, resting(kPlane), 0.0, kZ);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->normal_M, kZ);
  EXPECT_NEAR(kept->depth, 0.04, 1e-12);
}

// A drill is pushed into a plane, an edge and a corner, turning and slipping a little; each interval hands its normal
// on.
TEST(TimeOfImpactTest, ChangesDepthAndNormalContinuouslyAlongAPushIn) {
  const ConvexShape drill = ConvexShape::cylinder(0.005, 0.1);
  const Motion whole =
      motion(at({0.001, -0.0276, 0.115}, kTilt), at({0.002, -0.0286, 0.09}, turned(0.02, {1, 2, 3}) * kTilt));
  constexpr int kSteps = 2000;
  for (const Corners& corners : {kPlane, kEdge, kCorner}) {
    std::optional<Impact> before;
    double deepest = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const Motion step = motion(whole.at(static_cast<double>(i) / kSteps), whole.at((i + 1.0) / kSteps));
      const std::optional<Impact> impact = timeOfImpact(
          drill, {step}, resting(corners), 0.0, before ? std::optional<Vector3d>(before->normal_M) : std::nullopt);
      if (before) {
        ASSERT_TRUE(impact) << i;
        EXPECT_LT(std::abs(impact->depth - before->depth), 5e-5) << i;
        EXPECT_LT((impact->normal_M - before->normal_M).norm(), 1e-3) << i;
      }
      if (impact) {
        deepest = std::max(deepest, impact->depth);
        before = impact;
      }
    }
    EXPECT_GT(deepest, 0.003);
  }
}

ConvexShape randomShape(Random& random) {
  switch (random.below(5)) {
    case 0:
      return ConvexShape::sphere(random.uniform(0.1, 1.0));
    case 1:
      return ConvexShape::box({random.uniform(0.1, 1.0), random.uniform(0.1, 1.0), random.uniform(0.1, 1.0)});
    case 2:
      return ConvexShape::hull({random.direction(), random.direction(), random.direction(), random.direction()});
    default:
      return ConvexShape::cylinder(random.uniform(0.05, 0.5), random.uniform(0.1, 2.0));
  }
}

struct Trial {
  ConvexShape shape_T;
  Motion motion;
  MovingTriangle triangle;
};

Trial randomTrial(Random& random) {
  const ConvexShape shape = randomShape(random);
  Trial trial{shape, {}, {}};
  const Isometry3d start = random.pose(3.0 * random.direction());
  const Eigen::Matrix3d turn = random.turn(random.uniform(0.0, 175.0) * kDegree);
  trial.motion = motion(start, at(random.uniform(0.0, 3.0) * random.direction(), turn * start.linear()));
  const double size = random.logUniform(0.03, 3.0);
  for (size_t i = 0; i < 3; ++i) {
    trial.triangle.start_M[i] = size * random.direction();
    trial.triangle.end_M[i] = trial.triangle.start_M[i];
    if (random.chance(0.5)) trial.triangle.end_M[i] += random.uniform(0.0, 1.0) * random.direction();
  }
  return trial;
}

// Shrunk by 1e-6, so that what libccd sees overlap does overlap.
struct Shrunk {
  const ConvexShape& shape_T;
  Isometry3d X_MT;
  Vector3d supportPoint(const Vector3d& direction) const {
    const Vector3d p = shape_T.supportPoint(X_MT.linear().transpose() * direction);
    const Vector3d middle = 0.5 * (shape_T.supportPoint(Vector3d::UnitX()) + shape_T.supportPoint(-Vector3d::UnitX()));
    return X_MT * (middle + (1.0 - 1e-6) * (p - middle));
  }
};

Corners cornersAt(const MovingTriangle& triangle, double t) {
  Corners corners;
  for (size_t i = 0; i < 3; ++i) corners[i] = (1.0 - t) * triangle.start_M[i] + t * triangle.end_M[i];
  return corners;
}

TEST(TimeOfImpactTest, MissesNoSampledOverlapHoweverToolAndTriangleMove) {
  Random random(/*seed=*/3);
  int impacts = 0;
  double earliest = 0.0;
  constexpr int kSamples = 100;
  for (int i = 0; i < 3000; ++i) {
    const Trial trial = randomTrial(random);
    const std::optional<Impact> impact =
        timeOfImpact(trial.shape_T, split(trial.motion, 90.0 * kDegree), trial.triangle, 0.0);
    for (int k = 0; k <= kSamples; ++k) {
      const double t = static_cast<double>(k) / kSamples;
      const Shrunk tool{trial.shape_T, trial.motion.at(t)};
      if (!overlapByLibccd(tool, PointHull(cornersAt(trial.triangle, t)))) continue;
      ASSERT_TRUE(impact) << i;
      ASSERT_LE(impact->time_of_impact, t + 1e-12) << i;
      break;
    }
    if (!impact) continue;
    ++impacts;
    const Isometry3d X_MT = trial.motion.at(impact->time_of_impact);
    const ConvexShape tool = trial.shape_T.placed(X_MT);
    const PointHull triangle(cornersAt(trial.triangle, impact->time_of_impact));
    EXPECT_LE(separation(tool, triangle).gap, 1e-7) << i;  // they do touch then
    earliest = std::max(earliest, separation(tool, triangle).gap);
  }
  EXPECT_GT(impacts, 500);
  EXPECT_LT(impacts, 2500);
  RecordProperty("farthest_apart_at_impact", std::to_string(earliest));
}

}  // namespace
}  // namespace sweep_guard_core
