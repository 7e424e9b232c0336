#include "sweep_guard/geometry/half_space.h"

#include <gtest/gtest.h>

#include "sweep_guard/common/error.h"
#include "sweep_guard/geometry/swept_volume.h"

namespace sweep_guard_core {
namespace {

const HalfSpace kBelowOne(Eigen::Vector3d::UnitZ(), 1.0);  // z <= 1

TEST(HalfSpaceTest, MeasuresNegativeInsideAndPositiveOutside) {
  EXPECT_EQ(kBelowOne.signedDistance({7, 8, 0.75}), -0.25);
  EXPECT_EQ(kBelowOne.signedDistance({7, 8, 1}), 0.0);
  EXPECT_EQ(kBelowOne.signedDistance({7, 8, 3}), 2.0);
}

TEST(HalfSpaceTest, NormalizesItsNormalAndKeepsItsOffset) {
  const HalfSpace half_space({3, 0, 4}, 2.0);
  EXPECT_DOUBLE_EQ(half_space.normal().x(), 0.6);
  EXPECT_DOUBLE_EQ(half_space.normal().z(), 0.8);
  EXPECT_EQ(half_space.offset(), 2.0);
}

TEST(HalfSpaceTest, GrowsOutwards) {
  EXPECT_EQ(kBelowOne.grown(0.5).signedDistance({0, 0, 1.5}), 0.0);
  EXPECT_EQ(kBelowOne.grown(-0.5).signedDistance({0, 0, 0.5}), 0.0);
}

TEST(HalfSpaceTest, RefusesANormalWithoutADirection) {
  EXPECT_THROW(HalfSpace({0, 0, 0}, 1.0), InvalidInput);
  EXPECT_THROW(HalfSpace({0, 0, 1e-11}, 1.0), InvalidInput);
  EXPECT_THROW(HalfSpace({0, std::nan(""), 1}, 1.0), InvalidInput);
  EXPECT_NO_THROW(HalfSpace({0, 0, 1e-9}, 1.0));
}

TEST(ClipTest, LeavesAPolygonInsideAsItIs) {
  const Polygon triangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5}};
  EXPECT_EQ(clip(triangle, kBelowOne), triangle);
}

TEST(ClipTest, LeavesNothingOfAPolygonOutside) {
  EXPECT_TRUE(clip({{0, 0, 2}, {1, 0, 2}, {0, 1, 2}}, kBelowOne).empty());
  EXPECT_TRUE(clip({}, kBelowOne).empty());
}

TEST(ClipTest, CutsWhereTheEdgesCrossThePlane) {
  const Polygon cut = clip({{0, 0, 0}, {4, 0, 0}, {0, 0, 4}}, kBelowOne);
  EXPECT_EQ(cut, (Polygon{{0, 0, 0}, {4, 0, 0}, {3, 0, 1}, {0, 0, 1}}));
}

// Touching counts as intersecting: something must remain.
TEST(ClipTest, KeepsWhatTouchesThePlane) {
  EXPECT_EQ(clip({{0, 0, 1}, {1, 0, 2}, {0, 1, 2}}, kBelowOne), (Polygon{{0, 0, 1}}));
  EXPECT_EQ(clip({{0, 0, 1}, {1, 0, 1}, {0, 1, 2}}, kBelowOne), (Polygon{{0, 0, 1}, {1, 0, 1}}));
  EXPECT_EQ(clip({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, kBelowOne).size(), 3U);
}

TEST(ClipTest, ClipsPointsAndSegments) {
  EXPECT_EQ(clip({{0, 0, 1}}, kBelowOne).size(), 1U);
  EXPECT_TRUE(clip({{0, 0, 2}}, kBelowOne).empty());
  // A triangle with two equal corners.
  const Polygon needle = clip({{0, 0, 0}, {0, 0, 2}, {0, 0, 2}}, kBelowOne);
  ASSERT_EQ(needle.size(), 3U);
  EXPECT_EQ(needle[0], Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(needle[1], Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(needle[2], Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(clip({{1, 2, 1}, {1, 2, 1}, {1, 2, 1}}, kBelowOne).size(), 3U);
}

std::vector<HalfSpace> unitCube() {
  SweptVolume volume;
  volume.box.half_extents.setConstant(0.5);
  return volume.halfSpaces_B();
}

double volumeOf(const std::vector<HalfSpace>& half_spaces) { return polytopeVolume(polytopeFaces(half_spaces, 1.0)); }

TEST(ConvexPolytopeTest, ACubeHasSixSquaresAndItsVolume) {
  const std::vector<Polygon> faces = polytopeFaces(unitCube(), 1.0);
  ASSERT_EQ(faces.size(), 6U);
  for (const Polygon& face : faces) EXPECT_EQ(face.size(), 4U);
  EXPECT_NEAR(polytopeVolume(faces), 1.0, 1e-12);
}

// The plane x + y + z = 1 cuts off the corner (0.5, 0.5, 0.5): a pyramid with three edges of 0.5.
TEST(ConvexPolytopeTest, ACubeWithoutACornerLacksAPyramid) {
  std::vector<HalfSpace> half_spaces = unitCube();
  half_spaces.emplace_back(Eigen::Vector3d::Ones(), 1.0 / std::sqrt(3.0));
  const std::vector<Polygon> faces = polytopeFaces(half_spaces, 1.0);
  ASSERT_EQ(faces.size(), 7U);
  EXPECT_EQ(faces.back().size(), 3U);
  EXPECT_NEAR(polytopeVolume(faces), 1.0 - 0.125 / 6.0, 1e-12);
}

TEST(ConvexPolytopeTest, FacesAreCounterClockwiseSeenFromOutside) {
  for (const Polygon& face : polytopeFaces(unitCube(), 1.0)) {
    const Eigen::Vector3d normal = (face[1] - face[0]).cross(face[2] - face[1]);
    EXPECT_GT(normal.dot(face[0]), 0.0);
  }
}

TEST(ConvexPolytopeTest, AHalfSpaceThatBoundsNothingHasNoFace) {
  std::vector<HalfSpace> half_spaces = unitCube();
  half_spaces.emplace_back(Eigen::Vector3d::UnitX(), 0.75);
  EXPECT_EQ(polytopeFaces(half_spaces, 1.0).size(), 6U);
}

TEST(ConvexPolytopeTest, HalfSpacesWithoutACommonPointHaveNoVolume) {
  std::vector<HalfSpace> half_spaces = unitCube();
  half_spaces.emplace_back(Eigen::Vector3d::UnitX(), -0.75);
  EXPECT_EQ(volumeOf(half_spaces), 0.0);
}

}  // namespace
}  // namespace sweep_guard_core
