#include "sweep_guard/geometry/half_space.h"

#include <gtest/gtest.h>

#include "sweep_guard/geometry/swept_volume.h"

namespace sweep_guard_core {
namespace {

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
