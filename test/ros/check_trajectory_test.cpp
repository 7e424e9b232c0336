// Trajectories of an arm along x, 1 m above the origin: upper arm 0.3 m, forearm 0.2 m, two fingers.
#include <gtest/gtest.h>
#include <sweep_guard/CheckTrajectory.h>

#include <cmath>
#include <limits>

#include "node_fixture.h"
#include "refusal.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::CheckTrajectory;

using JointPositions = std::vector<double>;

CheckTrajectory::Request along(const std::vector<std::string>& joints, const std::vector<JointPositions>& points) {
  CheckTrajectory::Request request;
  request.trajectory.joint_names = joints;
  for (const JointPositions& positions : points) {
    request.trajectory.points.emplace_back();
    request.trajectory.points.back().positions = positions;
  }
  request.tool_pose.header.frame_id = "world";
  request.tool_pose.pose.position.z = 1.0;
  request.tool_pose.pose.orientation.w = 1.0;
  request.fine = true;
  return request;
}

class CheckTrajectoryTest : public NodeTest {
 protected:
  static CheckTrajectory::Response check(CheckTrajectory::Request request) {
    CheckTrajectory::Response response;
    EXPECT_TRUE(ros::service::call("/sweep_guard/check_trajectory", request, response));
    return response;
  }
};

// The forearm stays level and passes the square, which is under the upper arm.
TEST_F(CheckTrajectoryTest, FindsTheUpperArmThatHitsWhatTheHandPasses) {
  placeSquare("square", {0.15, 0.0, 0.85}, "world", /*half_side=*/0.02);
  const auto response = check(along({"shoulder", "elbow"}, {{0.0, 0.0}, {0.3, -0.3}, {1.0, -1.0}}));
  ASSERT_TRUE(response.success) << response.message;
  EXPECT_TRUE(response.collision);
  EXPECT_FALSE(response.clear);
  EXPECT_EQ(response.tool_link, "upper");
  EXPECT_EQ(response.mesh_id, "square");
  EXPECT_EQ(response.segment, 1U);
  // The upper arm, 2 cm thick, meets the square's near edge, 0.13 m from the shoulder and 0.15 m below.
  const double angle = std::atan2(0.15, 0.13) - std::asin(0.01 / std::hypot(0.15, 0.13));
  const double farther = std::atan2(0.15, 0.17) - std::asin(0.01 / std::hypot(0.15, 0.17));
  EXPECT_NEAR(response.time_of_impact, (std::min(angle, farther) - 0.3) / 0.7, 0.01);
  EXPECT_GT(response.time_of_impact, 0.0);
  EXPECT_GT(response.sweeps, 2U);
  EXPECT_GT(response.deviation, 0.0);
  EXPECT_LE(response.deviation, 5e-4);
  ASSERT_EQ(response.objects.size(), 1U);
  EXPECT_EQ(response.objects[0].impacts.at(0).tool_link, "upper");
}

TEST_F(CheckTrajectoryTest, TheHandAloneWouldMissIt) {
  placeSquare("square", {0.15, 0.0, 0.85}, "world", /*half_side=*/0.02);
  const auto response = check(along({"shoulder", "elbow"}, {{0.0, 0.0}, {0.5, -0.5}}));
  ASSERT_TRUE(response.success) << response.message;
  EXPECT_FALSE(response.collision);
  EXPECT_TRUE(response.clear) << response.message;
  EXPECT_TRUE(std::isnan(response.time_of_impact));
}

// Neither end of the segment touches anything.
TEST_F(CheckTrajectoryTest, MeetsWhatIsBetweenTwoPoints) {
  placeSquare("square", {0.45, 0.0, 1.0}, "world", /*half_side=*/0.02);
  const auto response = check(along({"shoulder"}, {{-1.0}, {1.0}}));
  ASSERT_TRUE(response.success) << response.message;
  EXPECT_TRUE(response.collision);
  EXPECT_EQ(response.tool_link, "fore");
  EXPECT_NEAR(response.time_of_impact, 0.49, 0.02);
}

TEST_F(CheckTrajectoryTest, NamesTheFingerThatTouchesFirst) {
  placeSquare("square", {0.52, -0.02, 1.0}, "world", /*half_side=*/0.003);
  const auto response = check(along({"jaw"}, {{0.04}, {0.0}}));
  ASSERT_TRUE(response.success) << response.message;
  EXPECT_TRUE(response.collision);
  EXPECT_EQ(response.tool_link, "right");  // which mimics the other
  EXPECT_NEAR(response.time_of_impact, (0.045 - 0.028) / 0.04, 1e-3);
}

TEST_F(CheckTrajectoryTest, JointsThatAreNotNamedStayWhereTheyAreConfigured) {
  placeSquare("square", {0.52, 0.045, 1.0}, "world", /*half_side=*/0.003);
  EXPECT_EQ(check(along({}, {{}})).tool_link, "left");
  EXPECT_FALSE(check(along({"jaw"}, {{0.02}})).collision);
}

