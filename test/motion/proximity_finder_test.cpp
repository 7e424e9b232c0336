#include "sweep_guard/motion/proximity_finder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "allocations.h"
#include "motion/proximity_truth.h"
#include "motion/random_scenes.h"

namespace sweep_guard_core {
namespace {

// A square of side 0.2 m in z = 0, of 2 * cells^2 triangles.
TriangleMesh square(std::uint32_t cells, const Eigen::Matrix3d& R_MS = Eigen::Matrix3d::Identity()) {
  std::vector<Vector3d> vertices;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i <= cells; ++i) {
    for (std::uint32_t j = 0; j <= cells; ++j) {
      vertices.emplace_back(R_MS * Vector3d(0.2 * i / cells - 0.1, 0.2 * j / cells - 0.1, 0.0));
    }
  }
  for (std::uint32_t i = 0; i < cells; ++i) {
    for (std::uint32_t j = 0; j < cells; ++j) {
      const std::uint32_t a = i * (cells + 1) + j;
      triangles.push_back({a, a + cells + 1, a + 1});
      triangles.push_back({a + 1, a + cells + 1, a + cells + 2});
    }
  }
  return TriangleMesh(vertices, triangles);
}

TEST(ProximityFinderTest, BoundsEveryTriangleAndEveryVertexSpeed) {
  Met met;
  for (std::uint64_t seed = 0; seed < caseCount(300); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Tool tool = toolOfAllShapes(random);
    const double reach = random.logUniform(0.005, 0.3);
    const bool moving = random.chance(0.5);
    const Isometry3d X_WM_before = random.pose(random.inBox({1.0, 1.0, 1.0}));
    Isometry3d X_WM = X_WM_before;
    if (moving) {
      X_WM.translate(random.inBox({0.002, 0.002, 0.002}));
      X_WM.linear() = X_WM.linear() * random.turn(0.01);
    }
    const auto first = workpieceOf(randomMesh(random));
    auto workpiece = first;
    if (random.chance(0.5)) {
      std::vector<float> positions = streamedPositions(first->mesh_M);
      for (float& p : positions) p += static_cast<float>(random.chance(0.2) ? random.uniform(-0.003, 0.003) : 0.0);
      workpiece = updated(*first, positions, 20ms);
    }
    ProximityFinder finder;
    Proximity found;
    const PoseWithFrames before =
        poseAt(X_WM_before * random.pose(random.inBox({0.1, 0.1, 0.1})), Time(100s), X_WM_before);
    const PoseWithFrames pose = poseAt(X_WM * random.pose(random.inBox({0.1, 0.1, 0.1})), Time(100s + 10ms), X_WM);
    finder.find({{&tool}, before, {first}, reach}, found);
    finder.find({{&tool}, pose, {workpiece}, reach}, found);
    const BruteForce truth({&tool}, pose, *workpiece, workpiece == first ? nullptr : first.get(), X_WM_before, 0.01);
    expectAllBounded(truth, reach, found, met);
    expectPlanesInFront(truth, found, met);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(met.behind, 1000U);
  EXPECT_GT(met.left_over, 1000U);
  EXPECT_GT(met.contacts, 50U);
}

TEST(ProximityFinderTest, WhatMoreThan64PlanesWouldNeedBoundsTheSpeedAsAWhole) {
  Met met;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::vector<ConvexPiece> pieces;
    for (int i = 0; i < 16; ++i) {
      pieces.push_back({"link", ConvexShape::sphere(0.005).placed(random.pose(random.inBox({0.03, 0.03, 0.03})))});
    }
    const Tool tool(pieces);
    const auto workpiece = workpieceOf(randomMesh(random));
    const PoseWithFrames pose = poseAt(random.pose(random.inBox({0.05, 0.05, 0.05})));
    ProximityFinder finder;
    Proximity found;
    finder.find({{&tool}, pose, {workpiece}, 0.3}, found);
    const BruteForce truth({&tool}, pose, *workpiece);
    expectAllBounded(truth, 0.3, found, met);
    expectPlanesInFront(truth, found, met);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(met.full, 3U);
}

TEST(ProximityFinderTest, InsideOfAClosedMeshTheWallsAreBoundedAllAround) {
  Met met;
  const auto workpiece = workpieceOf(wavyHull(20, 40, 0.0));
  ProximityFinder finder;
  Proximity found;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    const Tool tool(ConvexShape::cylinder(0.004, 0.03));
    const PoseWithFrames pose = poseAt(random.pose(random.inBox({0.05, 0.05, 0.05})));
    finder.find({{&tool}, pose, {workpiece}, 0.2}, found);
    const BruteForce truth({&tool}, pose, *workpiece);
    expectAllBounded(truth, 0.2, found, met);
    expectPlanesInFront(truth, found, met);
    if (HasFatalFailure()) return;
    ASSERT_GT(found.planes.size(), 6U);
  }
}

TEST(ProximityFinderTest, OnePlaneStandsForAFlatWallHoweverItIsTurned) {
  const Tool ball(ConvexShape::sphere(0.01));
  Random random(7);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Matrix3d R_MS = random.rotation();
    Isometry3d X_WT = Isometry3d::Identity();
    X_WT.linear() = R_MS;
    X_WT.translation() = R_MS * Vector3d(0.01, 0.02, 0.03);
    ProximityFinder finder;
    Proximity found;
    finder.find({{&ball}, poseAt(X_WT), {workpieceOf(square(60, R_MS))}, 0.1}, found);
    ASSERT_EQ(found.planes.size(), 1U);
    EXPECT_NEAR(found.planes[0].plane.gap, 0.95 * 0.02, 1e-5);
    EXPECT_GT(found.planes[0].plane.normal_W.dot(R_MS.col(2)), 0.9999);
    EXPECT_EQ(found.planes[0].plane.surface_speed, 0.0);
    EXPECT_GE(found.uncovered.distance, 0.1);
  }
}

