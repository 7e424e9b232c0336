// The names of an instrument's joints, which differ from those of its description.
#include "ros/input/joint_names.h"

#include <gtest/gtest.h>

#include "refusal.h"
#include "ros/input/foreign_joints.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::JointType;
using sweep_guard_core::JointVariable;
using sweep_guard_core::KinematicTree;
using sweep_guard_core::TreeLink;

using Found = std::vector<std::pair<size_t, double>>;

TreeLink linkOf(const std::string& joint, size_t variable, double multiplier = 1.0) {
  TreeLink link;
  link.name = "link of " + joint;
  link.joint = joint;
  link.type = JointType::kRevolute;
  link.variable = variable;
  link.multiplier = multiplier;
  return link;
}

// One jaw mimics the other, and so does a linkage that moves no link of the tool.
KinematicTree instrument() {
  std::vector<JointVariable> variables(3);
  variables[0].name = "yaw";
  variables[1].name = "pitch";
  variables[2].name = "jaw";
  return {variables,
          {linkOf("yaw", 0), linkOf("pitch", 1), linkOf("jaw", 2), linkOf("other_jaw", 2, -1.0)},
          {{"linkage", {2, 0.5, 0.1}}}};
}

sensor_msgs::JointState message(const std::vector<std::string>& names, const std::vector<double>& positions) {
  sensor_msgs::JointState message;
  message.name = names;
  message.position = positions;
  return message;
}

class JointNamesTest : public testing::Test {
 protected:
  using Fixed = std::vector<std::optional<double>>;

  static Found find(const JointNames& names, const sensor_msgs::JointState& message) {
    std::vector<sweep_guard_core::JointTimeline::Position> positions;
    names.find(message, positions);
    Found found;
    for (const auto& [variable, value] : positions) found.emplace_back(variable, value);
    return found;
  }
  std::string refused(const JointNames::Renamed& renamed) const {
    return refusal([&] { JointNames(tree_, none_, renamed); });
  }

  const KinematicTree tree_ = instrument();
  const Fixed none_ = Fixed(3);
};

TEST_F(JointNamesTest, WhatConcernsNoMovingJointIsPassedOverUnchecked) {
  const JointNames names(tree_, Fixed{{}, {}, 0.1});
  for (const auto& foreign :
       {message({"wheel_left", "wheel_right"}, {}), message({}, {}), message({"ankle"}, {std::nan("")}),
        message({"jaw"}, {}), message({"other_jaw"}, {7.0, 8.0})}) {
    EXPECT_EQ(names.firstIn(foreign), nullptr);
    EXPECT_EQ(find(names, foreign), Found());
  }
}

TEST_F(JointNamesTest, AMessageWithAJointOfTheToolNeedsAPositionForEachName) {
  const JointNames names(tree_, none_);
  EXPECT_EQ(find(names, message({"wheel", "pitch", "yaw"}, {1.0, 2.0, 3.0})), (Found{{1, 2.0}, {0, 3.0}}));
  EXPECT_EQ(*names.firstIn(message({"wheel", "pitch", "yaw"}, {})), "pitch");
  const auto refused_of = [&](const sensor_msgs::JointState& message) {
    return refusal([&] { find(names, message); });
  };
  EXPECT_EQ(refused_of(message({"wheel", "yaw"}, {})),
            "it names 2 joints, 'yaw' among them, and has 0 positions: publish one for each");
  EXPECT_TRUE(has(refused_of(message({"yaw", "wheel"}, {1.0})), "'yaw' among them, and has 1 positions"));
  EXPECT_TRUE(has(refused_of(message({"jaw"}, {1.0, 2.0})), "'jaw' among them, and has 2 positions"));
}

