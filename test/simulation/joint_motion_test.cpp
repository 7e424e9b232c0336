#include "simulation/joint_motion.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/JointState.h>

#include <filesystem>

#include "refusal.h"
#include "sweep_guard/common/error.h"
#include "test_file.h"

namespace sweep_guard_simulation {
namespace {

using sweep_guard_core::KinematicTree;
using sweep_guard_core::TreeLink;

// Two joints, elbow and jaw.
KinematicTree arm() {
  std::vector<sweep_guard_core::JointVariable> variables(2);
  variables[0].name = "elbow";
  variables[1].name = "jaw";
  std::vector<TreeLink> links(2);
  for (size_t i = 0; i < 2; ++i) {
    links[i].type = sweep_guard_core::JointType::kRevolute;
    links[i].variable = i;
  }
  links[1].parent = 0;
  return {variables, links};
}

class JointMotionTest : public testing::Test {
 protected:
  JointMotionTest() : path_(sweep_guard_core::testFile(".bag")), bag_(path_, rosbag::bagmode::Write) {}
  ~JointMotionTest() override { std::filesystem::remove(path_); }

  void write(double stamp, const std::vector<std::string>& names, const std::vector<double>& positions) {
    sensor_msgs::JointState message;
    message.header.stamp = ros::Time(stamp);
    message.name = names;
    message.position = positions;
    bag_.write("joint_states", ros::Time(1000.0 + ++written_), message);
  }

  std::vector<StampedPositions> read(const std::map<std::string, double>& fixed = {},
                                     const std::map<std::string, std::string>& joint_names = {}) {
    bag_.close();
    return readJointMotion(path_, "", arm(), fixed, joint_names);
  }

