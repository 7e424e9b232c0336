#include "sweep_guard/geometry/swept_volume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/round_tool.h"
#include "scenes.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/geometry/half_space.h"

namespace sweep_guard_core {
namespace {

// Returns the distance of a point outside of the volume [m]; negative inside.
double outsideOf(const SweptVolume& volume, const Eigen::Vector3d& p_B) {
  double farthest = -std::numeric_limits<double>::infinity();
  for (const HalfSpace& half_space : volume.halfSpaces_B()) {
    farthest = std::max(farthest, half_space.signedDistance(p_B));
  }
  return farthest;
}

// Returns the largest such distance of the round tool over samples of the exact motion.
double outsideOf(const SweptVolume& volume, const ConvexShape& tool, const Motion& motion, int steps) {
  double farthest = -std::numeric_limits<double>::infinity();
  for (int step = 0; step <= steps; ++step) {
    const Eigen::Isometry3d X_BT = volume.box.X_MB.inverse() * motion.at(static_cast<double>(step) / steps);
    for (const Eigen::Vector3d& p_T : roundToolPoints_T(tool, 16)) {
      farthest = std::max(farthest, outsideOf(volume, X_BT * p_T));
    }
  }
  return farthest;
}

TEST(VolumeKindTest, HasTheNamesOfTheInterface) {
  for (const std::string name : {"obb", "obb_planes", "hull"}) EXPECT_EQ(nameOf(volumeKind(name)), name);
  EXPECT_EQ(volumeKind("obb"), VolumeKind::kObb);
  for (const std::string name : {"", "OBB", "sphere"}) EXPECT_THROW(volumeKind(name), InvalidInput) << name;
}

TEST(SweptVolumeTest, IsTheBoxAloneIfAskedFor) {
  Random random(/*seed=*/1);
  const ConvexShape drill = ConvexShape::cylinder(0.005, 0.1);
  const Motion motion = handMotion(random);
  EXPECT_EQ(sweptVolume(drill, motion, VolumeKind::kObb).halfSpaces_B().size(), 6U);
  EXPECT_GT(sweptVolume(drill, motion, VolumeKind::kObbPlanes).halfSpaces_B().size(), 6U);
}

TEST(SweptVolumeTest, IsGrownByTheChordErrorAndTheExtraMargin) {
  const ConvexShape drill = ConvexShape::cylinder(0.5, 2.0);
  Motion turn;
  turn.X_MT_end.linear() = Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()).toRotationMatrix();
  EXPECT_NEAR(sweptVolume(drill, turn, VolumeKind::kObb).margin, 2.5 * 0.1 * 0.1 / 8.0, 1e-15);
  EXPECT_NEAR(sweptVolume(drill, turn, VolumeKind::kObb, 0.25).margin, 0.25 + 2.5 * 0.1 * 0.1 / 8.0, 1e-15);

  const SweptVolume still = sweptVolume(drill, Motion{}, VolumeKind::kObbPlanes, 0.25);
  EXPECT_EQ(still.margin, 0.25);
  EXPECT_TRUE(still.box.half_extents.isApprox(Eigen::Vector3d(0.75, 0.75, 1.25), 1e-12));
}

// With and without planes, at rest, straight and with the largest rotation.
TEST(SweptVolumeTest, HoldsTheToolAllAlongTheExactMotion) {
  Random random(/*seed=*/2);
  for (int i = 0; i < 1000 && !HasFailure(); ++i) {
    SCOPED_TRACE("motion " + std::to_string(i));
    const ConvexShape tool = randomTool(random, random.logUniform(1e-3, 1e3));
    const double size = tool.radius() + tool.length();
    const Motion motion = randomMotion(random, tool, size * random.direction(), /*max_angle=*/1.57);
    for (const VolumeKind kind : {VolumeKind::kObb, VolumeKind::kObbPlanes}) {
      EXPECT_LE(outsideOf(sweptVolume(tool, motion, kind), tool, motion, /*steps=*/20), 1e-12 * size);
    }
  }
}

// The chords alone would not contain the arcs.
TEST(SweptVolumeTest, WouldNotHoldTheArcsWithoutItsMargin) {
  const ConvexShape drill = ConvexShape::cylinder(0.005, 0.1);
  Motion turn;
  turn.X_MT_end.linear() = Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitX()).toRotationMatrix();
  SweptVolume volume = sweptVolume(drill, turn, VolumeKind::kObbPlanes);
  volume.box.half_extents.array() -= 0.999 * volume.margin;
  EXPECT_GT(outsideOf(volume, drill, turn, /*steps=*/50), 0.5 * volume.margin);
}

// Doubles are 1.2e-10 m apart there, and so are the poses.
TEST(SweptVolumeTest, HoldsTheToolAThousandKilometersOut) {
  Random random(/*seed=*/3);
  for (int i = 0; i < 1000; ++i) {
    const ConvexShape tool = randomTool(random, 0.1);
    const Motion motion = randomMotion(random, tool, 1e6 * random.direction(), /*max_angle=*/0.175);
    const SweptVolume volume = sweptVolume(tool, motion, VolumeKind::kObbPlanes);
    EXPECT_LE(outsideOf(volume, tool, motion, /*steps=*/10), 1e-9) << "motion " << i;
  }
}

TEST(SweptVolumeTest, IsAsTightAThousandKilometersOutAsAtTheOrigin) {
  Random random(/*seed=*/4);
  for (int i = 0; i < 100; ++i) {
    const ConvexShape tool = randomTool(random, 0.1);
    const Motion here = randomMotion(random, tool, Eigen::Vector3d::Zero(), /*max_angle=*/0.175);
    const Eigen::Translation3d away(1e6, -1e6, 1e6);
    const Motion there{away * here.X_MT_start, away * here.X_MT_end};
    const SweptVolume near = sweptVolume(tool, here, VolumeKind::kObb);
    const SweptVolume far = sweptVolume(tool, there, VolumeKind::kObb);
    EXPECT_TRUE(far.box.half_extents.isApprox(near.box.half_extents, 1e-6)) << "motion " << i;
  }
}

// The canary is there: rounding could lose a point on a plane.
TEST(SweptVolumeTest, HasItsInteriorPointStrictlyInside) {
  Random random(/*seed=*/5);
  for (int i = 0; i < 20'000; ++i) {
    const ConvexShape tool = randomTool(random, random.logUniform(1e-3, 1e3));
    const double size = tool.radius() + tool.length();
    const Motion motion = randomMotion(random, tool, random.logUniform(1e-3, 1e6) * random.direction(), 1.57);
    const bool solid = tool.radius() > 0.0 && tool.length() > 0.0;
    const SweptVolume volume = sweptVolume(tool, motion, VolumeKind::kObbPlanes, solid ? 0.0 : 1e-3 * size);
    EXPECT_LT(outsideOf(volume, volume.interior_B), 0.0) << "motion " << i;
  }
}

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
