// Plans of a whole robot: a torso carries the frame of the tool and a head; of the tool are a wrist and two fingers, the
// second of which mimics the first, as a linkage does that moves no link of the tool.
#include "sweep_guard/kinematics/joint_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "refusal.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

using Points = std::vector<std::vector<double>>;

const double kNan = std::numeric_limits<double>::quiet_NaN();

TreeLink jointLink(const std::string& joint, size_t parent, JointType type, size_t variable) {
  TreeLink link;
  link.name = "link of " + joint;
  link.joint = joint;
  link.parent = parent;
  link.type = type;
  link.variable = variable;
  return link;
}

KinematicTree handTree() {
  TreeLink right = jointLink("finger2", 0, JointType::kPrismatic, 1);
  right.multiplier = -2.0;
  right.offset = 0.01;
  return {{{"wrist", -2.9, 2.9}, {"finger1", 0.0, 0.04}, {"drill", -1e4, 1e4, /*continuous=*/true}},
          {jointLink("wrist", TreeLink::kRoot, JointType::kRevolute, 0),
           jointLink("finger1", 0, JointType::kPrismatic, 1), right, jointLink("drill", 0, JointType::kRevolute, 2)},
          {{"linkage", {1, 0.5, 0.0}}}};
}

class JointPlanTest : public testing::Test {
 protected:
  PlannedPositions read(const std::vector<std::string>& joints, const Points& points) const {
    return planned(tree_, beside_, {0.5, 0.02, 0.0}, {joints, points});
  }
  std::string refused(const std::vector<std::string>& joints, const Points& points) const {
    return refusal([&] { read(joints, points); });
  }

  const KinematicTree tree_ = handTree();
  const JointsBesideTree beside_ = {{"torso", "crank"}, {"head", "wheel", "camera_mount"}};
};

TEST_F(JointPlanTest, JointsThatAreNotNamedStay) {
  const PlannedPositions plan = read({"wrist"}, {{0.0}, {1.0}});
  EXPECT_EQ(plan.positions, (Points{{0.0, 0.02, 0.0}, {1.0, 0.02, 0.0}}));
  EXPECT_EQ(plan.remarks, "");
  EXPECT_EQ(read({"finger1", "wrist"}, {{0.03, -1.0}}).positions, (Points{{-1.0, 0.03, 0.0}}));
  EXPECT_EQ(read({}, {{}, {}}).positions, (Points{{0.5, 0.02, 0.0}, {0.5, 0.02, 0.0}}));
}

TEST_F(JointPlanTest, JointsThatMoveNothingOfTheToolArePassedOverAndListed) {
  const PlannedPositions plan =
      read({"head", "wrist", "wheel", "camera_mount"}, {{0.1, 0.0, 7.0, kNan}, {0.2, 1.0, 9.0, 0.0}});
  EXPECT_EQ(plan.positions, (Points{{0.0, 0.02, 0.0}, {1.0, 0.02, 0.0}}));
  EXPECT_EQ(plan.remarks, "passed over, for they do not move the tool: head, wheel, camera_mount");
}

TEST_F(JointPlanTest, APlanWithoutAJointOfTheToolIsRefused) {
  const std::vector<std::vector<std::string>> plans = {{"head"}, {"wheel", "head"}, {"camera_mount"}};
  for (const auto& joints : plans) {
    EXPECT_EQ(refused(joints, {std::vector<double>(joints.size(), 0.1)}),
              "joint_names has no joint of the tool, which would be tested at rest: the tool's links are moved by "
              "wrist, finger1, drill");
  }
}

TEST_F(JointPlanTest, WhatMovesTheFrameMayBeNamedAsLongAsItStays) {
  EXPECT_TRUE(
      has(read({"torso", "wrist"}, {{0.3, 0.0}, {0.3, 1.0}}).remarks, "torso (it moves tool_frame, and stays)"));
  EXPECT_TRUE(has(read({"crank"}, {{0.3}, {0.3 + 1e-7}}).remarks, "crank (it moves tool_frame, and stays)"));
  EXPECT_TRUE(has(refused({"torso", "wrist"}, {{0.0, 0.0}, {0.2, 1.0}}),
                  "joint 'torso' is at 0.2 in point 1, and at 0 before, but it moves tool_frame"));
  EXPECT_TRUE(has(refused({"crank"}, {{0.0}, {1e-5}, {0.0}}), "joint 'crank' is at 1e-05 in point 1"));
  EXPECT_TRUE(has(refused({"torso"}, {{kNan}}), "joint 'torso' is at nan in point 0"));
}

TEST_F(JointPlanTest, AJointOfTheToolThatMovesTheFrameTooHasToStay) {
  const JointsBesideTree beside = {{"wrist"}, {}};
  const auto plan = [&](double end) { return planned(tree_, beside, {0.0, 0.0, 0.0}, {{"wrist"}, {{1.0}, {end}}}); };
  EXPECT_EQ(plan(1.0).positions[1][0], 1.0);
  EXPECT_EQ(plan(1.0).remarks, "");
  EXPECT_TRUE(has(refusal([&] { plan(1.1); }), "it moves tool_frame"));
}

TEST_F(JointPlanTest, FollowersThatAgreeAreTaken) {
  EXPECT_EQ(read({"finger1", "finger2"}, {{0.02, -0.03}, {0.0, 0.01}}).remarks, "");
  EXPECT_EQ(read({"finger2"}, {{-0.03}}).remarks, "");  // finger1 stays at 0.02
  const PlannedPositions noisy = read({"finger2", "finger1"}, {{-0.03002, 0.02}});
  EXPECT_EQ(noisy.positions, (Points{{0.5, 0.02, 0.0}}));
  EXPECT_EQ(noisy.remarks,
            "joint 'finger2' is at -0.03002 in point 0, but 'finger1', which it mimics, puts it at -0.03: swept there");
}