TEST(ProximityFinderTest, WhatIsBeyondTheReachBoundsTheSpeedAsAWhole) {
  const auto workpiece = workpieceOf(square(10));
  const Tool tool(ConvexShape::sphere(0.01));
  ProximityFinder finder;
  Proximity found;
  finder.find({{&tool}, poseAt(placedAt(0.0, 0.0, 0.1101)), {workpiece}, 0.1}, found);
  EXPECT_TRUE(found.planes.empty());
  EXPECT_LE(found.uncovered.distance, 0.1001);
  EXPECT_GE(found.uncovered.distance, 0.1);
  finder.find({{&tool}, poseAt(placedAt(0.0, 0.0, 0.1099)), {workpiece}, 0.1}, found);
  EXPECT_EQ(found.planes.size(), 1U);
}

TEST(ProximityFinderTest, APaddedWorkpieceCountsAsNearerByItsPadding) {
  TriangleMesh padded = square(10);
  padded.pad(0.02);
  const Tool tool(ConvexShape::sphere(0.01));
  ProximityFinder finder;
  Proximity found;
  for (const double distance : {0.03, 0.119}) {
    finder.find({{&tool}, poseAt(placedAt(0.0, 0.0, 0.01 + distance)), {workpieceOf(padded)}, 0.1}, found);
    ASSERT_EQ(found.planes.size(), 1U) << distance;
    EXPECT_LE(found.planes[0].plane.gap, distance - 0.02);
    EXPECT_GE(found.planes[0].plane.point_W.z(), 0.02);
  }
  finder.find({{&tool}, poseAt(placedAt(0.0, 0.0, 0.13 + 0.0001)), {workpieceOf(padded)}, 0.1}, found);
  EXPECT_TRUE(found.planes.empty());
  EXPECT_NEAR(found.uncovered.distance, 0.1, 1e-3);
}

// All of what it stands for is padded, not only the triangle that it was made for.
TEST(ProximityFinderTest, APlaneOfAPaddedWorkpieceLeavesItsPaddingBeforeEachTriangle) {
  const Tool ball(ConvexShape::sphere(0.01));
  Random random(5);
  ProximityFinder finder;
  Proximity found;
  for (int i = 0; i < 50; ++i) {
    TriangleMesh padded = square(10, random.rotation());
    padded.pad(0.02);
    const auto workpiece = workpieceOf(padded);
    finder.find({{&ball}, poseAt(placedAt(0.0, 0.0, 0.16)), {workpiece}, 0.2}, found);
    for (size_t vertex = 0; vertex < padded.vertexCount(); ++vertex) {
      const auto clears = [&](const ProximityPlane& each) {
        return each.plane.normal_W.dot(padded.vertex(vertex) - each.plane.point_W) <= -0.02;
      };
      const bool is_cleared = std::any_of(found.planes.begin(), found.planes.end(), clears);
      EXPECT_TRUE(is_cleared || padded.vertex(vertex).norm() < found.uncovered.distance) << vertex;
    }
  }
}

