// Drives a guard, started by its launch file or as a nodelet, through its topics. The test is the clock.
#include <gtest/gtest.h>
#include <ros/topic.h>
#include <sweep_guard/ToolShape.h>
#include <sweep_guard/View.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "cube.h"
#include "node_fixture.h"
#include "refusal.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::CheckSweep;
using sweep_guard::Contacts;
using sweep_guard::Warning;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(NodeStartTest, BeginsUnknown) {
  const Warning first = probe().warnings().front();
  EXPECT_EQ(first.level, Warning::UNKNOWN);
  EXPECT_FALSE(first.clear);
  EXPECT_TRUE(first.reflex);
  EXPECT_TRUE(first.considered);
  EXPECT_EQ(first.reasons, Warning::NO_POSE | Warning::NO_MESH) << first.text;
}

TEST(NodeStartTest, PredictWithoutAPoseSaysSo) {
  const auto response = probe().predict(1.0);
  EXPECT_FALSE(response.success);
  EXPECT_TRUE(has(response.message, "no tool pose"));
}

TEST(NodeStartTest, CheckSweepWithoutAWorkpieceSaysSo) {
  const auto response = probe().check(requestAlong({Eigen::Vector3d::Zero()}));
  EXPECT_FALSE(response.success);
  EXPECT_FALSE(response.clear);
  EXPECT_TRUE(has(response.message, "no workpiece"));
}

TEST_F(NodeTest, AClearPathStaysClear) {
  placeSquare("far", {0.0, 0.0, -1.0});
  restAt({0.0, 0.0, 1.0});
  const size_t clear_since = probe().warnings().size();
  for (int i = 0; i < 30; ++i) {
    const Contacts contacts = moveTo({0.001 * i, 0.0, 1.0});
    EXPECT_TRUE(contacts.objects.empty());
    EXPECT_EQ(contacts.header.stamp, probe().time());
  }
  const auto warnings = probe().warnings();
  for (size_t i = clear_since; i < warnings.size(); ++i) EXPECT_TRUE(warnings[i].clear) << warnings[i].text;
}