TEST_F(JointPlanTest, FollowersThatDoNotAgreeAreRefusedByTheirLeader) {
  EXPECT_EQ(refused({"finger1", "finger2"}, {{0.02, -0.03}, {0.04, -0.03}}),
            "joint 'finger2' is at -0.03 in point 1, but 'finger1', which it mimics, puts it at -0.07");
  EXPECT_EQ(refused({"finger2"}, {{0.0}}),
            "joint 'finger2' is at 0 in point 0, but 'finger1', which it mimics and is not named, puts it at -0.03");
  EXPECT_TRUE(has(refused({"finger2"}, {{kNan}}), "joint 'finger2' is at nan"));
}

// What it mimics moves with it.
TEST_F(JointPlanTest, AFollowerThatMovesNoLinkHasToAgreeToo) {
  EXPECT_EQ(read({"finger1", "linkage"}, {{0.02, 0.01}, {0.04, 0.02}}).remarks, "");
  EXPECT_EQ(read({"linkage"}, {{0.01}}).remarks, "");  // finger1 stays at 0.02
  EXPECT_TRUE(has(read({"finger1", "linkage"}, {{0.02, 0.01001}}).remarks, "puts it at 0.01: swept there"));
  EXPECT_EQ(refused({"finger1", "linkage"}, {{0.02, 0.01}, {0.02, 0.02}}),
            "joint 'linkage' is at 0.02 in point 1, but 'finger1', which it mimics, puts it at 0.01");
  EXPECT_TRUE(has(refused({"linkage"}, {{0.0}}), "'finger1', which it mimics and is not named, puts it at 0.01"));
}

// By a thousandth of the joint's range.
TEST_F(JointPlanTest, PositionsALittleBeyondALimitAreTakenAsTheyAreAndSaid) {
  const PlannedPositions plan = read({"wrist", "finger1"}, {{0.0, 0.04003}, {2.905, -1e-6}});
  EXPECT_EQ(plan.positions, (Points{{0.0, 0.04003, 0.0}, {2.905, -1e-6, 0.0}}));
  EXPECT_EQ(plan.remarks,
            "joint 'wrist' is at 2.905 in point 1, but its limits are -2.9 to 2.9: swept as it is; "
            "joint 'finger1' is at 0.04003 in point 0, but its limits are 0 to 0.04: swept as it is");
  EXPECT_TRUE(has(read({"finger1"}, {{0.0400000001}}).remarks, "joint 'finger1' is at 0.0400000001 in point 0"));
}

TEST_F(JointPlanTest, PositionsFarBeyondALimitAreRefusedWithValueAndLimit) {
  EXPECT_EQ(refused({"wrist"}, {{0.0}, {3.5}}), "joint 'wrist' is at 3.5 in point 1, but its limits are -2.9 to 2.9");
  EXPECT_EQ(refused({"finger1"}, {{-4.1e-5}}),
            "joint 'finger1' is at -4.1e-05 in point 0, but its limits are 0 to 0.04");
  EXPECT_TRUE(has(refused({"wrist"}, {{kNan}}), "joint 'wrist' is at nan in point 0"));
  EXPECT_TRUE(has(refused({"drill"}, {{10001.0}}), "joint 'drill' is at 10001 in point 0"));
}

TEST_F(JointPlanTest, PointsWithoutOnePositionEachAreRefused) {
  EXPECT_EQ(refused({"wrist", "head"}, {{0.0, 0.0}, {0.0}}), "point 1 has 1 positions, but joint_names has 2 joints");
  EXPECT_EQ(
      refused({"wrist"}, {{}, {}, {}}),
      "point 0 has 0 positions (velocities alone cannot be swept), but joint_names has 1 joints; so do 2 other points");
  EXPECT_EQ(refused({}, {{1.0}}), "point 0 has 1 positions, but joint_names has 0 joints");
}

TEST_F(JointPlanTest, AllObjectionsAreInOneAnswer) {
  const std::string message = refused({"sholder", "wrist", "knee", "finger1", "torso", "finger2", "wrist"},
                                      {{0.0, 3.5, 0.0, 0.5, 0.0, 0.0, 3.5}, {0.0, 3.5, 0.0, 0.5, 1.0, 0.0, 3.5}, {}});
  for (const char* const part :
       {"joint_names has 'wrist' twice",
        ("the robot description has no joint 'sholder', 'knee': leave it out, or correct its name; "
         "the tool's links are moved by wrist, finger1, drill"),
        "point 2 has 0 positions", "joint 'wrist' is at 3.5", "joint 'finger1' is at 0.5 in point 0",
        "joint 'torso' is at 1", "joint 'finger2' is at 0 in point 0"}) {
    EXPECT_TRUE(has(message, part));
  }
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST_F(JointPlanTest, ALongListOfNamesIsCut) {
  const std::vector<std::string> names = [] {
    std::vector<std::string> many;
    for (int i = 0; i < 5000; ++i) many.push_back("no joint " + std::to_string(i) + '\n');
    return many;
  }();
  const std::string message = refused(names, {std::vector<double>(5000, 0.0)});
  EXPECT_TRUE(has(message, "and 4980 more"));
  EXPECT_LT(message.size(), 1000U);
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST_F(JointPlanTest, KnowsWhichJointsThereAre) {
  for (const char* const joint : {"wrist", "finger2", "linkage", "torso", "head"})
    EXPECT_TRUE(hasJoint(tree_, beside_, joint)) << joint;
  EXPECT_FALSE(hasJoint(tree_, beside_, "sholder"));
}

}  // namespace
}  // namespace sweep_guard_core
