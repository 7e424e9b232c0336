#include "sweep_guard/geometry/swept_volume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/round_tool.h"
#include "scenes.h"
#include "sweep_guard/geometry/half_space.h"

namespace sweep_guard_core {
namespace {

constexpr int kMotions = 100'000;

void expectPlane(const HalfSpace& plane, const Eigen::Vector2d& normal_yz, const Eigen::Vector2d& touched_yz) {
  EXPECT_TRUE(plane.normal().isApprox(Eigen::Vector3d(0, normal_yz.x(), normal_yz.y()).normalized(), 1e-12))
      << plane.normal().transpose();
  EXPECT_NEAR(plane.signedDistance({0, touched_yz.x(), touched_yz.y()}), 0.0, 1e-12);
}

// Figure 5 of the paper in numbers. The drill (radius 1, length 10) points along z at the start, with its tip at the
// origin, and along (0, 0.6, 0.8) at the end, with its tip at (0, 6, 0). In (y, z), the extreme points of its faces are
//   front: (-1, 0), (1, 0) and (5.2, 0.6), (6.8, -0.6)    rear: (-1, -10), (1, -10) and (-0.8, -7.4), (0.8, -8.6)
// and the given box is the one along the axes: y in [-1, 6.8], z in [-10, 0.6].
TEST(BoundingPlanesTest, AreTheSideAndFrontalPlanesOfFigureFive) {
  Motion motion;
  motion.X_MT_end.linear() = Eigen::AngleAxisd(-std::acos(0.8), Eigen::Vector3d::UnitX()).toRotationMatrix();
  motion.X_MT_end.translation() = Eigen::Vector3d(0, 6, 0);
  OrientedBox box;
  box.X_MB.translation() = Eigen::Vector3d(0, 2.9, -4.7);
  box.half_extents = Eigen::Vector3d(1, 3.9, 5.3);

  const Clips planes_B = boundingPlanes(ConvexShape::cylinder(1, 10), motion, box);
  ASSERT_EQ(planes_B.size(), 4U);
  const auto in_B = [](double y, double z) { return Eigen::Vector2d(y - 2.9, z + 4.7); };
  expectPlane(planes_B[0], {9.4, -5.8}, in_B(1, -10));  // SCP: from the rear at the start to the front at the end
  expectPlane(planes_B[0], {9.4, -5.8}, in_B(6.8, -0.6));
  expectPlane(planes_B[1], {-8, 6}, in_B(-1, 0));      // SCP: along the drill at the end, moved out to the start
  expectPlane(planes_B[2], {-0.6, 6.2}, in_B(-1, 0));  // FCP: over both front faces
  expectPlane(planes_B[2], {-0.6, 6.2}, in_B(5.2, 0.6));
  expectPlane(planes_B[3], {1.4, -1.8}, in_B(1, -10));  // FCP: under both rear faces
}

TEST(BoundingPlanesTest, CutNothingOffTheBoxOfADrillAlongItsAxis) {
  Motion ahead;
  ahead.X_MT_end.translation() = Eigen::Vector3d(0, 0, 0.5);
  const ConvexShape drill = ConvexShape::cylinder(1, 10);
  EXPECT_TRUE(boundingPlanes(drill, ahead, boundingBox(drill, ahead)).empty());
  EXPECT_TRUE(boundingPlanes(drill, Motion{}, boundingBox(drill, Motion{})).empty());
}

// So no plane has to be dropped.
TEST(BoundingPlanesTest, CutOffNoPointOfTheRoundToolWhateverItsMotion) {
  Random random(/*seed=*/1);
  int planes = 0;
  for (int i = 0; i < kMotions && !HasFailure(); ++i) {
    const ConvexShape tool = randomTool(random, random.logUniform(1e-3, 1e3));
    const double size = tool.radius() + tool.length();
    const Motion motion = randomMotion(random, tool, size * random.direction(), /*max_angle=*/3.14);
    const OrientedBox box = boundingBox(tool, motion);
    const Clips planes_B = boundingPlanes(tool, motion, box);
    planes += static_cast<int>(planes_B.size());
    EXPECT_LE(planes_B.size(), 4U);
    for (const Eigen::Isometry3d& X_MT : {motion.X_MT_start, motion.X_MT_end}) {
      const Eigen::Isometry3d X_BT = box.X_MB.inverse() * X_MT;
      for (const Eigen::Vector3d& p_T : roundToolPoints_T(tool, 16)) {
        for (const HalfSpace& plane_B : planes_B) {
          EXPECT_LE(plane_B.signedDistance(X_BT * p_T), 1e-14 * size) << "motion " << i;
        }
      }
    }
  }
  EXPECT_GT(planes, 2 * kMotions);
}

TEST(BoundingPlanesTest, AreParallelToTheXAxisOfTheBox) {
  Random random(/*seed=*/2);
  for (int i = 0; i < 1000; ++i) {
    const ConvexShape tool = randomTool(random, 1.0);
    const Motion motion = randomMotion(random, tool, random.direction(), /*max_angle=*/3.14);
    for (const HalfSpace& plane_B : boundingPlanes(tool, motion, boundingBox(tool, motion))) {
      EXPECT_EQ(plane_B.normal().x(), 0.0);
    }
  }
}

TEST(BoundingPlanesTest, MakeTheVolumeOfHandMotionsTighter) {
  Random random(/*seed=*/3);
  const ConvexShape drill = ConvexShape::cylinder(/*radius=*/0.005, /*length=*/0.1);
  std::vector<double> ratios;
  for (int i = 0; i < 1000; ++i) {
    const Motion motion = handMotion(random);
    const OrientedBox box = boundingBox(drill, motion);
    const SweptVolume cut{box, boundingPlanes(drill, motion, box)};
    const double volume = polytopeVolume(polytopeFaces(cut.halfSpaces_B(), box.half_extents.norm()));
    ratios.push_back(volume / (8.0 * box.half_extents.prod()));
    EXPECT_LT(ratios.back(), 1.0 + 1e-9) << "motion " << i;
  }
  std::nth_element(ratios.begin(), ratios.begin() + 500, ratios.end());
  EXPECT_LT(ratios[500], 0.95);
}

}  // namespace
}  // namespace sweep_guard_core