// The square has no thickness and no pose is nearer to it than 5 cm: only the swept volume meets it.
TEST_F(NodeTest, FindsASquareBetweenTwoPoses) {
  placeSquare("square", {0.0, 0.0, 0.0});
  EXPECT_TRUE(moveTo({0.0, 0.0, 0.05}).objects.empty());
  const ros::Time before = probe().time();
  const Contacts contacts = moveTo({0.0, 0.0, -0.5});
  ASSERT_EQ(contacts.objects.size(), 1U);
  EXPECT_EQ(contacts.objects[0].mesh_id, "square");
  EXPECT_EQ(contacts.objects[0].triangles, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(contacts.interval_start, before);
  EXPECT_EQ(contacts.volume, "obb_planes");
  EXPECT_LT(contacts.margin, 1e-6);
}

// The drill points down and sinks by 0.55 m: its tip comes to the square after 0.05 m, and ends 0.5 m below.
TEST_F(NodeTest, ReportsTimePointAndDepthOfAContact) {
  placeSquare("square", {0.0, 0.0, 0.0});
  moveTo({0.01, 0.02, 0.05});
  const Contacts contacts = moveTo({0.01, 0.02, -0.5});
  ASSERT_EQ(contacts.objects.size(), 1U);
  const auto& object = contacts.objects[0];
  EXPECT_TRUE(object.fine);
  EXPECT_FALSE(object.inside);
  EXPECT_FALSE(object.inside_tested);  // a square has no inside
  ASSERT_FALSE(object.impacts.empty());
  const auto& impact = object.impacts[0];
  EXPECT_NEAR(impact.time_of_impact, 0.05 / 0.55, 1e-6);
  EXPECT_NEAR(impact.point.z, 0.0, 1e-9);
  EXPECT_NEAR(impact.normal.z, 1.0, 1e-9);
  EXPECT_NEAR(impact.depth, 0.5, 1e-9);
}

TEST_F(NodeTest, FindsASquareThatJumpsOverARestingTool) {
  placeSquare("square", {0.0, 0.0, -1.0});
  restAt({0.0, 0.0, 0.0});
  probe().place(squareMovedTo("square", {0.0, 0.0, 1.0}, probe().time()));
  EXPECT_EQ(moveTo({0.0, 0.0, 0.0}).objects.size(), 1U);
  probe().awaitWarning([](const Warning& warning) { return warning.contact; });
  EXPECT_TRUE(moveTo({0.0, 0.0, 0.0}).objects.empty());
}

TEST_F(NodeTest, AToolInsideAClosedMeshIsContact) {
  auto box = squareAt("box", {0.0, 0.0, -1.0}, probe().time(), /*half_side=*/1.0);
  box.open = 0;
  for (int i = 0; i < 4; ++i) {
    box.mesh.vertices.push_back(box.mesh.vertices[static_cast<size_t>(i)]);
    box.mesh.vertices.back().z = 1.0;
  }
  box.mesh.triangles.clear();
  const std::vector<std::array<std::uint32_t, 3>> faces = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7},
                                                           {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5},
                                                           {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  for (const auto& [a, b, c] : faces) {
    box.mesh.triangles.emplace_back();
    box.mesh.triangles.back().vertex_indices = {a, b, c};
  }
  probe().place(box);
  placed_.insert("box");
  const Contacts contacts = moveTo({0.0, 0.0, 0.1});
  ASSERT_EQ(contacts.objects.size(), 1U);
  EXPECT_TRUE(contacts.objects[0].inside && contacts.objects[0].inside_tested);
  EXPECT_TRUE(contacts.objects[0].triangles.empty());
  const Warning warning = probe().awaitWarning([](const Warning& next) { return next.contact; });
  EXPECT_TRUE(has(warning.text, "inside 'box'"));
}

// As an STL or a marker of the type TRIANGLE_LIST gives it.
TEST_F(NodeTest, AToolInsideASolidOfSeparateTrianglesIsContact) {
  probe().place(separated(cubeAt("box", {0.0, 0.0, 0.0}, probe().time(), 1.0)));
  placed_.insert("box");
  const Contacts contacts = moveTo({0.0, 0.0, 0.1});
  ASSERT_EQ(contacts.objects.size(), 1U);
  EXPECT_TRUE(contacts.objects[0].inside && contacts.objects[0].inside_tested);
  EXPECT_TRUE(has(probe().awaitWarning([](const Warning& next) { return next.contact; }).text, "inside 'box'"));
}

TEST_F(NodeTest, AnOpenSolidIsSaidToBeUntestedUntilItIsClosedOrSaidToBeOpen) {
  const auto solid = cubeAt("box", {0.0, 0.0, -2.0}, probe().time(), 1.0);
  auto open = solid;
  open.mesh.triangles.pop_back();
  placed_.insert("box");
  std::uint32_t revision = solid.revision;
  const auto reasonsWith = [&](sweep_guard::DeformableMesh next) {
    next.revision = ++revision;
    next.header.stamp = probe().time();
    probe().place(next);
    restAt({0.0, 0.0, 0.5});
    return probe().warnings().back().reasons & ~std::uint32_t{Warning::JUMP};  // to where it rests
  };
  EXPECT_EQ(reasonsWith(open), std::uint32_t{Warning::INSIDE_UNTESTED});
  const Warning untested = probe().warnings().back();
  EXPECT_TRUE(has(untested.text, "the surface of 'box' is open at 3 edges: the guard cannot tell whether"));
  EXPECT_FALSE(untested.reflex);
  EXPECT_EQ(reasonsWith(solid), 0U);
  open.open = 1;
  EXPECT_EQ(reasonsWith(open), 0U);
}

TEST_F(NodeTest, ContactIsWarnedOfThenHeldThenClear) {
  const Warning contact = touchASquare();
  EXPECT_EQ(contact.level, Warning::CONTACT);
  EXPECT_EQ(contact.mesh_id, "square");
  EXPECT_EQ(contact.triangles, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_TRUE(contact.reflex);
  EXPECT_EQ(contact.header.stamp, probe().time());
  moveTo({0.0, 0.0, 0.3});
  const Warning clear = moveUntil("square", {0.0, 0.0, 0.0}, {0.0, 0.0, 0.3}, isClear);
  EXPECT_GT(clear.sequence, contact.sequence);
  EXPECT_EQ(clear.level_counts[Warning::CONTACT], contact.level_counts[Warning::CONTACT]);
}

TEST_F(NodeTest, SweepsAgainstDeformedVertices) {
  placeSquare("square", {0.0, 0.0, -1.0});
  EXPECT_TRUE(moveTo({0.0, 0.0, 0.5}).objects.empty());
  probe().place(squareMovedTo("square", {0.0, 0.0, 0.5}, probe().time()));
  const Contacts contacts = moveTo({0.0, 0.0, 0.5});
  ASSERT_EQ(contacts.objects.size(), 1U);
  EXPECT_EQ(contacts.objects[0].mesh_stamp, probe().time() - ros::Duration(0.01));
}

// Returns when the guard has the transform, which the frame of a workpiece has at this stamp.
void placeKnown(const std::string& frame, const Eigen::Isometry3d& X_WF) {
  probe().placeFrame(frame, X_WF);
  CheckSweep::Request at_this_stamp;  // answered when the transform has arrived
  at_this_stamp.path = {poseAt(kAway, probe().time())};
  while (!probe().check(at_this_stamp).success) continue;
}

// The tool rests, and the frame of the workpiece moves the square through it.
TEST_F(NodeTest, FindsAWorkpieceThatMovesRigidly) {
  const auto place_frame = [](double z) { placeKnown("table", Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, z))); };
  placeSquare("square", {0.0, 0.0, 0.0}, "table");
  place_frame(-1.0);
  probe().advance(0.01);
  place_frame(-1.0);
  EXPECT_EQ(touchedOnTheWayTo({0.0, 0.0, 0.0}), 0U);
  probe().advance(0.01);
  place_frame(1.0);
  EXPECT_EQ(touchedOnTheWayTo({0.0, 0.0, 0.0}), 1U);
}

