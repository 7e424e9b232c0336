#include "sweep_guard/interaction/interpenetration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "allocations.h"
#include "interaction_scenes.h"

namespace sweep_guard_core {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

const Vector3d kHalfPiece(0.01, 0.02, 0.03);  // of a box as a piece [m]

Interpenetration find(const ConvexShape& shape_T, const TriangleMesh& mesh_M, const Isometry3d& X_MT) {
  return InterpenetrationFinder(shape_T).find(mesh_M, X_MT);
}

struct Tolerances {
  double volume, centroid, area, reach;
};

// Of a box as a piece, whose lower centimeter is pressed into a face.
void expectLowerCentimeter(const Interpenetration& found, const Tolerances& within) {
  EXPECT_NEAR(found.volume, 0.02 * 0.04 * 0.01, within.volume);
  EXPECT_TRUE(found.centroid_T.isApprox(Vector3d(0.0, 0.0, -0.025), within.centroid)) << found.centroid_T.transpose();
  EXPECT_TRUE(found.area_T.isApprox(Vector3d(0.0, 0.0, 0.02 * 0.04), within.area)) << found.area_T.transpose();
  EXPECT_NEAR(found.reach, 0.01, within.reach);
}

TEST(PieceVolumeTest, IsThatOfTheShape) {
  const auto volume = [](const ConvexShape& shape_T) { return InterpenetrationFinder(shape_T).pieceVolume(); };
  EXPECT_NEAR(volume(ConvexShape::box(kHalfPiece)), 8.0 * kHalfPiece.prod(), 1e-18);
  EXPECT_NEAR(volume(ConvexShape::cylinder(0.01, 0.1)), M_PI * 1e-5, 1e-17);
  EXPECT_NEAR(volume(ConvexShape::cylinder(0.01, 0.1, 3)), M_PI * 1e-5, 1e-17);
  EXPECT_NEAR(volume(ConvexShape::sphere(0.01)), 4.0 / 3.0 * M_PI * 1e-6, 1e-13);
  EXPECT_NEAR(volume(ConvexShape::box(kHalfPiece).padded(0.01)), 8.0 * 0.02 * 0.03 * 0.04, 1e-18);
  EXPECT_NEAR(volume(ConvexShape::cylinder(0.01, 0.1).padded(0.01)), M_PI * 4e-4 * 0.12, 1e-16);
  const ConvexShape tetrahedron = ConvexShape::hull({{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}});
  EXPECT_NEAR(volume(tetrahedron), 1e-3 / 6.0, 1e-10);
  const ConvexShape capsule = ConvexShape::hull({{0, 0, 0}, {0, 0, 0.1}}).padded(0.01);
  const double round = M_PI * 1e-4 * 0.1 + 4.0 / 3.0 * M_PI * 1e-6;
  EXPECT_NEAR(volume(capsule), round, 0.06 * round);
}

TEST(PieceVolumeTest, OfAFlatPieceIsZero) {
  const ConvexShape flat = ConvexShape::hull({{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}});
  InterpenetrationFinder finder(flat);
  EXPECT_EQ(finder.pieceVolume(), 0.0);
  EXPECT_EQ(finder.find(boxMesh({1, 1, 1}), Isometry3d::Identity()).volume, 0.0);
}

TEST(InterpenetrationTest, OfABoxPressedIntoAFaceIsItsPartBehindTheFace) {
  for (const bool inside_out : {false, true}) {
    const TriangleMesh mesh = boxMesh({1.0, 1.0, 1.0}, inside_out);
    const Interpenetration found = find(ConvexShape::box(kHalfPiece), mesh, placedAt(0.1, 0.2, 1.02));
    EXPECT_TRUE(found.enclosed);
    expectLowerCentimeter(found, {1e-18, 1e-11, 1e-12, 1e-14});
  }
}

TEST(InterpenetrationTest, CountsFacesThatAreThereTwiceOnce) {
  const TriangleMesh box = boxMesh({1.0, 1.0, 1.0});
  std::vector<Vector3d> corners;
  for (size_t i = 0; i < 8; ++i) corners.push_back(box.vertex(i));
  for (const bool reversed : {false, true}) {
    std::vector<Triangle> triangles = box.triangles();
    for (const auto& [a, b, c] : box.triangles()) triangles.push_back(reversed ? Triangle{a, c, b} : Triangle{a, b, c});
    const Interpenetration found =
        find(ConvexShape::box(kHalfPiece), TriangleMesh(corners, triangles), placedAt(0.1, 0.2, 1.02));
    EXPECT_TRUE(found.enclosed);
    EXPECT_NEAR(found.volume, 0.02 * 0.04 * 0.01, 1e-18);
    EXPECT_NEAR(found.area_T.z(), 0.02 * 0.04, 1e-12);
  }
}

TEST(InterpenetrationTest, OfAPieceThatTouchesNoTriangleIsAllOrNothing) {
  const ConvexShape box = ConvexShape::box(kHalfPiece);
  const TriangleMesh mesh = boxMesh({1.0, 1.0, 1.0});
  const Interpenetration inside = find(box, mesh, placedAt(0.1, 0.2, 0.3));
  EXPECT_NEAR(inside.volume, 8.0 * kHalfPiece.prod(), 1e-17);
  EXPECT_LT(inside.centroid_T.norm(), 1e-12);
  EXPECT_LT(inside.area_T.norm(), 1e-18);
  for (const Isometry3d& X_MT : {placedAt(2.0, 0.0, 0.0), placedAt(0.0, 0.0, 2.0), placedAt(0.0, 0.0, -2.0)}) {
    EXPECT_EQ(find(box, mesh, X_MT).volume, 0.0);
  }
}

TEST(InterpenetrationTest, HasNoAreaWhereThePiecePiercesAPlate) {
  const TriangleMesh plate = boxMesh({1.0, 1.0, 0.005});
  const Interpenetration found = find(ConvexShape::cylinder(0.01, 0.1), plate, placedAt(0.1, 0.2, 0.05));
  EXPECT_NEAR(found.volume, M_PI * 1e-4 * 0.01, 1e-13);  // float32 rounds the half thickness
  EXPECT_LT(found.area_T.norm(), 1e-17);
  EXPECT_LT(found.depth(1e-6), 1e-12);
}

TEST(InterpenetrationTest, WithAnOpenMeshIsWhatLiesBehindIt) {
  for (const std::uint32_t cells : {1U, 40U}) {
    const TriangleMesh mesh = sheet(0.1, cells);
    const Interpenetration found = find(ConvexShape::box(kHalfPiece), mesh, placedAt(0.011, 0.012, 0.02));
    EXPECT_FALSE(found.enclosed);
    expectLowerCentimeter(found, {1e-17, 1e-9, 1e-9, 1e-12});
    EXPECT_EQ(find(ConvexShape::box(kHalfPiece), mesh, placedAt(0.0, 0.0, -0.04)).volume, 0.0);
  }
}

TEST(InterpenetrationTest, WithTrianglesThatWindDifferentlyIsThatWithTheSolid) {
  const TriangleMesh right = boxMesh({1.0, 1.0, 1.0});
  std::vector<Triangle> triangles = right.triangles();
  std::swap(triangles[0][0], triangles[0][1]);
  std::vector<Vector3d> corners;
  for (size_t i = 0; i < 8; ++i) corners.push_back(right.vertex(i));
  const TriangleMesh wrong(corners, triangles);
  EXPECT_TRUE(wrong.closed());
  const Interpenetration found = find(ConvexShape::box(kHalfPiece), wrong, placedAt(0.1, 0.2, 1.02));
  EXPECT_TRUE(found.enclosed);
  EXPECT_NEAR(found.volume, 0.02 * 0.04 * 0.01, 1e-17);
}

// Each half is swept along its own axis, and cut by other walls.
TEST(InterpenetrationTest, IsTheSumOfThatOfTheHalvesOfAPiece) {
  const TriangleMesh mesh = organ();
  Random random(/*seed=*/1);
  const ConvexShape whole = ConvexShape::box({0.01, 0.012, 0.03});
  InterpenetrationFinder finder(whole);
  InterpenetrationFinder half(ConvexShape::box({0.01, 0.012, 0.015}));
  InterpenetrationFinder quarter(ConvexShape::box({0.005, 0.012, 0.015}));
  for (int i = 0; i < 200; ++i) {
    const Isometry3d X_MT = poseInOrgan(random);
    const Interpenetration sum = finder.find(mesh, X_MT);
    double volume = half.find(mesh, X_MT * placedAt(0.0, 0.0, 0.015)).volume;
    Vector3d area_T = half.find(mesh, X_MT * placedAt(0.0, 0.0, 0.015)).area_T;
    for (const double x : {-0.005, 0.005}) {
      volume += quarter.find(mesh, X_MT * placedAt(x, 0.0, -0.015)).volume;
      area_T += quarter.find(mesh, X_MT * placedAt(x, 0.0, -0.015)).area_T;
    }
    EXPECT_NEAR(volume, sum.volume, 1e-9 * finder.pieceVolume());
    EXPECT_LT((area_T - sum.area_T).norm(), 1e-12);
  }
}

// The gradient of the volume is the area.
TEST(InterpenetrationTest, LosesVolumeAlongItsArea) {
  const TriangleMesh mesh = organ();
  Random random(/*seed=*/2);
  InterpenetrationFinder finder(ConvexShape::cylinder(0.008, 0.06));
  constexpr double kStep = 1e-5;
  for (int i = 0; i < 200; ++i) {
    const Isometry3d X_MT = poseInOrgan(random);
    const Vector3d area_T = finder.find(mesh, X_MT).area_T;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d step = kStep * Vector3d::Unit(axis);
      const double change = finder.find(mesh, X_MT * Eigen::Translation3d(step)).volume -
                            finder.find(mesh, X_MT * Eigen::Translation3d(-step)).volume;
      EXPECT_NEAR(change / (2.0 * kStep), -area_T[axis], 1e-7);
    }
  }
}

