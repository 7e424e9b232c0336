// Tools of several bodies. Bodies of which the pose is not told are spheres of 10 mm.
#include <gtest/gtest.h>

#include <set>

#include "allocations.h"
#include "kinematics/random_robot.h"
#include "motion/proximity_truth.h"
#include "motion/random_scenes.h"
#include "sweep_guard/kinematics/robot_path.h"
#include "sweep_guard/motion/proximity_finder.h"

namespace sweep_guard_core {
namespace {

BodyTools bodiesOf(const std::vector<Tool>& tools) {
  BodyTools bodies;
  for (const Tool& tool : tools) bodies.push_back(&tool);
  return bodies;
}

Tool ballOf(const std::string& link) { return Tool({ConvexPiece{link, ConvexShape::sphere(0.01)}}); }

PoseWithFrames poseOfBodies(const std::vector<Isometry3d>& X_WB, const Isometry3d& X_WM = Isometry3d::Identity()) {
  PoseWithFrames pose{Time(100s), SteadyTime(100s), Isometry3d::Identity(), {{kFrame, X_WM}}};
  pose.bodies.clear();
  for (const Isometry3d& X : X_WB) pose.bodies.push_back({X});
  return pose;
}

// Of two triangles, in z = 0.
std::shared_ptr<const Workpiece> sheet() {
  const std::vector<Vector3d> vertices = {{-1.0, -1.0, 0.0}, {1.0, -1.0, 0.0}, {1.0, 1.0, 0.0}, {-1.0, 1.0, 0.0}};
  return workpieceOf(TriangleMesh(vertices, {{0, 1, 2}, {0, 2, 3}}));
}

std::set<size_t> piecesWithPlanes(const Proximity& found) {
  std::set<size_t> pieces;
  for (const ProximityPlane& each : found.planes) pieces.insert(each.plane.piece);
  return pieces;
}

Robot armOf(Random& random, size_t links) {
  KinematicTree tree = randomRobot(random, links, /*branches=*/false);
  std::vector<std::pair<size_t, std::vector<ConvexPiece>>> pieces;
  for (size_t i = 0; i < links; ++i) pieces.emplace_back(i, toolOfAllShapes(random).pieces());
  return robotOf(std::move(tree), pieces);
}

TEST(ProximityBodiesTest, EveryTriangleIsBoundedBeforeEveryPieceOfAnArmOfSevenLinks) {
  Met met;
  size_t several = 0;
  for (std::uint64_t seed = 0; seed < caseCount(100); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Robot arm = armOf(random, 7);
    std::vector<Isometry3d> X_WB;
    bodyPoses(arm.tree, arm.bodies, randomState(random, arm.tree, 2.0), X_WB);
    const Isometry3d& X_near = X_WB[static_cast<size_t>(random.below(static_cast<int>(X_WB.size())))];
    const PoseWithFrames pose = poseOfBodies(X_WB, X_near * random.pose(random.inBox({0.2, 0.2, 0.2})));
    const auto workpiece = workpieceOf(randomMesh(random));
    const double reach = random.logUniform(0.01, 0.6);
    ProximityFinder finder;
    Proximity found;
    finder.find({bodiesOf(arm.tools), pose, {workpiece}, reach}, found);
    const BruteForce truth(bodiesOf(arm.tools), pose, *workpiece, nullptr, pose.X_WM.at(kFrame));
    expectAllBounded(truth, reach, found, met);
    expectPlanesInFront(truth, found, met);
    if (HasFatalFailure()) return;
    std::set<size_t> bodies;
    for (const size_t piece : piecesWithPlanes(found)) bodies.insert(truth.bodyOf(piece));
    if (bodies.size() > 1) ++several;
  }
  EXPECT_GT(met.behind, 1000U);
  EXPECT_GT(met.left_over, 1000U);
  EXPECT_GT(met.contacts, 20U);
  EXPECT_GT(met.full, 3U);
  EXPECT_GT(several, 10U);
}

TEST(ProximityBodiesTest, ABodyOutOfReachHasNoPlaneAndIsNoNearerThanWhatIsUncovered) {
  const std::vector<Tool> tools = {ballOf("near"), ballOf("far")};
  const Workpieces workpieces = {sheet()};
  ProximityFinder finder;
  Proximity found;
  finder.find({bodiesOf(tools), poseOfBodies({placedAt(0.0, 0.0, 0.05), placedAt(0.3, 0.0, 0.31)}), workpieces, 0.1},
              found);
  EXPECT_EQ(piecesWithPlanes(found), std::set<size_t>{0});
  EXPECT_NEAR(found.uncovered.distance, 0.3, 1e-5);
  EXPECT_LE(found.uncovered.distance, 0.3);
  finder.find({{&tools[0]}, poseOfBodies({placedAt(0.0, 0.0, 0.05)}), workpieces, 0.1}, found);
  EXPECT_EQ(found.uncovered.distance, kInfinity);
}

// The first body has two pieces.
TEST(ProximityBodiesTest, PiecesAreCountedThroughAllBodies) {
  const ConvexShape ball = ConvexShape::sphere(0.01);
  const std::vector<Tool> tools = {Tool({{"upper", ball}, {"upper", ball.placed(placedAt(0.1, 0.0, 0.0))}}),
                                   ballOf("fore")};
  ProximityFinder finder;
  Proximity found;
  finder.find({bodiesOf(tools), poseOfBodies({placedAt(0.0, 0.0, 0.06), placedAt(0.0, 0.3, -0.03)}), {sheet()}, 0.1},
              found);
  EXPECT_EQ(piecesWithPlanes(found), (std::set<size_t>{0, 1, 2}));
  ASSERT_EQ(found.planes[0].plane.piece, 2U);
  EXPECT_NEAR(found.planes[0].plane.normal_W.z(), -1.0, 1e-9);
  EXPECT_NEAR(found.planes[0].plane.gap, 0.95 * 0.02, 1e-5);
}

// One is above the sheet and one below; the sweep tells of the first only.
TEST(ProximityBodiesTest, AContactGivesItsNormalToTheBodyThatTouched) {
  const std::vector<Tool> tools = {ballOf("above"), ballOf("below")};
  const auto workpiece = sheet();
  const Vector3d first_touched(0.6, 0.0, 0.8);
  SweepReport report;
  report.objects.resize(1);
  report.objects[0].workpiece = workpiece;
  for (const std::uint32_t triangle : {0U, 1U})
    report.objects[0].result.in_contact.push_back({triangle, 0, {0.0, Vector3d::Zero(), first_touched, 0.0}});
  ProximityFinder finder;
  Proximity found;
  finder.find({bodiesOf(tools),
               poseOfBodies({placedAt(0.2, 0.0, 0.009), placedAt(-0.2, 0.0, -0.009)}),
               {workpiece},
               0.1,
               &report},
              found);
  EXPECT_EQ(piecesWithPlanes(found), (std::set<size_t>{0, 1}));
  for (const ProximityPlane& each : found.planes) {
    const Vector3d expected = each.plane.piece == 0 ? first_touched : Vector3d(0.0, 0.0, -1.0);
    EXPECT_NEAR(each.plane.normal_W.dot(expected), 1.0, 1e-9) << each.plane.piece;
  }
}

// Both reach 3 mm into the sheet.
TEST(ProximityBodiesTest, WhatALinkMayTouchHoldsForItsBodyAlone) {
  const std::vector<Tool> tools = {ballOf("hand"), ballOf("bit")};
  const auto workpiece = sheet();
  const PoseWithFrames pose = poseOfBodies({placedAt(0.2, 0.0, 0.007), placedAt(-0.2, 0.0, 0.007)});
  ProximityFinder finder;
  Proximity found;
  const AllowedPairs allowed = {{"bit", "*"}};
  finder.find({bodiesOf(tools), pose, {workpiece}, 0.1, nullptr, nullptr, &allowed}, found);
  EXPECT_EQ(piecesWithPlanes(found), std::set<size_t>{0});

  Intention region;
  region.mesh_id = workpiece->id;
  region.mesh_triangles = std::shared_ptr<const std::vector<Triangle>>(workpiece, &workpiece->mesh_M.triangles());
  region.depth = 0.005;
  region.tool_links = {"bit"};
  region.triangles = {0, 1};
  const Intentions intentions = {region};
  finder.find({bodiesOf(tools), pose, {workpiece}, 0.1, nullptr, &intentions}, found);
  ASSERT_EQ(piecesWithPlanes(found), (std::set<size_t>{0, 1}));
  for (const ProximityPlane& each : found.planes)
    EXPECT_NEAR(each.plane.gap, each.plane.piece == 0 ? -0.003 : 0.002, 2e-4);
}

// The bit is 0.19 m below the sheet, which counts for it from 0.15 m below on; the search ends at the arm, 0.15 m above.
TEST(ProximityBodiesTest, ABodyOutOfReachOfAMeshMayBeNearToWhereItIsMeantToTouchIt) {
  const std::vector<Tool> tools = {ballOf("bit"), ballOf("hand"), ballOf("arm")};
  const auto workpiece = sheet();
  Intention region;
  region.mesh_id = workpiece->id;
  region.mesh_triangles = std::shared_ptr<const std::vector<Triangle>>(workpiece, &workpiece->mesh_M.triangles());
  region.depth = 0.15;
  region.tool_links = {"bit"};
  region.triangles = {0, 1};
  const Intentions intentions = {region};
  ProximityFinder finder;
  Proximity found;
  finder.find({bodiesOf(tools),
               poseOfBodies({placedAt(0.0, 0.0, -0.2), placedAt(0.0, 0.0, 0.05), placedAt(0.0, 0.0, 0.16)}),
               {workpiece},
               0.1,
               nullptr,
               &intentions},
              found);
  EXPECT_EQ(piecesWithPlanes(found), (std::set<size_t>{0, 1}));
}

TEST(ProximityBodiesTest, AnArmAllocatesNothing) {
  Random random(5);
  const Robot arm = armOf(random, 7);
  const Workpieces workpieces = {workpieceOf(wavyHull(20, 40, 0.0))};
  const BodyTools bodies = bodiesOf(arm.tools);
  std::vector<PoseWithFrames> poses;
  RobotState state = randomState(random, arm.tree, 1.0);
  for (int i = 0; i < 50; ++i) {
    state = randomStateNear(random, state, 0.1);
    std::vector<Isometry3d> X_WB;
    bodyPoses(arm.tree, arm.bodies, state, X_WB);
    poses.push_back(poseOfBodies(X_WB, X_WB[3]));
  }
  ProximityFinder finder;
  Proximity found;
  const auto run = [&] {
    for (const PoseWithFrames& pose : poses) finder.find({bodies, pose, workpieces, 0.1}, found);
  };
  run();
  const Allocations made;
  run();
  EXPECT_EQ(made.count(), 0U) << made.stacks();
}

}  // namespace
}  // namespace sweep_guard_core