TEST(ProximityFinderTest, WithoutWorkpieceThereIsNothing) {
  const Tool ball(ConvexShape::sphere(0.01));
  ProximityFinder finder;
  Proximity found;
  finder.find({{&ball}, poseAt(placedAt(0.0, 0.0, 0.0)), {}, 0.1}, found);
  EXPECT_TRUE(found.planes.empty());
  EXPECT_EQ(found.uncovered.distance, kInfinity);
}

TEST(ProximityFinderTest, AWorkpieceWithoutItsFrameIsNamed) {
  const Tool ball(ConvexShape::sphere(0.01));
  ProximityFinder finder;
  Proximity found;
  const auto workpiece = workpieceOf(square(2));
  finder.find({{&ball}, {Time(1s), {}, placedAt(0.0, 0.0, 0.02), {}}, {workpiece}, 0.1}, found);
  ASSERT_EQ(found.unplaced.size(), 1U);
  EXPECT_EQ(found.unplaced[0], workpiece);
}

TEST(ProximityFinderTest, TheSpeedIsThatOfTheTwoLatestDeformationsUntilTheNext) {
  const auto first = workpieceOf(square(20));
  std::vector<float> raised = streamedPositions(first->mesh_M);
  for (size_t i = 2; i < raised.size(); i += 3) raised[i] += 0.001F;
  const auto second = updated(*first, raised, 20ms);
  const auto third = updated(*second, raised, 20ms);
  const Tool tool(ConvexShape::sphere(0.01));
  ProximityFinder finder;
  Proximity found;
  const auto speed = [&](const auto& workpiece) {
    finder.find({{&tool}, poseAt(placedAt(0.0, 0.0, 0.05)), {workpiece}, 0.1}, found);
    return found.planes.at(0).plane.surface_speed;
  };
  EXPECT_EQ(speed(first), 0.0);
  EXPECT_NEAR(speed(second), 0.05, 1e-6);
  EXPECT_NEAR(speed(second), 0.05, 1e-6);
  EXPECT_EQ(speed(third), 0.0);
}

// Some part of the mesh moves; the plane before another part does not count it.
TEST(ProximityFinderTest, APartThatMovesElsewhereDoesNotQuickenAPlane) {
  const auto first = workpieceOf(square(60));
  std::vector<float> moved = streamedPositions(first->mesh_M);
  for (size_t i = 0; i < moved.size(); i += 3) {
    if (moved[i] > 0.08F) moved[i + 2] -= 0.05F;
  }
  const auto second = updated(*first, moved, 1s);
  const Tool tool(ConvexShape::sphere(0.01));
  ProximityFinder finder;
  Proximity found;
  finder.find({{&tool}, poseAt(placedAt(-0.05, 0.0, 0.02)), {first}, 0.05}, found);
  finder.find({{&tool}, poseAt(placedAt(-0.05, 0.0, 0.02)), {second}, 0.05}, found);
  ASSERT_FALSE(found.planes.empty());
  EXPECT_NEAR(found.planes[0].plane.surface_speed, 0.0, 1e-6);
}

// A drill through a sheet, also off the perpendicular.
TEST(ProximityFinderTest, FromAContactTheToolCanRetreat) {
  const auto workpiece = workpieceOf(square(100));
  const Tool tool(ConvexShape::cylinder(0.002, 0.05).placed(placedAt(0.0, 0.0, 0.05)));
  ProximityFinder finder;
  Proximity found;
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    Isometry3d X_WT = placedAt(random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05), -random.uniform(1e-5, 0.01));
    X_WT.rotate(Eigen::AngleAxisd(random.uniform(0.0, 0.5), Vector3d::UnitX()));
    finder.find({{&tool}, poseAt(X_WT), {workpiece}, 0.1}, found);
    ASSERT_FALSE(found.planes.empty());
    ASSERT_LT(found.planes[0].plane.gap, 0.0);
    const Vector3d out_W = X_WT.linear().col(2);
    for (const ProximityPlane& each : found.planes) {
      ASSERT_GE(each.plane.normal_W.dot(out_W), each.contact ? 0.5 : -1e-6);
    }
    ASSERT_GT(found.uncovered.distance, 0.0);
  }
}