TEST_F(NodeTest, FindsATurningWorkpieceOnItsArc) {
  const auto turn_frame = [](double angle) {
    placeKnown("turntable", Eigen::Isometry3d(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ())));
  };
  placeSquare("square", {1.0, 0.0, 0.05}, "turntable", /*half_side=*/0.005);
  turn_frame(-0.25);
  // The tool rests where the square passes by halfway: the chord between both ends misses it by 31 mm.
  probe().tick(0.01);
  turn_frame(-0.25);
  EXPECT_EQ(touchedOnTheWayTo({1.0, 0.0, 0.0}), 0U);
  probe().tick(0.01);
  turn_frame(0.25);
  EXPECT_EQ(touchedOnTheWayTo({1.0, 0.0, 0.0}), 1U);
}

TEST_F(NodeTest, DistinguishesWorkpieces) {
  placeSquare("left", {-1.0, 0.0, 0.0});
  placeSquare("right", {1.0, 0.0, 0.0});
  moveTo({-1.0, 0.0, 0.5});
  const Contacts contacts = moveTo({-1.0, 0.0, -0.5});
  ASSERT_EQ(contacts.objects.size(), 1U);
  EXPECT_EQ(contacts.objects[0].mesh_id, "left");
}

// No pose is lost, however they queue: the flick of 2 ms in the middle is found.
TEST_F(NodeTest, EveryPoseOfABurstIsSwept) {
  placeSquare("square", {0.0, 0.0, -1.0});
  probe().advance(0.5);
  probe().forgetContacts();
  const ros::Time begin = probe().time() - ros::Duration(0.5);
  for (int i = 1; i <= 500; ++i) {
    probe().publish(poseAt({0.0, 0.0, i == 250 ? -1.5 : 0.5}, begin + ros::Duration(0.001 * i)));
  }
  const std::vector<Contacts> contacts = probe().awaitContactsUpTo(probe().time());
  EXPECT_TRUE(endToEnd(contacts));
  EXPECT_GE(contactCount(contacts), 1U);
  EXPECT_LE(contactCount(contacts), 2U);
}

TEST_F(NodeTest, PosesOfOneStampAreSweptToo) {
  placeSquare("square", {0.0, 0.0, 0.0});
  moveTo({0.0, 0.0, 0.05});
  const Contacts contacts = probe().move(poseAt({0.0, 0.0, -0.5}, probe().time()));
  EXPECT_EQ(contacts.objects.size(), 1U);
  EXPECT_EQ(contacts.interval_start, contacts.header.stamp);
}

template <typename Message>
struct Bad {
  const char* name;
  std::function<void(Message&)> spoil;
  std::uint32_t reason = Warning::MESH_INVALID;
};
template <typename Message>
void PrintTo(const Bad<Message>& bad, std::ostream* out) {
  *out << bad.name;
}
using BadPose = Bad<geometry_msgs::PoseStamped>;
using BadMesh = Bad<sweep_guard::DeformableMesh>;
using BadVertices = Bad<sweep_guard::MeshVertices>;