TEST_F(CheckTrajectoryTest, StandsAsTheToolPoseStands) {
  placeSquare("square", {0.0, 0.0, 0.6}, "world", /*half_side=*/0.02);
  auto request = along({"elbow"}, {{0.0}, {0.1}});
  EXPECT_FALSE(check(request).collision);
  request.tool_pose.pose.orientation.w = request.tool_pose.pose.orientation.y = std::sqrt(0.5);  // straight down
  EXPECT_TRUE(check(request).collision);
}

TEST_F(CheckTrajectoryTest, WithoutNarrowPhaseASweepThatMayCollideIsNamedByItsBegin) {
  placeSquare("square", {0.45, 0.0, 1.0}, "world", /*half_side=*/0.02);
  auto request = along({"shoulder"}, {{-1.0}, {1.0}});
  request.fine = false;
  const auto response = check(request);
  EXPECT_TRUE(response.collision);
  EXPECT_EQ(response.tool_link, "");
  EXPECT_NEAR(response.time_of_impact, 0.47, 0.05);
}

// As a planner hands it out: a joint that moves nothing of the tool, one that mimics, and a finger beyond its limit.
TEST_F(CheckTrajectoryTest, TakesThePlanOfAWholeRobotAndSaysWhatItMadeOfIt) {
  placeSquare("square", {0.15, 0.0, 0.85}, "world", /*half_side=*/0.02);
  const auto taken = [](const CheckTrajectory::Request& request, bool collision, const std::string& message) {
    const auto response = check(request);
    EXPECT_TRUE(response.success) << response.message;
    EXPECT_EQ(response.collision, collision);
    EXPECT_EQ(response.clear, !collision);
    EXPECT_EQ(response.message, message);
  };
  const std::string passed_over = "passed over, for they do not move the tool: pan";
  taken(along({"pan", "elbow"}, {{0.0, 0.0}, {9.0, 0.3}}), false, passed_over);
  taken(along({"shoulder", "pan"}, {{0.0, 0.0}, {1.0, 0.0}}), true, passed_over);
  taken(along({"jaw", "other_jaw"}, {{0.04, -0.04}, {0.01, -0.01}}), false, "");
  taken(along({"jaw", "pan"}, {{0.04003, 0.0}, {0.04, 0.0}}), false,
        "joint 'jaw' is at 0.04003 in point 0, but its limits are 0 to 0.04: swept as it is; " + passed_over);
}

TEST_F(CheckTrajectoryTest, TakesNamesAsJointStatesHasThem) {
  placeSquare("square", {0.15, 0.0, 0.85}, "world", /*half_side=*/0.02);
  EXPECT_TRUE(check(along({"outer_shoulder", "elbow"}, {{0.0, 0.0}, {1.0, -1.0}})).collision);
  EXPECT_TRUE(check(along({"shoulder", "elbow"}, {{0.0, 0.0}, {1.0, -1.0}})).collision);
  EXPECT_TRUE(has(check(along({"outer_elbow"}, {{0.0}})).message, "no joint 'outer_elbow'"));
}

TEST_F(CheckTrajectoryTest, RefusesWhatItCannotTest) {
  placeSquare("square", {0.0, 0.0, 0.0});
  const CheckTrajectory::Request good = along({"shoulder", "elbow"}, {{0.0, 0.0}, {0.1, 0.1}});
  const auto refused = [&](const std::function<void(CheckTrajectory::Request&)>& spoil, const std::string& expected) {
    CheckTrajectory::Request request = good;
    spoil(request);
    const auto response = check(request);
    EXPECT_FALSE(response.success || response.clear || response.collision);
    EXPECT_TRUE(has(response.message, expected));
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([](auto& request) { request.trajectory.points.clear(); }, "no points");
  refused([](auto& request) { request.trajectory.points.resize(1025, request.trajectory.points[0]); }, "1025 points");
  refused([](auto& request) { request.trajectory.joint_names[1] = "knee"; },
          "no joint 'knee': leave it out, or correct its name; the tool's links are moved by shoulder, elbow, jaw");
  refused([](auto& request) { request.trajectory.joint_names[1] = "shoulder"; }, "'shoulder' twice");
  refused([](auto& request) { request.trajectory.joint_names[1] = "other_jaw"; },
          "joint 'other_jaw' is at 0.1 in point 1, but 'jaw', which it mimics and is not named, puts it at -0.04");
  refused([](auto& request) { request.trajectory.points[1].positions.pop_back(); }, "point 1 has 1 positions");
  refused([](auto& request) { request.trajectory.points[1].positions[0] = 3.5; },
          "joint 'shoulder' is at 3.5 in point 1, but its limits are -3 to 3");
  refused([=](auto& request) { request.trajectory.points[1].positions[0] = nan; }, "joint 'shoulder' is at nan");
  refused([=](auto& request) { request.tool_pose.pose.position.x = nan; }, "tool_pose");
  refused([](auto& request) { request.tool_pose.header.frame_id = "nowhere"; }, "nowhere");
  refused([](auto& request) { request.mesh_ids = {"ghost"}; }, "ghost");
  refused([](auto& request) { request.margin = -1.0; }, "margin");
  EXPECT_TRUE(check(good).clear);
}

}  // namespace
}  // namespace sweep_guard_ros