// What is ahead of a drill that has pierced a sheet lies behind the plane of the sheet, too.
TEST(ProximityFinderTest, APlaneInContactDoesNotStandForWhatTheToolMayStillMeet) {
  std::vector<Vector3d> vertices = {{-0.1, -0.1, 0.0}, {0.1, -0.1, 0.0}, {0.0, 0.1, 0.0}};
  for (size_t i = 0; i < 3; ++i) vertices.emplace_back(vertices[i] - Vector3d(0.0, 0.0, 0.02));
  const auto workpiece = workpieceOf(TriangleMesh(vertices, {{0, 1, 2}, {3, 4, 5}}));
  const Tool tool(ConvexShape::cylinder(0.002, 0.05).placed(placedAt(0.0, 0.0, 0.05)));
  ProximityFinder finder;
  Proximity found;
  finder.find({{&tool}, poseAt(placedAt(0.0, 0.0, -0.01)), {workpiece}, 0.1}, found);
  ASSERT_EQ(found.planes.size(), 2U);
  EXPECT_NEAR(found.planes[0].plane.gap, -0.01, 1e-6);
  EXPECT_EQ(found.planes[1].triangle, 1U);
  EXPECT_NEAR(found.planes[1].plane.gap, 0.0095, 1e-5);
}

TEST(ProximityFinderTest, AContactKeepsTheNormalOfTheSweep) {
  const auto workpiece = workpieceOf(square(20));
  const Tool tool(ConvexShape::sphere(0.01));
  const Vector3d first_touched = Vector3d(0.6, 0.0, 0.8);
  SweepReport report;
  report.objects.resize(1);
  report.objects[0].workpiece = workpiece;
  for (std::uint32_t i = 0; i < workpiece->mesh_M.triangles().size(); ++i) {
    report.objects[0].result.in_contact.push_back({i, 0, {0.0, Vector3d::Zero(), first_touched, 0.0}});
  }
  ProximityFinder finder;
  Proximity found;
  const PoseWithFrames pose = poseAt(placedAt(0.0, 0.0, -0.002));
  finder.find({{&tool}, pose, {workpiece}, 0.1, &report}, found);
  ASSERT_FALSE(found.planes.empty());
  EXPECT_NEAR(found.planes[0].plane.normal_W.dot(first_touched), 1.0, 1e-12);
}

TEST(ProximityFinderTest, ResetForgetsSpeeds) {
  const auto first = workpieceOf(square(20));
  std::vector<float> raised = streamedPositions(first->mesh_M);
  for (size_t i = 2; i < raised.size(); i += 3) raised[i] += 0.001F;
  const Tool tool(ConvexShape::sphere(0.01));
  ProximityFinder finder;
  Proximity found;
  finder.find({{&tool}, poseAt(placedAt(0.0, 0.0, 0.05)), {first}, 0.1}, found);
  finder.reset();
  finder.find({{&tool}, poseAt(placedAt(0.0, 0.0, 0.05)), {updated(*first, raised, 20ms)}, 0.1}, found);
  EXPECT_EQ(found.planes.at(0).plane.surface_speed, 0.0);
}

TEST(ProximityFinderTest, AllocatesNothing) {
  Random random(5);
  const Tool tool = toolOfAllShapes(random);
  const auto one = workpieceOf(wavyHull(20, 40, 0.0));
  const auto two = updated(*one, streamedPositions(wavyHull(20, 40, 0.05)), 20ms);
  ProximityFinder finder;
  Proximity found;
  const Workpieces first = {one};
  const Workpieces second = {two};
  std::vector<PoseWithFrames> poses;
  for (int i = 0; i < 50; ++i) poses.push_back(poseAt(placedAt(0.06 + 0.002 * i, 0.01, 0.0), Time(100s + i * 10ms)));
  const auto run = [&] {
    for (size_t i = 0; i < poses.size(); ++i) finder.find({{&tool}, poses[i], i % 2 == 0 ? first : second, 0.1}, found);
  };
  run();
  const Allocations made;
  run();
  EXPECT_EQ(made.count(), 0U) << made.stacks();
}

