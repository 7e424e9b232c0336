#include "sweep_guard/geometry/convex_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <thread>
#include <utility>

#include "refusal.h"
#include "scenes.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Points cubeCorners() {
  Points corners;
  for (const double x : {0.0, 1.0}) {
    for (const double y : {0.0, 1.0}) {
      for (const double z : {0.0, 1.0}) corners.emplace_back(x, y, z);
    }
  }
  return corners;
}

Points cloud(Random& random, int count, double size, const Eigen::Vector3d& place) {
  Points points;
  for (int i = 0; i < count; ++i) points.push_back(place + random.inBox(Eigen::Vector3d::Constant(size)));
  return points;
}

bool lexicographic(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

Points sorted(Points points) {
  std::sort(points.begin(), points.end(), lexicographic);
  return points;
}

double reach(const Points& points, const Eigen::Vector3d& direction) {
  double farthest = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& p : points) farthest = std::max(farthest, direction.dot(p - points.front()));
  return farthest + direction.dot(points.front());
}

// Returns the distance [m] of a point outside of the plane of a triangle; NaN for a triangle without area.
double outside(const ConvexHull& hull, const Triangle& triangle, const Eigen::Vector3d& p) {
  const Eigen::Vector3d& a = hull.corners[triangle[0]];
  return (hull.corners[triangle[1]] - a).cross(hull.corners[triangle[2]] - a).normalized().dot(p - a);
}

// Every edge occurs once in each direction, and vertices - edges + faces is 2.
void expectClosed(const ConvexHull& hull) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& [a, b, c] : hull.triangles) {
    for (const auto& edge : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) ++edges[edge];
  }
  for (const auto& [edge, uses] : edges) {
    EXPECT_EQ(uses, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1U);
  }
  EXPECT_EQ(hull.corners.size() + hull.triangles.size(), 2 + edges.size() / 2);
}

// The points reach farther than the corners by no more than the hull tolerance.
void expectHolds(const ConvexHull& hull, const Points& points, Random& random, double rounding) {
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d direction = random.direction();
    EXPECT_LE(reach(points, direction), reach(hull.corners, direction) + hull.hull_tolerance + rounding);
  }
}

void expectCornersAreAmong(const Points& points, const ConvexHull& hull) {
  const Points all = sorted(points);
  for (const Eigen::Vector3d& p : hull.corners) {
    EXPECT_TRUE(std::binary_search(all.begin(), all.end(), p, lexicographic)) << p.transpose();
  }
}

TEST(ConvexHullTest, OfACubeIsItsCorners) {
  Random random(/*seed=*/1);
  Points points = cloud(random, 100, 0.4, Eigen::Vector3d::Constant(0.5));
  for (const Eigen::Vector3d& corner : cubeCorners()) points.push_back(corner);
  const ConvexHull hull = convexHull(points);
  EXPECT_TRUE(hull.solid);
  EXPECT_EQ(sorted(hull.corners), sorted(cubeCorners()));
  EXPECT_EQ(hull.triangles.size(), 12U);
  EXPECT_LT(hull.hull_tolerance, 1e-13);
  EXPECT_NEAR(volume(hull), 1.0, 1e-14);
  expectClosed(hull);
}

// The triangles are counter-clockwise seen from outside: all points lie behind each triangle.
TEST(ConvexHullTest, HoldsEveryPointOfAnyCloudAnywhere) {
  Random random(/*seed=*/2);
  for (int i = 0; i < 200; ++i) {
    const double size = random.logUniform(1e-6, 1e3);
    const Eigen::Vector3d place = random.chance(0.5) ? 1e6 * random.direction() : Eigen::Vector3d::Zero().eval();
    const Points points = cloud(random, 4 + random.below(200), size, place);
    const ConvexHull hull = convexHull(points);
    SCOPED_TRACE("cloud " + std::to_string(i) + " of size " + std::to_string(size) + " with a hull tolerance of " +
                 std::to_string(hull.hull_tolerance));
    const double rounding = 1e-15 * (place.norm() + size);
    expectCornersAreAmong(points, hull);
    expectHolds(hull, points, random, rounding);
    EXPECT_LT(hull.hull_tolerance, 1e-12 * size);
    if (place.norm() / size > 1e10) continue;  // nearer to each other than their rounding: may be flat
    ASSERT_TRUE(hull.solid);
    EXPECT_GT(volume(hull), 0.0);
    expectClosed(hull);
    if (place.norm() > 0.0) continue;
    for (const Triangle& triangle : hull.triangles) {
      for (const Eigen::Vector3d& p : points) EXPECT_FALSE(outside(hull, triangle, p) > 1e-12 * size);
    }
  }
}