class BadPoseTest : public NodeTest, public ::testing::WithParamInterface<BadPose> {};

// The next pose is swept from the last good one.
TEST_P(BadPoseTest, IsRefusedAndIsUnknownAndLeavesNoGap) {
  placeSquare("square", {0.0, 0.0, 0.0});
  restAt({0.0, 0.0, 0.05});
  const ros::Time last_good = probe().time();
  probe().advance(0.01);
  auto bad = poseAt({0.0, 0.0, 0.05}, probe().time());
  GetParam().spoil(bad);
  probe().publish(bad);
  probe().awaitWarning(hasReason(GetParam().reason));

  const Contacts contacts = moveTo({0.0, 0.0, -0.5});
  EXPECT_EQ(contacts.interval_start, last_good);
  EXPECT_EQ(contacts.objects.size(), 1U);
  moveTo({0.0, 0.0, -0.5});
  probe().awaitWarning([](const Warning& warning) { return warning.reasons == 0; });
}

INSTANTIATE_TEST_SUITE_P(
    Poses, BadPoseTest,
    ::testing::Values(
        BadPose{"NanPosition", [](auto& pose) { pose.pose.position.y = kNan; }, Warning::POSE_INVALID},
        BadPose{"InfiniteOrientation", [](auto& pose) { pose.pose.orientation.x = INFINITY; }, Warning::POSE_INVALID},
        BadPose{"ZeroQuaternion", [](auto& pose) { pose.pose.orientation.x = 0.0; }, Warning::POSE_INVALID},
        BadPose{"LongQuaternion", [](auto& pose) { pose.pose.orientation.x = 1.2; }, Warning::POSE_INVALID},
        BadPose{"FarAway", [](auto& pose) { pose.pose.position.z = 1e8; }, Warning::POSE_INVALID},
        BadPose{"NoStamp", [](auto& pose) { pose.header.stamp = ros::Time(); }, Warning::POSE_INVALID},
        BadPose{"StampGoesBack", [](auto& pose) { pose.header.stamp -= ros::Duration(0.5); }, Warning::OUT_OF_ORDER},
        BadPose{"StampInTheFuture", [](auto& pose) { pose.header.stamp += ros::Duration(1.0); }, Warning::FUTURE_STAMP},
        BadPose{"UnknownFrame", [](auto& pose) { pose.header.frame_id = "nowhere"; }, Warning::TF_FAIL},
        BadPose{"NoFrame", [](auto& pose) { pose.header.frame_id = ""; }, Warning::TF_FAIL}),
    [](const auto& test) { return test.param.name; });

// /clock has its own connection, and may be late.
TEST_F(NodeTest, WaitsWhenAPoseOvertakesTheSimulatedClock) {
  placeSquare("square", {0.0, 0.0, 0.0});
  moveTo({0.0, 0.0, 0.05});
  const ros::Time ahead = probe().time() + ros::Duration(0.2);
  const size_t before = probe().warnings().size();
  probe().forgetContacts();
  probe().publish(poseAt({0.0, 0.0, -0.05}, ahead));
  probe().advance(0.2);
  EXPECT_EQ(probe().awaitContactsUpTo(ahead).back().objects.size(), 1U);
  const std::vector<Warning> warnings = probe().warnings();
  for (size_t i = before; i < warnings.size(); ++i) EXPECT_EQ(warnings[i].reasons & Warning::FUTURE_STAMP, 0U);
}

class BadMeshTest : public NodeTest, public ::testing::WithParamInterface<BadMesh> {};

TEST_P(BadMeshTest, IsRefusedAndIsUnknownUntilAGoodOne) {
  placeSquare("square", {0.0, 0.0, 0.0});
  moveTo({0.0, 0.0, 0.05});
  auto bad = squareAt("square", {0.0, 0.0, -1.0}, probe().time());
  bad.revision = 2;
  GetParam().spoil(bad);
  probe().publish(bad);
  const Warning warning = probe().awaitWarning(hasReason(Warning::MESH_INVALID));
  EXPECT_TRUE(has(warning.text, "refused"));

  EXPECT_EQ(moveTo({0.0, 0.0, -0.5}).objects.size(), 1U);
  probe().place(squareMovedTo("square", {0.0, 0.0, 0.01}, probe().time()));  // still for the old mesh
  moveTo({0.0, 0.0, -0.5});
  const auto of_newest_pose = [](const Warning& later) { return later.header.stamp == probe().time(); };
  EXPECT_NE(probe().awaitWarning(of_newest_pose).reasons & Warning::MESH_INVALID, 0U);
  placeSquare("square", {0.0, 0.0, 0.02});
  probe().awaitWarning([](const Warning& later) { return (later.reasons & Warning::MESH_INVALID) == 0; });
}