TEST(InterpenetrationTest, IsTheSameWhereverToolAndMeshAreTogether) {
  const TriangleMesh mesh = organ();
  Random random(/*seed=*/3);
  InterpenetrationFinder finder(ConvexShape::cylinder(0.008, 0.06));
  for (int i = 0; i < 50; ++i) {
    const Isometry3d X_MT = poseInOrgan(random);
    const Isometry3d X_NM = random.pose(random.inBox({10.0, 10.0, 10.0}));
    std::vector<Vector3d> moved;
    for (size_t k = 0; k < mesh.vertexCount(); ++k) moved.push_back(X_NM * mesh.vertex(k));
    const Interpenetration here = finder.find(mesh, X_MT);
    const Interpenetration there = finder.find(TriangleMesh(moved, mesh.triangles()), X_NM * X_MT);
    const double rounding = 1e-7 * 0.1;  // of vertices to float32 [m]
    EXPECT_NEAR(here.volume, there.volume, rounding * 1e-3);
    EXPECT_LT((here.area_T - there.area_T).norm(), rounding * 0.2);
    EXPECT_LT(here.volume * (here.centroid_T - there.centroid_T).norm(), rounding * 1e-3 * 0.06);
  }
}

// Over vertices, along edges, over the rims of the mesh and of the piece: a jump would stay as large with smaller
// steps.
TEST(InterpenetrationTest, IsContinuousInThePose) {
  const TriangleMesh mesh = organ();
  Random random(/*seed=*/4);
  const ConvexShape hull = ConvexShape::hull({{0, 0, 0}, {0.02, 0, -0.03}, {-0.01, 0.02, -0.03}, {0, -0.02, -0.03}});
  int touching = 0;
  for (const ConvexShape& shape_T : {ConvexShape::cylinder(0.006, 0.06), ConvexShape::box(kHalfPiece), hull}) {
    InterpenetrationFinder finder(shape_T);
    for (int path = 0; path < 20; ++path) {
      const Isometry3d X_MT = poseInOrgan(random);
      const auto vertex = static_cast<size_t>(random.below(static_cast<int>(mesh.vertexCount())));
      const Vector3d from = mesh.vertex(vertex);
      const Vector3d to = mesh.vertex((vertex + 1) % mesh.vertexCount());
      const auto largestJump = [&](int steps) {
        Eigen::Vector4d before = Eigen::Vector4d::Zero();
        double largest = 0.0;
        for (int i = 0; i <= steps; ++i) {
          Isometry3d at_step = X_MT;
          at_step.translation() = from + (to - from).normalized() * 0.01 * (2.0 * i / steps - 1.0);
          const Interpenetration found = finder.find(mesh, at_step);
          const Eigen::Vector4d now = (Eigen::Vector4d() << 1e3 * found.volume, found.area_T).finished();
          if (i > 0) largest = std::max(largest, (now - before).norm());
          before = now;
        }
        return largest;
      };
      const double coarse = largestJump(100);
      if (coarse < 1e-9) continue;
      ++touching;
      EXPECT_LT(largestJump(1600), 0.3 * coarse) << path;
    }
  }
  EXPECT_GT(touching, 30);
}

TEST(InterpenetrationTest, AllocatesNothingInSteadyState) {
  const TriangleMesh mesh = organ();
  Random random(/*seed=*/5);
  InterpenetrationFinder finder(ConvexShape::cylinder(0.008, 0.06));
  std::vector<Isometry3d> poses;
  for (int i = 0; i < 100; ++i) poses.push_back(poseInOrgan(random));
  const auto all = [&] {
    for (const Isometry3d& X_MT : poses) finder.find(mesh, X_MT);
  };
  all();
  const Allocations allocations;
  all();
  EXPECT_EQ(allocations.count(), 0U);
}

}  // namespace
}  // namespace sweep_guard_core