// A drill that comes down on a plate: a bit of 1 mm radius and 40 mm, behind it a shaft of 10 mm radius. Its bit may touch
// the plate within 15 mm of the origin, 5 mm deep.
class IntendedProximityTest : public ::testing::Test {
 protected:
  IntendedProximityTest() {
    Intention region;
    region.mesh_id = plate_->id;
    region.mesh_triangles = std::shared_ptr<const std::vector<Triangle>>(plate_, &plate_->mesh_M.triangles());
    region.depth = 0.005;
    region.tool_links = {"bit"};
    for (std::uint32_t i = 0; i < plate_->mesh_M.triangles().size(); ++i) {
      if (distanceFromOrigin(i) < 0.015) region.triangles.push_back(i);
    }
    intentions_.push_back(region);
  }

  double distanceFromOrigin(std::uint32_t triangle) const {
    double most = 0.0;
    for (const std::uint32_t i : plate_->mesh_M.triangles()[triangle]) {
      most = std::max(most, plate_->mesh_M.vertex(i).norm());
    }
    return most;
  }

  // With the tip at a height above the plate.
  Proximity placedAt(double height, double x = 0.0) {
    Isometry3d X_WT(Eigen::AngleAxisd(M_PI, Vector3d::UnitX()));
    X_WT.translation() = Vector3d(x, 0.0, height);
    Proximity found;
    finder_.find({{&tool_}, poseAt(X_WT), {plate_}, 0.1, nullptr, &intentions_}, found);
    return found;
  }

  // Returns the smallest gap of the bit to what is below it.
  static double nearestBelow(const Proximity& found) {
    double gap = kInfinity;
    for (const ProximityPlane& each : found.planes) {
      if (each.plane.piece == 0 && each.plane.normal_W.z() > 0.5) gap = std::min(gap, each.plane.gap);
    }
    return gap;
  }

  std::shared_ptr<const Workpiece> plate_ = workpieceOf(square(100));
  Tool tool_ = Tool(std::vector<ConvexPiece>{
      {"bit", ConvexShape::cylinder(0.001, 0.04)},
      {"shaft", ConvexShape::cylinder(0.01, 0.05).placed(Isometry3d(Eigen::Translation3d(0.0, 0.0, -0.04)))}});
  Intentions intentions_;
  ProximityFinder finder_;
};

TEST_F(IntendedProximityTest, TheBitMayComeDownToTheDepth) {
  EXPECT_NEAR(nearestBelow(placedAt(0.01)), 0.015, 0.05 * 0.015 + 1e-5);
  EXPECT_NEAR(nearestBelow(placedAt(0.001)), 0.006, 0.05 * 0.006 + 1e-5);
  const Proximity inside = placedAt(-0.003);
  EXPECT_NEAR(nearestBelow(inside), 0.002, 0.05 * 0.002 + 1e-5);
  for (const ProximityPlane& each : inside.planes) EXPECT_GT(each.plane.gap, 0.0);
}

TEST_F(IntendedProximityTest, DeeperThanAllowedIsAContact) {
  const Proximity found = placedAt(-0.006);
  ASSERT_FALSE(found.planes.empty());
  EXPECT_TRUE(found.planes[0].contact);
  EXPECT_LT(found.planes[0].plane.gap, 0.0);
}

TEST_F(IntendedProximityTest, TheShaftIsHeldBackByTheSurface) {
  const Proximity found = placedAt(-0.003);
  const auto of_shaft = [](const ProximityPlane& each) { return each.plane.piece == 1; };
  const auto shaft = std::find_if(found.planes.begin(), found.planes.end(), of_shaft);
  ASSERT_NE(shaft, found.planes.end());
  EXPECT_NEAR(shaft->plane.gap, 0.037, 0.05 * 0.037 + 1e-5);
}