TEST_F(JointNamesTest, JointsHaveTheNamesThatTheyWereGiven) {
  const JointNames names(tree_, none_, {{"outer_yaw", "yaw"}, {"outer_pitch", "pitch"}});
  EXPECT_EQ(find(names, message({"outer_yaw", "yaw", "outer_pitch", "jaw"}, {1.0, 2.0, 3.0, 4.0})),
            (Found{{0, 1.0}, {1, 3.0}, {2, 4.0}}));
  EXPECT_EQ(names.inMessages(0), "outer_yaw");
  EXPECT_EQ(names.inMessages(2), "jaw");
  const JointNames swapped(tree_, none_, {{"yaw", "pitch"}, {"pitch", "yaw"}});
  EXPECT_EQ(find(swapped, message({"yaw", "pitch"}, {1.0, 2.0})), (Found{{1, 1.0}, {0, 2.0}}));
}

TEST_F(JointNamesTest, RefusesNamesThatMeanNoJointOrTwo) {
  EXPECT_TRUE(
      has(refused({{"outer_yaw", "yam"}}), "no joint 'yam' moves the tool's links: those that do are yaw, pitch, jaw"));
  EXPECT_EQ(refused({{"a", "yaw"}, {"b", "yaw"}}), "'a' and 'b' name one joint: leave one of them out");
  EXPECT_TRUE(has(refused({{"pitch", "yaw"}}), "'pitch' is the name of two joints on the topic"));
}

TEST_F(JointNamesTest, AJointThatMimicsAnotherIsRefusedByItsLeader) {
  for (const std::string follower : {"other_jaw", "linkage"}) {
    EXPECT_EQ(refused({{"left_jaw", follower}}),
              "joint '" + follower + "' mimics 'jaw' and need not be published: name 'jaw'");
    for (const std::string joint : {"jaw", "yaw"}) {
      EXPECT_EQ(refused({{follower, joint}}), "'" + follower + "' is the name of a joint that mimics 'jaw': publish '" +
                                                  joint + "' by its own name or by another one");
    }
  }
}

TEST_F(JointNamesTest, JointsThatMimicOthersOrAreFixedAreNotForeign) {
  const JointNames names(tree_, Fixed{{}, {}, 0.1}, {{"outer_yaw", "yaw"}});
  for (const std::string own : {"other_jaw", "linkage", "jaw", "pitch", "outer_yaw"}) {
    ForeignJoints foreign;
    foreign.note(names, {own, "wheel"});
    EXPECT_EQ(foreign.text({"yaw"}), "wheel") << own;
    EXPECT_TRUE(names.isOwn(own));
  }
  EXPECT_FALSE(names.isOwn("yaw"));  // it has another name
}

TEST_F(JointNamesTest, TheNameOfAFixedJointIsTaken) {
  EXPECT_TRUE(has(refusal([&] {
                    JointNames(tree_, Fixed{{}, {}, 0.1}, {{"jaw", "yaw"}});
                  }),
                  "'jaw' is the name of two joints on the topic"));
}

TEST_F(JointNamesTest, ForeignJointsAreShownWithThoseFirstThatResembleMissingOnes) {
  const JointNames names(tree_, none_);
  ForeignJoints foreign;
  EXPECT_EQ(foreign.text({"yaw"}), "");
  foreign.note(names, {"a_wheel", "arm_arm_yaw", "yaw", "b\nwheel", "arm_arm_pitch"});
  EXPECT_EQ(foreign.text({"yaw", "pitch"}), "arm_arm_pitch, arm_arm_yaw, a_wheel, b?wheel");
  std::vector<std::string> many;
  for (int i = 0; i < 1000; ++i) many.push_back("joint" + std::to_string(i));
  foreign.note(names, many);
  EXPECT_EQ(foreign.text({"yaw", "pitch"}),
            "arm_arm_pitch, arm_arm_yaw, a_wheel, b?wheel, joint0, joint1, joint10, joint11, ...");
  foreign.clear();
  EXPECT_EQ(foreign.text({}), "");
}

}  // namespace
}  // namespace sweep_guard_ros