// As a latched one does while the clock of a simulation is silent: nobody sends it again.
TEST_F(NodeTest, AMeshThatCameBeforeTheClockIsTakenWhenTheClockHasCome) {
  const auto early = squareAt("square", {0.0, 0.0, -1.0}, probe().time() + ros::Duration(2.0));
  placed_.insert("square");
  probe().publish(early);
  EXPECT_TRUE(has(probe().awaitWarning(hasReason(Warning::MESH_INVALID)).text, "stamp lies in the future"));
  probe().advance(1.9);
  probe().skipWarnings();
  EXPECT_NE(probe().awaitWarning([](const Warning&) { return true; }).reasons & Warning::MESH_INVALID, 0U);
  probe().advance(0.2);
  probe().awaitWarning([](const Warning& later) { return (later.reasons & Warning::MESH_INVALID) == 0; });
  restAt({0.0, 0.0, 0.5});
  moveTo({0.0, 0.0, -1.5});
  EXPECT_TRUE(probe().awaitWarning([](const Warning& later) { return later.contact; }).contact);
}

TEST_F(NodeTest, VerticesThatFollowAMeshThatCameBeforeTheClockDeformIt) {
  const auto early = squareAt("square", {0.0, 0.0, -1.0}, probe().time() + ros::Duration(2.0));
  placed_.insert("square");
  probe().publish(early);
  probe().awaitWarning(hasReason(Warning::MESH_INVALID));
  probe().advance(2.1);
  probe().awaitWarning([](const Warning& later) { return later.valid_until >= probe().time() + ros::Duration(0.2); });
  probe().place(squareMovedTo("square", {0.0, 0.0, 0.0}, probe().time()));
  moveTo({0.0, 0.0, 0.05});
  EXPECT_EQ(moveTo({0.0, 0.0, -0.01}).objects.size(), 1U);
}

INSTANTIATE_TEST_SUITE_P(
    Meshes, BadMeshTest,
    ::testing::Values(BadMesh{"NanVertex", [](auto& mesh) { mesh.mesh.vertices[3].z = kNan; }},
                      BadMesh{"IndexOutOfRange", [](auto& mesh) { mesh.mesh.triangles[1].vertex_indices[2] = 4; }},
                      BadMesh{"NoTriangles", [](auto& mesh) { mesh.mesh.triangles.clear(); }},
                      BadMesh{"NoFrame", [](auto& mesh) { mesh.header.frame_id = ""; }},
                      BadMesh{"StampInTheFuture", [](auto& mesh) { mesh.header.stamp += ros::Duration(1.0); }}),
    [](const auto& test) { return test.param.name; });

class BadVerticesTest : public NodeTest, public ::testing::WithParamInterface<BadVertices> {};

TEST_P(BadVerticesTest, AreRefusedAndAreUnknown) {
  placeSquare("square", {0.0, 0.0, 0.0});
  moveTo({0.0, 0.0, 0.05});
  auto bad = squareMovedTo("square", {0.0, 0.0, -1.0}, probe().time());
  GetParam().spoil(bad);
  probe().publish(bad);
  probe().awaitWarning(hasReason(Warning::MESH_INVALID));
  EXPECT_EQ(moveTo({0.0, 0.0, -0.5}).objects.size(), 1U);
  placed_.insert(bad.id);  // to be removed: the guard warns until then
}

INSTANTIATE_TEST_SUITE_P(
    Vertices, BadVerticesTest,
    ::testing::Values(BadVertices{"TooFew", [](auto& vertices) { vertices.positions.pop_back(); }},
                      BadVertices{"TooCoarseInFloat32", [](auto& vertices) { vertices.positions[1] = 4e6F; }},
                      BadVertices{"Infinite", [](auto& vertices) { vertices.positions[0] = INFINITY; }},
                      BadVertices{"UnknownWorkpiece", [](auto& vertices) { vertices.id = "ghost"; }},
                      BadVertices{"NoId", [](auto& vertices) { vertices.id = ""; }}),
    [](const auto& test) { return test.param.name; });

