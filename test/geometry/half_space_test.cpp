#include "sweep_guard/geometry/half_space.h"

#include <gtest/gtest.h>

#include "sweep_guard/common/error.h"

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

}  // namespace
}  // namespace sweep_guard_core
