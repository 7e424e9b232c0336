#include "sweep_guard/geometry/separation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/libccd_overlap.h"
#include "scenes.h"

namespace sweep_guard_core {
namespace {

using Eigen::Vector3d;

// A cylinder with z from -length to 0: its distances to points, lines and planes have a closed form.
struct Cylinder {
  double radius;
  double length;
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();

  Vector3d supportPoint(const Vector3d& direction) const {
    const Vector3d d = X.linear().transpose() * direction;
    const double across = d.head<2>().norm();
    Vector3d p(0.0, 0.0, d.z() < 0.0 ? -length : 0.0);
    if (across > 0.0) p.head<2>() = radius * d.head<2>() / across;
    return X * p;
  }
  double distance(const Vector3d& p) const {
    const Vector3d p_T = X.inverse() * p;
    const double across = std::max(p_T.head<2>().norm() - radius, 0.0);
    return std::hypot(across, std::max({p_T.z(), -length - p_T.z(), 0.0}));
  }
};

struct Ball {
  double radius;
  Vector3d center;

  Vector3d supportPoint(const Vector3d& direction) const { return center + radius * direction; }
};

struct Both {
  const SupportMapping a;
  const SupportMapping b;

  Vector3d supportPoint(const Vector3d& direction) const {
    const Vector3d p = a.supportPoint(direction);
    const Vector3d q = b.supportPoint(direction);
    return direction.dot(p) < direction.dot(q) ? q : p;
  }
};

using Corners = std::array<Vector3d, 3>;

Corners randomCorners(Random& random, double size) {
  Corners corners;
  for (Vector3d& p : corners) p = size * random.direction();
  return corners;
}

// Makes a random body: one in eight is a needle, one in eight a segment, one in eight a point.
Corners randomTriangle(Random& random, double size) {
  Corners corners = randomCorners(random, size);
  switch (random.below(8)) {
    case 0:
      corners[2] = 0.5 * (corners[0] + corners[1]) + 1e-9 * size * random.direction();
      break;
    case 1:
      corners[2] = corners[1];
      break;
    case 2:
      corners[1] = corners[2] = corners[0];
      break;
    default:
      break;
  }
  return corners;
}

Cylinder randomCylinder(Random& random, const Vector3d& place) {
  Cylinder cylinder{random.uniform(0.0, 1.0), random.uniform(0.0, 2.0), random.pose(place)};
  if (random.chance(0.125)) cylinder.radius = 0.0;
  if (random.chance(0.125)) cylinder.length = 0.0;
  return cylinder;
}

double pointDistance(const Separation& answer) { return (answer.on_tool - answer.on_obstacle).norm(); }

double provenBy(const Vector3d& normal, const SupportMapping& tool, const SupportMapping& obstacle) {
  return normal.dot(tool.supportPoint(-normal) - obstacle.supportPoint(normal));
}

TEST(SeparationTest, MeasuresABallToCornerEdgeAndFace) {
  const PointHull triangle(Corners{Vector3d(0, 0, 0), Vector3d(4, 0, 0), Vector3d(0, 4, 0)});
  const auto check = [&](const Vector3d& center, double distance, const Vector3d& normal, const Vector3d& closest) {
    const Separation answer = separation(Ball{1.0, center}, triangle);
    EXPECT_NEAR(answer.gap, distance, 1e-14);
    EXPECT_NEAR(pointDistance(answer), distance, 1e-14);
    EXPECT_TRUE(answer.normal.isApprox(normal, 1e-7)) << answer.normal.transpose();
    EXPECT_NEAR((answer.on_obstacle - closest).norm(), 0.0, 1e-7);
  };
  check({1, 1, 3}, 2.0, Vector3d::UnitZ(), {1, 1, 0});
  check({1, 1, -3}, 2.0, -Vector3d::UnitZ(), {1, 1, 0});
  check({1, -3, 4}, 4.0, {0.0, -0.6, 0.8}, {1, 0, 0});
  check({-2, -4, 4}, 5.0, Vector3d(-1, -2, 2) / 3.0, {0, 0, 0});
}

TEST(SeparationTest, MeasuresACylinderToAPoint) {
  Random random(/*seed=*/1);
  for (int i = 0; i < 2000; ++i) {
    const Vector3d p = 3.0 * random.direction();
    const Cylinder cylinder = randomCylinder(random, random.direction());
    const double truth = cylinder.distance(p);
    if (truth == 0.0) continue;
    const Separation answer = separation(cylinder, PointHull(std::array<Vector3d, 1>{p}));
    EXPECT_NEAR(answer.gap, truth, 1e-11) << i;
    EXPECT_NEAR(pointDistance(answer), truth, 1e-11) << i;
  }
}

// The two bounds enclose the distance, so their agreement proves both.
TEST(SeparationTest, GapEqualsTheDistanceOfItsPoints) {
  Random random(/*seed=*/2);
  for (const double away : {1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10}) {
    for (int i = 0; i < 2000 && !HasFailure(); ++i) {
      SCOPED_TRACE(std::to_string(away) + " m, pair " + std::to_string(i));
      const PointHull triangle(randomTriangle(random, random.logUniform(1e-2, 1e1)));
      Cylinder cylinder = randomCylinder(random, Vector3d::Zero());
      const Vector3d direction = random.direction();
      cylinder.X.translation() +=
          triangle.supportPoint(direction) - cylinder.supportPoint(-direction) + away * direction;
      const Separation answer = separation(cylinder, triangle);
      EXPECT_NEAR(answer.normal.norm(), 1.0, 1e-15);
      EXPECT_GE(answer.gap, 0.999 * away - 1e-11);
      EXPECT_NEAR(answer.gap, pointDistance(answer), 1e-8);
      EXPECT_NEAR(answer.gap, provenBy(answer.normal, cylinder, triangle), 1e-14);
    }
  }
}

// Points of the bodies at a nearby pose, moved with them, and any other points of the bodies.
TEST(SeparationTest, IsTheSameFromAnyPointsOfBothBodies) {
  Random random(/*seed=*/9);
  for (int i = 0; i < 4000 && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const PointHull triangle(randomTriangle(random, 1.0));
    Cylinder cylinder = randomCylinder(random, Vector3d::Zero());
    const Vector3d direction = random.direction();
    const double away = random.logUniform(1e-6, 1.0);
    cylinder.X.translation() += triangle.supportPoint(direction) - cylinder.supportPoint(-direction) + away * direction;
    PointPairs start;
    if (i % 2 == 0) {
      start = separation(cylinder, triangle).simplex;
      const Vector3d step = 0.5 * away * random.direction();
      cylinder.X.translation() += step;
      for (PointPair& pair : start) pair.on_tool += step;
    } else {
      for (int j = random.below(5); j > 0; --j) {
        start.push_back({cylinder.supportPoint(random.direction()), triangle.supportPoint(random.direction())});
      }
    }
    const Separation cold = separation(cylinder, triangle);
    const Separation warm = separation(cylinder, triangle, 0.0, Vector3d::Zero(), start);
    EXPECT_NEAR(warm.gap, cold.gap, 1e-8);
    EXPECT_NEAR(warm.gap, pointDistance(warm), 1e-8);
    EXPECT_NEAR(warm.gap, provenBy(warm.normal, cylinder, triangle), 1e-14);
  }
}

TEST(SeparationTest, IsNeverMoreThanTheDistanceOfAnyTwoPoints) {
  Random random(/*seed=*/3);
  for (int i = 0; i < 300; ++i) {
    const Corners corners = randomTriangle(random, 2.0);
    const Cylinder cylinder = randomCylinder(random, 2.0 * random.direction());
    double nearest = std::numeric_limits<double>::infinity();
    const int steps = 60;
    for (int j = 0; j <= steps; ++j) {
      for (int k = 0; k <= steps - j; ++k) {
        const double u = static_cast<double>(j) / steps;
        const double v = static_cast<double>(k) / steps;
        nearest = std::min(nearest, cylinder.distance((1.0 - u - v) * corners[0] + u * corners[1] + v * corners[2]));
      }
    }
    const double gap = separation(cylinder, PointHull(corners)).gap;
    EXPECT_LE(gap, nearest + 1e-12) << i;
    if (nearest > 0.1) {
      EXPECT_GE(gap, nearest - 0.05) << i;
    }
  }
}

TEST(SeparationTest, ProvesNothingWhereBodiesOverlap) {
  Random random(/*seed=*/4);
  for (int i = 0; i < 2000; ++i) {
    const Corners corners = randomTriangle(random, 2.0);
    Cylinder cylinder = randomCylinder(random, Vector3d::Zero());
    const Vector3d inside = cylinder.X * Vector3d(0.0, 0.0, random.uniform(-cylinder.length, 0.0));
    cylinder.X.translation() += (corners[0] + corners[1] + corners[2]) / 3.0 - inside;
    const Separation answer = separation(cylinder, PointHull(corners));
    EXPECT_LE(answer.gap, 1e-14) << i;
    EXPECT_LE(pointDistance(answer), 1e-5) << i;  // the weights of a needle have few digits
    EXPECT_FALSE(distanceExceeds(cylinder, PointHull(corners), 1e-14)) << i;
  }
}

// The hulls of a triangle before and after a deformation and of a tool at two poses.
TEST(SeparationTest, TakesHullsOfTwoBodies) {
  PointHull prism(Corners{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)});
  for (const Vector3d& p : {Vector3d(0, 0, 2), Vector3d(1, 0, 2), Vector3d(0, 1, 2)}) prism.add(p);
  const Ball start{0.25, {-2.0, 0.5, 1.5}};
  const Ball end{0.25, {-2.0, 0.5, -7.0}};
  EXPECT_NEAR(separation(Both{start, end}, prism).gap, 1.75, 1e-12);
  EXPECT_NEAR(separation(Ball{0.5, {2, 2, 1}}, prism).gap, std::sqrt(4.5) - 0.5, 1e-12);
}

TEST(SeparationTest, StopsAtTheRequestedAccuracy) {
  Random random(/*seed=*/5);
  for (int i = 0; i < 2000; ++i) {
    const PointHull triangle(randomTriangle(random, 1.0));
    const Cylinder cylinder = randomCylinder(random, 4.0 * random.direction());
    const Separation exact = separation(cylinder, triangle);
    const Separation rough = separation(cylinder, triangle, /*accuracy=*/0.01, random.direction());
    EXPECT_LE(rough.gap, exact.gap + 1e-9) << i;
    EXPECT_GE(rough.gap, exact.gap - 0.01 - 1e-9) << i;
  }
}

TEST(RoughSeparationTest, UnderestimatesByAnEighthBeyondTheMargin) {
  Random random(/*seed=*/8);
  for (int i = 0; i < 2000; ++i) {
    const PointHull triangle(randomTriangle(random, 1.0));
    const Cylinder cylinder = randomCylinder(random, 4.0 * random.direction());
    const double gap = separation(cylinder, triangle).gap;
    const double margin = random.uniform(0.0, 1.0);
    const double rough = roughSeparation(cylinder, triangle, margin, /*accuracy=*/1e-6, random.direction()).gap;
    EXPECT_LE(rough, gap + 1e-9) << i;
    EXPECT_GE(rough, gap - std::max(1e-6, 0.125 * (gap - margin)) - 1e-9) << i;
  }
}

TEST(DistanceExceedsTest, ComparesTheGap) {
  Random random(/*seed=*/6);
  for (int i = 0; i < 5000; ++i) {
    const PointHull triangle(randomTriangle(random, 1.0));
    const Cylinder cylinder = randomCylinder(random, 2.0 * random.direction());
    const double gap = separation(cylinder, triangle).gap;
    for (const double distance : {0.0, 0.1, gap - 1e-7, gap + 1e-7}) {
      if (distance < 0.0 || std::abs(gap - distance) < 1e-8) continue;
      EXPECT_EQ(distanceExceeds(cylinder, triangle, distance, random.direction()), gap > distance) << i;
    }
  }
}

// Skips distances that libccd takes for zero.
TEST(SeparationTest, AgreesWithLibccd) {
  Random random(/*seed=*/7);
  int overlapping = 0;
  for (int i = 0; i < 20000; ++i) {
    const PointHull triangle(randomCorners(random, 1.0));
    const Cylinder cylinder{random.uniform(0.1, 1.0), random.uniform(0.1, 2.0), random.pose(1.5 * random.direction())};
    const double gap = separation(cylinder, triangle).gap;
    if (std::abs(gap) < 1e-6) continue;
    EXPECT_EQ(gap <= 0.0, overlapByLibccd(cylinder, triangle)) << i << ", gap " << gap;
    overlapping += gap <= 0.0 ? 1 : 0;
  }
  EXPECT_GT(overlapping, 1000);
  EXPECT_LT(overlapping, 15000);
}

}  // namespace
}  // namespace sweep_guard_core
