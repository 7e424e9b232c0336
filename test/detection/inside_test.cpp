#include "detection/inside.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/xyz.h"
#include "scenes.h"
#include "solids.h"

namespace sweep_guard_core {
namespace {

// Edges along the axes, so that a ray along them runs through edges and corners.
TriangleMesh cube(double half, bool flipped = false) {
  std::vector<Eigen::Vector3d> corners;
  corners.reserve(8);
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back((i & 1) != 0 ? half : -half, (i & 2) != 0 ? half : -half, (i & 4) != 0 ? half : -half);
  }
  std::vector<Triangle> triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  if (flipped) std::swap(triangles[3][0], triangles[3][1]);
  return TriangleMesh(corners, triangles);
}

TEST(ClosedTest, IsAMeshWithoutABorder) {
  EXPECT_TRUE(cube(1.0).closed());
  EXPECT_TRUE(wavyHull(8, 12, 0.3).closed());
  std::vector<Triangle> open = cube(1.0).triangles();
  open.pop_back();
  std::vector<Eigen::Vector3d> corners;
  for (size_t i = 0; i < 8; ++i) corners.push_back(cube(1.0).vertex(i));
  EXPECT_FALSE(TriangleMesh(corners, open).closed());
}

TEST(ClosedTest, StaysSoWhenTheMeshDeforms) {
  std::vector<float> positions;
  for (size_t i = 0; i < 8; ++i) {
    for (const double x : xyz(cube(2.0).vertex(i))) positions.push_back(static_cast<float>(x));
  }
  EXPECT_TRUE(deformed(cube(1.0), positions).closed());
}

TEST(InsideTest, OfACubeIsWhereItIsWhateverEdgesTheRayMeets) {
  for (const bool flipped : {false, true}) {
    const TriangleMesh mesh = cube(1.0, flipped);
    for (const double x : {-2.0, -0.5, 0.0, 0.5, 2.0}) {
      for (const double y : {-2.0, -0.5, 0.0, 0.5, 2.0}) {
        for (const double z : {-2.0, -0.5, 0.0, 0.5, 2.0}) {
          const bool expected = std::max({std::abs(x), std::abs(y), std::abs(z)}) < 1.0;
          EXPECT_EQ(inside(mesh, {x, y, z}), expected) << x << ' ' << y << ' ' << z;
        }
      }
    }
  }
}

// Rays run exactly through every vertex, from inside and from beyond either side. As streamed the mesh has its origin
// at 0, so that no digit is lost on the way.
TEST(InsideTest, OfAHullIsWithinItsSurfaceOnEveryRayThroughItsVertices) {
  const TriangleMesh hull = wavyHull(10, 14, 0.7);
  std::vector<float> positions;
  for (size_t i = 0; i < hull.vertexCount(); ++i) {
    for (const double x : xyz(hull.vertex(i))) positions.push_back(static_cast<float>(x));
  }
  const TriangleMesh mesh = deformed(hull, positions);
  int rays = 0;
  for (size_t i = 0; i < mesh.vertexCount(); ++i) {
    const Eigen::Vector3d p = mesh.vertex(i);
    EXPECT_TRUE(inside(mesh, 0.9 * p)) << "vertex " << i;
    EXPECT_FALSE(inside(mesh, 1.1 * p)) << "vertex " << i;
    if (std::abs(p.x()) < 0.04) continue;
    const double out = std::copysign(1e-3, p.x());
    EXPECT_TRUE(inside(mesh, {0.5 * p.x(), p.y(), p.z()})) << "vertex " << i;
    EXPECT_FALSE(inside(mesh, {p.x() + out, p.y(), p.z()})) << "vertex " << i;
    ++rays;
  }
  EXPECT_GT(rays, 50);
}

// The corner that the ray meets comes first or last of all: nothing is to depend on the order of the vertices.
TEST(InsideTest, OfAnOctahedronIsBehindItsCorners) {
  std::vector<Triangle> triangles;
  for (const std::uint32_t x : {0U, 5U}) {
    for (const std::uint32_t y : {1U, 2U}) {
      for (const std::uint32_t z : {3U, 4U}) triangles.push_back({x, y, z});
    }
  }
  const std::vector<Eigen::Vector3d> corners = {{1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {-1, 0, 0}};
  const TriangleMesh mesh(corners, triangles);
  ASSERT_TRUE(mesh.closed());
  EXPECT_TRUE(inside(mesh, {0.0, 0.0, 0.0}));
  EXPECT_TRUE(inside(mesh, {-0.5, 0.0, 0.0}));
  EXPECT_FALSE(inside(mesh, {-1.5, 0.0, 0.0}));
  std::vector<Eigen::Vector3d> turned = corners;
  std::swap(turned.front(), turned.back());
  EXPECT_TRUE(inside(TriangleMesh(turned, triangles), {0.5, 0.0, 0.0}));
}

// The inner shell is reversed against the outer one.
TEST(InsideTest, OfAHollowIsOutside) {
  std::vector<Eigen::Vector3d> corners;
  std::vector<Triangle> triangles;
  for (const double half : {1.0, 0.5}) {
    const auto first = static_cast<std::uint32_t>(corners.size());
    const TriangleMesh shell = cube(half);
    for (size_t i = 0; i < 8; ++i) corners.push_back(shell.vertex(i));
    for (const auto& [a, b, c] : shell.triangles()) {
      const bool is_outer = half == 1.0;
      triangles.push_back({first + a, first + (is_outer ? b : c), first + (is_outer ? c : b)});
    }
  }
  const TriangleMesh hollow(corners, triangles);
  ASSERT_TRUE(hollow.closed());
  EXPECT_FALSE(inside(hollow, {0.1, 0.1, 0.1}));
  EXPECT_TRUE(inside(hollow, {0.75, 0.1, 0.1}));
  EXPECT_FALSE(inside(hollow, {1.25, 0.1, 0.1}));
}

TEST(InsideTest, HoldsAtAnyPlaceAndScale) {
  Random random(/*seed=*/5);
  const TriangleMesh unit = wavyHull(8, 12, 0.0);
  for (int i = 0; i < 200; ++i) {
    const double scale = random.logUniform(1e-3, 1e3);
    const Eigen::Isometry3d X = random.pose(random.logUniform(1e-3, 1e3) * scale * random.direction());
    std::vector<Eigen::Vector3d> corners;
    for (size_t k = 0; k < unit.vertexCount(); ++k) corners.push_back(X * (scale * unit.vertex(k)));
    const TriangleMesh mesh(corners, unit.triangles());
    const Eigen::Vector3d p = unit.vertex(static_cast<size_t>(random.below(static_cast<int>(unit.vertexCount()))));
    EXPECT_TRUE(inside(mesh, X * (0.95 * scale * p)));
    EXPECT_FALSE(inside(mesh, X * (1.05 * scale * p)));
  }
}

bool insideOf(const SentSurface& surface, double x, double y, double z) { return inside(surface.mesh(), {x, y, z}); }

TEST(InsideTest, OfSeparateOrDoubledTrianglesIsThatOfTheSolid) {
  const SentSurface cube = cubeSurface(0.2, 2);
  SentSurface doubled = cube;
  doubled.add(cube.reversed());
  SentSurface three_times = cube.separate();
  three_times.add(cube).add(cube);
  for (const SentSurface& surface : {cube.separate(), cube.reversed().separate(), doubled, three_times}) {
    EXPECT_TRUE(insideOf(surface, 0.0, 0.0, 0.0));
    EXPECT_TRUE(insideOf(surface, 0.1, -0.15, 0.19));
    EXPECT_FALSE(insideOf(surface, 0.1, -0.15, 0.21));
  }
}

TEST(InsideTest, OfSolidsThatOverlapOrLieInEachOtherIsAllOfThem) {
  SentSurface overlapping = cubeSurface(0.5);
  overlapping.add(cubeSurface(0.5).movedBy(0.5, 0.0, 0.0));
  SentSurface nested = cubeSurface(0.5);
  nested.add(cubeSurface(0.2));
  SentSurface reversed = cubeSurface(0.5);
  reversed.add(cubeSurface(0.5).reversed().movedBy(0.5, 0.0, 0.0));
  for (const SentSurface& surface : {overlapping, nested, reversed}) {
    EXPECT_TRUE(insideOf(surface, 0.1, 0.0, 0.0));
    EXPECT_TRUE(insideOf(surface, 0.4, 0.4, 0.4));
    EXPECT_FALSE(insideOf(surface, -0.6, 0.0, 0.0));
  }
}

// One flaw somewhere leaves the rest of the mesh tested.
TEST(InsideTest, IsTestedBesideAFlaw) {
  SentSurface beside_a_sheet = cubeSurface(0.2);
  beside_a_sheet.add(plate(0.3).movedBy(0.0, 0.0, 2.0));
  SentSurface plate_inside = cubeSurface(0.2, 2);
  plate_inside.add(plate(0.2, 2));
  SentSurface plate_apart = cubeSurface(0.2);
  plate_apart.add(plate(0.1));
  for (const SentSurface& surface : {beside_a_sheet, plate_inside, plate_apart, cubeSurface(0.2, 8).without(70)}) {
    EXPECT_TRUE(insideOf(surface, 0.0, 0.05, 0.05));
    EXPECT_TRUE(insideOf(surface, -0.1, 0.1, -0.1));
    EXPECT_FALSE(insideOf(surface, 0.0, 0.0, 0.25));
    EXPECT_FALSE(insideOf(surface, 0.0, 0.0, 1.99));
  }
}

// Its upper face has other corners than the faces beside it.
TEST(InsideTest, OfASurfaceWithTJunctionsIsThatOfTheSolid) {
  SentSurface surface = cubeSurface(0.2, 1);
  surface.triangles.resize(10);
  surface.add(plate(0.2, 3).movedBy(0.0, 0.0, 0.2));
  EXPECT_GT(surface.mesh().openEdges(), 0U);
  for (const double z : {-0.19, -0.1, 0.0, 0.1, 0.199}) EXPECT_TRUE(insideOf(surface, 0.05, -0.1, z)) << z;
  for (const double z : {-0.21, 0.201, 0.3, 3.0}) EXPECT_FALSE(insideOf(surface, 0.05, -0.1, z)) << z;
}

// Right in the plane of the fan that closes the hole, too.
TEST(InsideTest, OfACubeWithoutALidIsUntestedInTheMouthAndOutsideAboveIt) {
  SentSurface open = cubeSurface(0.2);
  open.triangles.resize(10);
  EXPECT_TRUE(insideOf(open, 0.0, 0.0, -0.15));
  for (const double z : {0.2, 0.25, 0.3}) {
    for (const double x : {-0.1, 0.0, 0.05}) EXPECT_FALSE(insideOf(open, x, 0.02, z)) << x << ' ' << z;
  }
}

TEST(InsideTest, OfASheetOrOfASurfaceThatIsSaidToBeOpenIsNothing) {
  for (const double z : {-1e-3, 1e-3}) EXPECT_FALSE(insideOf(plate(1.0, 10), 0.01, 0.02, z));
  EXPECT_FALSE(inside(cubeSurface(0.2).mesh(/*is_sheet=*/true), {0.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace sweep_guard_core