TEST_F(NodeTest, AnEmptyMeshRemovesTheWorkpiece) {
  placeSquare("square", {0.0, 0.0, -1.0});
  restAt({0.0, 0.0, 0.5});
  probe().remove("square");
  placed_.clear();
  probe().awaitWarning(hasReason(Warning::NO_MESH));
}

TEST_F(NodeTest, AWorkpieceThatHasNotBeenSweptIsNotClear) {
  placeSquare("first", {0.0, 0.0, -1.0});
  restAt({0.0, 0.0, 0.5});
  placeSquare("second", {0.0, 0.0, -2.0});
  probe().awaitWarning(hasReason(Warning::NOT_SWEPT));
  restAt({0.0, 0.0, 0.5});
}

TEST_F(NodeTest, AWorkpieceInAnUnknownFrameIsNotClear) {
  placeSquare("known", {0.0, 0.0, -1.0});
  restAt({0.0, 0.0, 0.5});
  auto lost = squareAt("lost", {0.0, 0.0, -1.0}, probe().time());
  lost.header.frame_id = "nowhere";
  probe().publish(lost);
  placed_.insert("lost");
  probe().awaitWarning(hasReason(Warning::NOT_SWEPT));
  moveTo({0.0, 0.0, 0.5});
  const Warning warning = probe().awaitWarning(hasReason(Warning::TF_FAIL));
  EXPECT_TRUE(has(warning.text, "nowhere"));
}

TEST_F(NodeTest, StalePosesAndMeshesAreUnknownOnTheStampClock) {
  placeSquare("square", {0.0, 0.0, -1.0});
  restAt({0.0, 0.0, 0.5});
  probe().advance(1.001);
  probe().awaitWarning(hasReason(Warning::POSE_STALE));
  probe().advance(9.0);
  probe().awaitWarning(hasReason(Warning::MESH_STALE));
}

TEST_F(NodeTest, TimeThatGoesBackForgetsAndRecovers) {
  placeSquare("square", {0.0, 0.0, 0.0});
  moveTo({0.0, 0.0, 0.5});
  probe().setClock(probe().time() - ros::Duration(100.0));
  const Warning jump = probe().awaitWarning(hasReason(Warning::TIME_JUMP));
  EXPECT_NE(jump.reasons & Warning::NO_POSE, 0U);
  probe().awaitWarning(hasReason(Warning::MESH_STALE));

  const Contacts first = moveTo({0.0, 0.0, -0.5});  // no motion from a pose of the time before
  EXPECT_EQ(first.interval_start, first.header.stamp);
  EXPECT_TRUE(first.objects.empty());
  moveUntil("square", {0.0, 0.0, 0.0}, {0.0, 0.0, -0.5}, isClear);
}

TEST_F(NodeTest, TransformsOfTheTimeBeforeItWentBackDoNotCount) {
  const auto pose_now = [] {
    auto pose = poseAt({0.0, 0.0, 0.5}, probe().time());
    pose.header.frame_id = "cart";
    return pose;
  };
  const auto place_frame = [&] {
    probe().placeFrame("cart", Eigen::Isometry3d::Identity());
    CheckSweep::Request at_this_stamp;  // answered when the transform has arrived
    at_this_stamp.path = {pose_now()};
    ASSERT_TRUE(probe().check(at_this_stamp).success);
  };
  placeSquare("square", {0.0, 0.0, 0.0});
  place_frame();
  probe().advance(5.0);
  place_frame();
  EXPECT_EQ(probe().move(pose_now()).header.stamp, probe().time());
  probe().setClock(probe().time() - ros::Duration(3.0));
  probe().publish(pose_now());
  probe().awaitWarning(hasReason(Warning::TF_FAIL));
  probe().advance(0.01);
  place_frame();
  EXPECT_EQ(probe().move(pose_now()).header.stamp, probe().time());
}

