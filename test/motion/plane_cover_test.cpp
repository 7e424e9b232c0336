#include "sweep_guard/motion/plane_cover.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "motion/random_scenes.h"
#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {
namespace {

using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

const ConvexShape kTool = ConvexShape::sphere(0.01);
const UncoveredSurfaces kBeyond{0.2, 0.0};
const Corners kAtRest = {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};

NearTriangle nearTriangle(const Corners& corners_W, size_t piece = 0, const Corners& velocities_W = kAtRest) {
  const Separation apart = separation(kTool, PointHull(corners_W));
  return {piece, corners_W, velocities_W, apart.normal, apart.gap};
}

// A square of 2 * 20 * 20 triangles with corners that are moved out by up to `bumps`, at the end of R_WS z.
std::vector<NearTriangle> wall(const Eigen::Matrix3d& R_WS, double distance, double bumps, RandomScenes& random) {
  constexpr int kCells = 20;
  const auto corner = [&](int i, int j) {
    return Vector3d(R_WS *
                    Vector3d(0.01 * (i - kCells / 2), 0.01 * (j - kCells / 2), distance + random.uniform(0.0, bumps)));
  };
  std::vector<NearTriangle> triangles;
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      triangles.push_back(nearTriangle({corner(i, j), corner(i + 1, j), corner(i, j + 1)}));
      triangles.push_back(nearTriangle({corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)}));
    }
  }
  return triangles;
}

Eigen::Matrix3d turned(double angle, const Vector3d& axis) { return Eigen::AngleAxisd(angle, axis).toRotationMatrix(); }

bool isBehind(const NearTriangle& triangle, const SeparatingPlane& plane) {
  const auto behind = [&](const Vector3d& corner) { return plane.normal_W.dot(corner - plane.point_W) <= 1e-12; };
  const auto slower = [&](const Vector3d& velocity) { return plane.normal_W.dot(velocity) <= plane.surface_speed; };
  return triangle.piece == plane.piece && std::all_of(triangle.corners_W.begin(), triangle.corners_W.end(), behind) &&
         std::all_of(triangle.velocities_W.begin(), triangle.velocities_W.end(), slower);
}

bool isCovered(const NearTriangle& triangle, const PlaneCover& cover) {
  const auto behind = [&](const SeparatingPlane& plane) { return isBehind(triangle, plane); };
  return std::any_of(cover.planes.begin(), cover.planes.end(), behind);
}

TEST(PlaneCoverTest, OnePlaneStandsForAFlatWall) {
  RandomScenes random(1);
  const PlaneCover cover = coverByPlanes(wall(turned(1.0, {0.6, 0.0, 0.8}), 0.05, 0.0, random), kBeyond);
  ASSERT_EQ(cover.planes.size(), 1U);
  EXPECT_NEAR(cover.planes[0].gap, 0.04, 1e-6);
  EXPECT_EQ(cover.uncovered.distance, kBeyond.distance);
}

TEST(PlaneCoverTest, FewPlanesStandForABumpyWall) {
  RandomScenes random(2);
  const PlaneCover cover = coverByPlanes(wall(Eigen::Matrix3d::Identity(), 0.05, 0.001, random), kBeyond);
  EXPECT_LE(cover.planes.size(), 3U);
  EXPECT_GE(cover.planes[0].gap, 0.95 * 0.04);
}

TEST(PlaneCoverTest, AnEdgeNeedsTwoPlanes) {
  RandomScenes random(3);
  auto triangles = wall(Eigen::Matrix3d::Identity(), 0.05, 0.0, random);
  const auto other = wall(turned(M_PI / 2.0, Vector3d::UnitX()), 0.07, 0.0, random);
  triangles.insert(triangles.end(), other.begin(), other.end());
  const PlaneCover cover = coverByPlanes(triangles, kBeyond);
  ASSERT_EQ(cover.planes.size(), 2U);
  EXPECT_NEAR(cover.planes[0].gap, 0.04, 1e-6);
  EXPECT_NEAR(cover.planes[1].gap, 0.06, 1e-6);
}

TEST(PlaneCoverTest, APlaneStandsForTrianglesOfItsPieceOnly) {
  const Corners corners = {Vector3d(0.0, 0.0, 0.1), Vector3d(0.1, 0.0, 0.1), Vector3d(0.0, 0.1, 0.1)};
  EXPECT_EQ(coverByPlanes({nearTriangle(corners, 0), nearTriangle(corners, 1)}, kBeyond).planes.size(), 2U);
  EXPECT_EQ(coverByPlanes({nearTriangle(corners, 0), nearTriangle(corners, 0)}, kBeyond).planes.size(), 1U);
}

TEST(PlaneCoverTest, NoTriangleGivesNoPlane) {
  const PlaneCover cover = coverByPlanes({}, {0.1, 0.2});
  EXPECT_TRUE(cover.planes.empty());
  EXPECT_EQ(cover.uncovered.distance, 0.1);
  EXPECT_EQ(cover.uncovered.speed, 0.2);
}

std::vector<NearTriangle> drawTriangles(RandomScenes& random) {
  std::vector<NearTriangle> triangles;
  const size_t count = 1 + random.count(300);
  for (size_t i = 0; i < count; ++i) {
    const Vector3d center = random.uniform(0.03, 0.15) * random.direction();
    Corners corners;
    Corners velocities = kAtRest;
    for (Vector3d& corner : corners) corner = center + 0.015 * random.direction();
    if (random.chance(0.5)) velocities[random.count(3)] = random.uniform(0.0, 0.3) * random.direction();
    triangles.push_back(nearTriangle(corners, random.count(2), velocities));
  }
  return triangles;
}

TEST(PlaneCoverTest, EachTriangleIsBehindAPlaneOrBoundsTheSpeedAsAWhole) {
  RandomScenes random(4);
  size_t left_over = 0;
  for (int i = 0; i < 300; ++i) {
    const auto triangles = drawTriangles(random);
    const PlaneCover cover = coverByPlanes(triangles, kBeyond, /*max_planes=*/20);
    ASSERT_LE(cover.planes.size(), 20U);
    ASSERT_EQ(cover.planes.size(), cover.triangles.size());
    for (const NearTriangle& triangle : triangles) {
      if (isCovered(triangle, cover)) continue;
      ++left_over;
      ASSERT_LE(cover.uncovered.distance, triangle.gap);
      for (const Vector3d& velocity : triangle.velocities_W) ASSERT_LE(velocity.norm(), cover.uncovered.speed);
    }
  }
  EXPECT_GT(left_over, 100U);
}

TEST(PlaneCoverTest, TheToolIsInFrontOfEachPlaneByItsGap) {
  RandomScenes random(5);
  for (int i = 0; i < 300; ++i) {
    const auto triangles = drawTriangles(random);
    const PlaneCover cover = coverByPlanes(triangles, kBeyond);
    for (size_t k = 0; k < cover.planes.size(); ++k) {
      const SeparatingPlane& plane = cover.planes[k];
      const double gap = -kTool.support(-plane.normal_W) - plane.normal_W.dot(plane.point_W);
      ASSERT_NEAR(gap, plane.gap, 1e-12);
      ASSERT_LE(plane.gap, triangles[cover.triangles[k]].gap);
      ASSERT_GE(plane.gap, 0.95 * triangles[cover.triangles[k]].gap - 1e-12);
    }
  }
}

}  // namespace
}  // namespace sweep_guard_core