  std::string path_;
  rosbag::Bag bag_;
  int written_ = 0;
};

TEST_F(JointMotionTest, BeginsWhenAllJointsAreKnownAndEndsWithTheFirstOfThem) {
  write(1.0, {"elbow"}, {0.0});
  write(1.5, {"jaw", "of_another_robot"}, {4.0, 9.0});
  write(2.0, {"elbow"}, {1.0});
  write(2.5, {"jaw"}, {6.0});
  write(3.0, {"elbow"}, {2.0});
  const std::vector<StampedPositions> motion = read();
  ASSERT_EQ(motion.size(), 3U);
  EXPECT_EQ(motion[0].stamp, sweep_guard_core::Time(std::chrono::milliseconds(1500)));
  EXPECT_EQ(motion[0].positions, (std::vector<double>{0.5, 4.0}));
  EXPECT_EQ(motion[1].positions, (std::vector<double>{1.0, 5.0}));
  EXPECT_EQ(motion[2].positions, (std::vector<double>{1.5, 6.0}));
}

TEST_F(JointMotionTest, NamesTheJointsThatTheBagDoesNotHave) {
  write(1.0, {"elbow"}, {0.0});
  const std::string text = refusal([&] { read(); });
  EXPECT_TRUE(
      has(text, path_ + ": it has no position of 'jaw', which the tool needs; record them, say where they are"));
}

TEST_F(JointMotionTest, NeedsNoPositionOfAJointThatIsHeld) {
  write(1.0, {"elbow"}, {0.5});
  EXPECT_EQ(read({{"jaw", 0.25}}).at(0).positions, (std::vector<double>{0.5, 0.25}));
}

TEST_F(JointMotionTest, JointsMayHaveOtherNamesInTheBag) {
  write(1.0, {"wheel"}, {});  // of a base, which publishes no positions
  write(1.0, {"outer_elbow", "elbow", "jaw"}, {0.5, 7.0, 0.25});
  EXPECT_EQ(read({}, {{"outer_elbow", "elbow"}}).at(0).positions, (std::vector<double>{0.5, 0.25}));
}

TEST_F(JointMotionTest, RefusesABagOfTwoRuns) {
  write(2.0, {"elbow", "jaw"}, {0.0, 0.0});
  write(1.0, {"elbow", "jaw"}, {0.0, 0.0});
  EXPECT_TRUE(has(refusal([&] { read(); }), "joint_states, message 2: joint 'elbow': its stamp is older"));
}

TEST_F(JointMotionTest, RefusesJointsThatWereNeverThereTogether) {
  write(1.0, {"elbow"}, {0.0});
  write(2.0, {"jaw"}, {0.0});
  EXPECT_TRUE(has(refusal([&] { read(); }), "its joints were never recorded at the same time"));
}

using Eigen::Vector3d;
using sweep_guard_core::ConvexPiece;
using sweep_guard_core::ConvexShape;
using sweep_guard_core::TriangleMesh;

// A slide along x that carries a slide down along z, each with a ball of 0.1 m; the tool frame is 1 m above the root.
sweep_guard_ros::RobotModel twoSlides() {
  std::vector<sweep_guard_core::JointVariable> variables(2);
  std::vector<TreeLink> links(2);
  for (size_t i = 0; i < 2; ++i) {
    variables[i].name = "slide" + std::to_string(i);
    links[i].type = sweep_guard_core::JointType::kPrismatic;
    links[i].variable = i;
  }
  links[0].axis_J = Vector3d::UnitX();
  links[1].axis_J = -Vector3d::UnitZ();
  links[1].parent = 0;
  const std::vector<ConvexPiece> ball = {{"ball", ConvexShape::sphere(0.1)}};
  const Eigen::Isometry3d X_TR(Eigen::Translation3d(0.0, 0.0, -1.0));
  return {robotOf(KinematicTree(variables, links), {{0, ball}, {1, ball}}), {0.0, 0.0}, X_TR};
}

std::vector<StampedPositions> motionOf(const std::vector<std::vector<double>>& positions) {
  std::vector<StampedPositions> motion;
  for (const auto& at : positions) motion.push_back({sweep_guard_core::Time(), at});
  return motion;
}

TEST(MeetingTest, IsTheFrontOfTheLastBodyInTheMiddleOfItsPath) {
  const Meeting meeting = halfway(twoSlides(), motionOf({{0, 0}, {0, 0.4}, {0, 0.5}, {0, 1.0}}));
  EXPECT_LT((meeting.direction_T + Vector3d::UnitZ()).norm(), 1e-9);
  EXPECT_LT((meeting.p_T - Vector3d(0.0, 0.0, -1.6)).norm(), 1e-3);
}

TEST(MeetingTest, TheMiddleIsThatOfTheLengthOfThePath) {
  const Meeting meeting = halfway(twoSlides(), motionOf({{0, 0}, {0.1, 0}, {0.2, 0}, {0.9, 0}, {1.0, 0}}));
  EXPECT_LT((meeting.direction_T - Vector3d::UnitX()).norm(), 1e-9);
  EXPECT_LT((meeting.p_T - Vector3d(1.0, 0.0, -1.0)).norm(), 1e-3);
}

TEST(MeetingTest, IsBelowAToolThatIsWhereItBegan) {
  EXPECT_EQ(halfway(twoSlides(), motionOf({{0, 0}})).direction_T, -Vector3d::UnitZ());
}

TEST(MeetingTest, TheWorkpieceIsInFrontOfTheTool) {
  const TriangleMesh mesh_W({{1, 0, 0}, {2, 1, 0}, {3, 0, 1}}, {{0, 1, 2}});
  const Meeting meeting{{0.5, 0.25, 0}, Vector3d::UnitX()};
  const Vector3d p_WT = placeToMeet(meeting, mesh_W, /*depth=*/0.125);
  EXPECT_LT((p_WT + meeting.p_T - Vector3d(1.125, 0.0, 0.0)).norm(), 1e-6);
}

}  // namespace
}  // namespace sweep_guard_simulation