TEST_F(NodeTest, CheckSweepFindsASquareOnThePath) {
  placeSquare("square", {0.0, 0.0, 0.0});
  const auto response = probe().check(requestAlong({{0.0, 0.0, 1.0}, {0.0, 0.0, 0.5}, {0.0, 0.0, -0.5}}));
  ASSERT_TRUE(response.success) << response.message;
  EXPECT_TRUE(response.collision);
  EXPECT_FALSE(response.clear);
  EXPECT_EQ(response.segment, 1U);
  EXPECT_TRUE(std::isnan(response.time_of_impact));
  ASSERT_EQ(response.objects.size(), 1U);
  EXPECT_EQ(response.objects[0].triangles, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_GT(response.compute_time.toSec(), 0.0);
}

TEST_F(NodeTest, CheckSweepReturnsTheTimeOfImpactOnRequest) {
  placeSquare("square", {0.0, 0.0, 0.0});
  CheckSweep::Request request = requestAlong({{0.01, 0.02, 1.0}, {0.01, 0.02, 0.5}, {0.01, 0.02, -0.5}});
  request.fine = true;
  const auto response = probe().check(request);
  ASSERT_TRUE(response.success) << response.message;
  EXPECT_TRUE(response.collision);
  EXPECT_EQ(response.segment, 1U);
  EXPECT_NEAR(response.time_of_impact, 0.5, 1e-6);
  ASSERT_EQ(response.objects.size(), 1U);
  EXPECT_TRUE(response.objects[0].fine);
  ASSERT_FALSE(response.objects[0].impacts.empty());
  EXPECT_NEAR(response.objects[0].impacts[0].depth, 0.5, 1e-9);
}

TEST_F(NodeTest, CheckSweepOfAFreePathIsClear) {
  placeSquare("square", {0.0, 0.0, 0.0});
  CheckSweep::Request request = requestAlong({{1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}});
  for (const char* detector : {"", "select", "reference"}) {
    for (const char* volume : {"", "obb", "obb_planes", "hull"}) {
      request.detector = detector;
      request.volume = volume;
      const auto response = probe().check(request);
      EXPECT_TRUE(response.success && response.clear && !response.collision) << response.message;
    }
  }
}

TEST_F(NodeTest, CheckSweepOfAStaleWorkpieceIsFreeButNotClear) {
  placeSquare("square", {0.0, 0.0, 0.0});
  probe().advance(10.1);
  const auto response = probe().check(requestAlong({{1.0, 0.0, 0.0}}));
  EXPECT_TRUE(response.success);
  EXPECT_FALSE(response.collision);
  EXPECT_FALSE(response.clear);
}

TEST_F(NodeTest, CheckSweepOfOnePoseTestsWhereItStands) {
  placeSquare("square", {0.0, 0.0, 0.0});
  EXPECT_TRUE(probe().check(requestAlong({{0.0, 0.0, -0.05}})).collision);  // the tool is 0.15 m long and points down
  CheckSweep::Request request = requestAlong({{0.0, 0.0, 0.01}});
  EXPECT_FALSE(probe().check(request).collision);
  request.margin = 0.02;
  const auto grown = probe().check(request);
  EXPECT_TRUE(grown.collision);
  EXPECT_GE(grown.margin, 0.02);
}

TEST_F(NodeTest, CheckSweepTestsTheWorkpiecesItIsAskedFor) {
  placeSquare("left", {-1.0, 0.0, 0.0});
  placeSquare("right", {1.0, 0.0, 0.0});
  CheckSweep::Request request = requestAlong({{-1.0, 0.0, 0.5}, {-1.0, 0.0, -0.5}});
  request.mesh_ids = {"right"};
  EXPECT_TRUE(probe().check(request).clear);
  request.mesh_ids = {"left", "right", "left"};
  const auto both = probe().check(request);
  ASSERT_EQ(both.objects.size(), 1U);
  EXPECT_EQ(both.objects[0].mesh_id, "left");
}

TEST_F(NodeTest, CheckSweepRefusesWhatItCannotTest) {
  placeSquare("square", {0.0, 0.0, 0.0});
  CheckSweep::Request good = requestAlong({{1.0, 0.0, 0.0}});
  const auto refused = [&](const std::function<void(CheckSweep::Request&)>& spoil, const std::string& expected) {
    CheckSweep::Request request = good;
    spoil(request);
    const auto response = probe().check(request);
    EXPECT_FALSE(response.success || response.clear || response.collision);
    EXPECT_TRUE(has(response.message, expected));
  };
  refused([](auto& request) { request.path.clear(); }, "empty");
  refused([](auto& request) { request.path.assign(1025, request.path[0]); }, "1025 poses");
  refused([](auto& request) { request.path[0].pose.position.x = kNan; }, "pose 0");
  refused([](auto& request) { request.path[0].header.frame_id = "nowhere"; }, "nowhere");
  refused([](auto& request) { request.mesh_ids = {"ghost"}; }, "ghost");
  refused([](auto& request) { request.volume = "sphere"; }, "sphere");
  refused([](auto& request) { request.detector = "oracle"; }, "oracle");
  refused([](auto& request) { request.margin = -1.0; }, "margin");
  refused([](auto& request) { request.margin = kNan; }, "margin");
  EXPECT_TRUE(probe().check(good).clear);
  good.path.assign(1024, good.path[0]);
  EXPECT_TRUE(probe().check(good).clear);
}

TEST_F(NodeTest, MarkersShowToolVolumeAndTouchedTriangles) {
  placeSquare("square", {0.0, 0.0, 0.0});
  moveTo({0.0, 0.0, 0.05});
  moveTo({0.0, 0.0, -0.05});
  std::set<std::string> namespaces;
  const auto markers = probe().awaitMarkers([&](const visualization_msgs::MarkerArray& drawn) {
    namespaces.clear();
    for (const auto& marker : drawn.markers) {
      if (marker.action == visualization_msgs::Marker::ADD) namespaces.insert(marker.ns);
    }
    // A contact of the test before may still be held: the newest sweep has to have met the square.
    return namespaces.count("contact_triangles") + namespaces.count("swept_volume") == 2;
  });
  for (const char* expected : {"tool", "swept_volume", "contact_triangles", "trajectory", "warning_text"}) {
    EXPECT_EQ(namespaces.count(expected), 1U) << expected;
  }
  for (const auto& marker : markers.markers) {
    EXPECT_EQ(marker.lifetime, ros::Duration(0.5));
    EXPECT_TRUE(marker.color.a < 1.0F || marker.ns == "workpieces") << marker.ns;
    EXPECT_EQ(marker.header.frame_id, "world");
  }
}

TEST_F(NodeTest, MarkersShowAWorkpieceUntilItIsRemoved) {
  using visualization_msgs::Marker;
  placeSquare("square", {0.0, 0.0, 0.0}, "world", /*half_side=*/0.07);
  Marker drawn;
  probe().awaitMarkers([&](const visualization_msgs::MarkerArray& array) {
    for (const Marker& marker : array.markers) {
      if (marker.ns == "workpieces" && !marker.points.empty() && std::abs(std::abs(marker.points[0].x) - 0.07) < 1e-6)
        drawn = marker;
    }
    return !drawn.points.empty();
  });
  EXPECT_EQ(drawn.points.size(), 6U);
  EXPECT_EQ(drawn.header.frame_id, "world");
  probe().remove("square");
  placed_.erase("square");
  probe().awaitMarkers([&](const visualization_msgs::MarkerArray& array) {
    return std::any_of(array.markers.begin(), array.markers.end(), [&](const Marker& marker) {
      return marker.ns == "workpieces" && marker.id == drawn.id && marker.action == Marker::DELETE;
    });
  });
}

TEST_F(NodeTest, TheViewShowsVolumesAndContacts) {
  placeSquare("square", {0.0, 0.0, 0.0});
  moveTo({0.0, 0.0, 0.05});
  moveTo({0.0, 0.0, -0.05});
  sweep_guard::View::ConstPtr view;
  do {
    view = ros::topic::waitForMessage<sweep_guard::View>("/sweep_guard/view");
  } while (view && (view->objects.empty() || view->objects[0].touched.empty()));
  ASSERT_TRUE(view);
  EXPECT_EQ(view->header.frame_id, "world");
  EXPECT_EQ(view->level, sweep_guard::Warning::CONTACT);
  EXPECT_EQ(view->objects[0].mesh_id, "square");
  EXPECT_EQ(view->objects[0].touched, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_FALSE(view->objects[0].measured.empty());
  EXPECT_FALSE(view->objects[0].impacts.empty());
}

TEST_F(NodeTest, TheShapeOfTheToolIsLatched) {
  const auto tool = ros::topic::waitForMessage<sweep_guard::ToolShape>("/sweep_guard/tool");
  ASSERT_TRUE(tool);
  EXPECT_EQ(tool->header.frame_id, "tool");
  EXPECT_EQ(tool->parts.size(), 1U);
}

}  // namespace
}  // namespace sweep_guard_ros