// Points on faces and edges are not corners, although rounding puts some of them outside.
TEST(ConvexHullTest, LeavesOutPointsOnTheFacesOfATurnedBox) {
  Random random(/*seed=*/3);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Isometry3d pose = random.pose(10.0 * random.direction());
    Points points;
    for (int x = 0; x <= 8; ++x) {
      for (int y = 0; y <= 8; ++y) {
        for (int z = 0; z <= 8; ++z) points.push_back(pose * Eigen::Vector3d(0.01 * x, 0.01 * y, 0.05 * z));
      }
    }
    const ConvexHull hull = convexHull(points);
    EXPECT_LT(hull.corners.size(), 30U);
    EXPECT_LT(hull.hull_tolerance, 1e-13);
    EXPECT_NEAR(volume(hull), 0.08 * 0.08 * 0.4, 1e-12);
    expectHolds(hull, points, random, 1e-14);
  }
}

TEST(ConvexHullTest, CountsEachPointOnce) {
  Points points = cubeCorners();
  for (const Eigen::Vector3d& corner : cubeCorners()) points.push_back(corner);
  EXPECT_EQ(sorted(convexHull(points).corners), sorted(cubeCorners()));
}

// The hull of a turned square of 5 x 5 points is its four corners in order.
TEST(ConvexHullTest, OfPointsInAPlaneIsAFan) {
  Random random(/*seed=*/4);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Isometry3d pose = random.pose(random.direction());
    Points points;
    for (int x = 0; x < 5; ++x) {
      for (int y = 0; y < 5; ++y) points.push_back(pose * Eigen::Vector3d(0.25 * x, 0.25 * y, 0.0));
    }
    const ConvexHull hull = convexHull(points);
    expectHolds(hull, points, random, 1e-14);
    EXPECT_LT(hull.hull_tolerance, 1e-13);
    EXPECT_NEAR(volume(hull), 0.0, 1e-14);
    if (hull.solid) continue;  // rounding took the points out of their plane
    double area = 0.0;
    for (const auto& [a, b, c] : hull.triangles) {
      area += (hull.corners[b] - hull.corners[a]).cross(hull.corners[c] - hull.corners[a]).norm() / 2.0;
    }
    EXPECT_NEAR(area, 1.0, 1e-12);
  }
}

TEST(ConvexHullTest, OfATriangleIsTheTriangle) {
  const Points corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const ConvexHull hull = convexHull(corners);
  EXPECT_EQ(sorted(hull.corners), sorted(corners));
  EXPECT_EQ(hull.triangles.size(), 1U);
  EXPECT_FALSE(hull.solid);
}

TEST(ConvexHullTest, OfPointsOnALineIsItsTwoEnds) {
  Points points;
  for (int i = 0; i <= 8; ++i) points.emplace_back(0.125 * i, 0.25 * i, 1.0);
  const ConvexHull hull = convexHull(points);
  EXPECT_EQ(sorted(hull.corners), (Points{{0, 0, 1}, {1, 2, 1}}));
  EXPECT_EQ(hull.triangles, (std::vector<Triangle>{{0, 1, 1}}));
  EXPECT_FALSE(hull.solid);
}

TEST(ConvexHullTest, OfOnePointIsThatPoint) {
  const ConvexHull hull = convexHull(Points(5, Eigen::Vector3d(1, 2, 3)));
  EXPECT_EQ(hull.corners, (Points{{1, 2, 3}}));
  EXPECT_EQ(hull.triangles, (std::vector<Triangle>{{0, 0, 0}}));
  EXPECT_EQ(hull.hull_tolerance, 0.0);
}

// From clearly solid to clearly flat to a line: any hull contains the points.
TEST(ConvexHullTest, HoldsPointsThatAreNearlyFlatOrNearlyInLine) {
  Random random(/*seed=*/5);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Isometry3d pose = random.pose(random.direction());
    const Eigen::Vector3d half(1.0, random.logUniform(1e-18, 1.0), random.logUniform(1e-18, 1.0));
    Points points;
    for (int k = 0; k < 60; ++k) points.push_back(pose * random.inBox(half));
    const ConvexHull hull = convexHull(points);
    expectCornersAreAmong(points, hull);
    expectHolds(hull, points, random, 1e-14);
    EXPECT_LE(hull.hull_tolerance, 2e-9);
    EXPECT_FALSE(hull.triangles.empty());
  }
}

TEST(ConvexHullTest, NamesThePointThatIsNotUsable) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -1.1e7}) {
    Points points = cubeCorners();
    points[6].y() = bad;
    EXPECT_TRUE(has(refusal([&] { convexHull(points); }), "point 6 ")) << bad;
  }
  EXPECT_THROW(convexHull({}), InvalidInput);
}

TEST(ConvexHullTest, IsTheSameInEveryThread) {
  Random random(/*seed=*/6);
  const Points points = cloud(random, 300, 1.0, Eigen::Vector3d::Zero());
  const Points expected = convexHull(points).corners;
  std::vector<Points> found(4);
  std::vector<std::thread> threads;
  threads.reserve(found.size());
  for (Points& corners : found) threads.emplace_back([&] { corners = convexHull(points).corners; });
  for (std::thread& thread : threads) thread.join();
  for (const Points& corners : found) EXPECT_EQ(corners, expected);
}

}  // namespace
}  // namespace sweep_guard_core