TEST_F(IntendedProximityTest, BesideTheRegionTheSurfaceCounts) {
  const Proximity found = placedAt(0.001, 0.02);
  ASSERT_FALSE(found.planes.empty());
  EXPECT_NEAR(found.planes[0].plane.gap, 0.001, 6e-5);
  EXPECT_GT(found.planes[0].plane.normal_W.z(), 0.9);
}

TEST_F(IntendedProximityTest, InTheHoleItsRimIsNear) {
  const Proximity found = placedAt(-0.003, 0.01);
  double nearest = kInfinity;
  for (const ProximityPlane& each : found.planes) {
    if (each.plane.piece == 0 && each.plane.normal_W.x() < -0.7) nearest = std::min(nearest, each.plane.gap);
  }
  EXPECT_GT(nearest, 0.002);
  EXPECT_LT(nearest, 0.004);
}

TEST_F(IntendedProximityTest, ARegionOfAnotherMeshChangesNothing) {
  const Proximity meant = placedAt(0.001);
  intentions_[0].mesh_id = "other";
  const Proximity other = placedAt(0.001);
  intentions_.clear();
  const Proximity nothing = placedAt(0.001);
  EXPECT_NE(meant.planes[0].plane.gap, nothing.planes[0].plane.gap);
  ASSERT_EQ(other.planes.size(), nothing.planes.size());
  for (size_t i = 0; i < other.planes.size(); ++i) {
    EXPECT_EQ(other.planes[i].plane.gap, nothing.planes[i].plane.gap);
    EXPECT_EQ(other.planes[i].plane.normal_W, nothing.planes[i].plane.normal_W);
  }
  EXPECT_EQ(other.uncovered.distance, nothing.uncovered.distance);
}

TEST_F(IntendedProximityTest, ALinkThatMayTouchHasNoPlanes) {
  intentions_.clear();
  const auto pieces = [&](const AllowedPairs& allowed) {
    Isometry3d X_WT(Eigen::AngleAxisd(M_PI, Vector3d::UnitX()));
    X_WT.translation() = Vector3d(0.0, 0.0, 0.001);
    Proximity found;
    finder_.find({{&tool_}, poseAt(X_WT), {plate_}, 0.1, nullptr, nullptr, &allowed}, found);
    std::set<size_t> with_planes;
    for (const ProximityPlane& each : found.planes) with_planes.insert(each.plane.piece);
    return std::pair(with_planes, found.uncovered.distance);
  };
  EXPECT_EQ(pieces({}).first, (std::set<size_t>{0, 1}));
  EXPECT_EQ(pieces({{"bit", plate_->id}}).first, (std::set<size_t>{1}));
  EXPECT_EQ(pieces({{"bit", "other"}}).first, (std::set<size_t>{0, 1}));
  EXPECT_TRUE(pieces({{"*", plate_->id}}).first.empty());
  EXPECT_EQ(pieces({{"*", plate_->id}}).second, kInfinity);
}

// A payload moves as fast as the tool that holds it.
TEST_F(IntendedProximityTest, TheSpeedOfWhatMayBeTouchedCountsForNothing) {
  const auto table = workpieceOf(square(10), "table");
  const auto speedOfUncovered = [&](const AllowedPairs& allowed) {
    ProximityFinder finder;
    Proximity found;
    const Isometry3d far(Eigen::Translation3d(0.0, 0.0, -1.0));
    for (const Duration t : {100s + 0ms, 100s + 10ms}) {
      PoseWithFrames pose = poseAt(Isometry3d::Identity(), Time(t));
      pose.X_WM = {{kFrame, Isometry3d(Eigen::Translation3d(toSeconds(t - 100s), 0.0, -0.01))}, {"still", far}};
      Workpiece still = *table;
      still.frame = "still";
      finder.find({{&tool_}, pose, {plate_, std::make_shared<const Workpiece>(still)}, 0.1, nullptr, nullptr, &allowed},
                  found);
    }
    return found.uncovered.speed;
  };
  EXPECT_GT(speedOfUncovered({}), 0.9);
  EXPECT_EQ(speedOfUncovered({{"*", plate_->id}}), 0.0);
}

}  // namespace
}  // namespace sweep_guard_core
