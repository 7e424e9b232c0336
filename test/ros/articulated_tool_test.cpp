// The arm of arm.urdf, whose joints are published or not.
#include "ros/input/articulated_tool.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "refusal.h"

namespace sweep_guard_ros {
namespace {

class ArticulatedToolTest : public testing::Test {
 protected:
  static Parameters parametersOfArm(const JointNames::Renamed& joint_names, ToolSource source) {
    std::ifstream file(SWEEP_GUARD_SOURCE_DIR "/test/ros/arm.urdf");
    ToolModelOptions options;
    options.frame = "base";
    options.links = {"upper", "fore", "left", "right"};
    Parameters parameters{};
    parameters.robot = loadToolModel({std::istreambuf_iterator<char>(file), {}}, options).robot;
    parameters.tool_source = source;
    parameters.joint_names = joint_names;
    parameters.joint_timeout = std::chrono::milliseconds(100);
    return parameters;
  }

  void make(const JointNames::Renamed& joint_names = {}, ToolSource source = ToolSource::kJointStates) {
    live_.emplace(parametersOfArm(joint_names, source));
    tool_.emplace(*live_);
  }

  static sensor_msgs::JointState at(double seconds, const std::vector<std::string>& names) {
    sensor_msgs::JointState message;
    message.header.stamp.fromSec(seconds);
    message.name = names;
    message.position.resize(names.size(), 0.0);
    return message;
  }
  void add(double seconds, const std::vector<std::string>& names) { tool_->add("/arm", at(seconds, names), {}); }
  static sweep_guard_core::SteadyTime steadyAt(double seconds) {
    return sweep_guard_core::SteadyTime() + sweep_guard_core::fromSeconds(seconds);
  }
  std::string silence(double seconds) const {
    return tool_->silence(sweep_guard_core::Time() + sweep_guard_core::fromSeconds(seconds));
  }

  std::optional<LiveParameters> live_;
  std::optional<ArticulatedTool> tool_;
};

TEST_F(ArticulatedToolTest, ListsWhichJointsAreMissing) {
  make();
  EXPECT_EQ(silence(1.0), "joints 'shoulder', 'elbow', 'jaw' have not been published yet");
  add(1.0, {"elbow"});
  EXPECT_EQ(silence(1.0), "joints 'shoulder', 'jaw' have not been published yet");
  add(1.0, {"shoulder"});
  EXPECT_EQ(silence(1.0), "joint 'jaw' has not been published yet");
  add(1.0, {"jaw"});
  EXPECT_EQ(silence(1.0), "");
  EXPECT_TRUE(has(silence(1.2), "joint 'shoulder' has been silent for 0.20 s"));
}

TEST_F(ArticulatedToolTest, ListsWhatCameInTheirPlace) {
  make();
  tool_->noteForeign(at(0.0, {"arm_arm_shoulder", "arm_arm_elbow"}));
  EXPECT_EQ(silence(1.0),
            "joints 'shoulder', 'elbow', 'jaw' have not been published yet, but joint_states has arm_arm_elbow, "
            "arm_arm_shoulder: if they are the same, set tool/joint_names");
  add(1.0, {"shoulder", "forearm", "jaw"});
  EXPECT_TRUE(has(silence(1.0), "joint 'elbow' has not been published yet, but joint_states has arm_arm_elbow, "));
  EXPECT_TRUE(has(silence(1.0), "forearm"));
  add(1.0, {"elbow"});
  EXPECT_EQ(silence(1.0), "");
  tool_->reset();
  EXPECT_EQ(silence(1.0), "joints 'shoulder', 'elbow', 'jaw' have not been published yet");
}

// A driver that publishes the finger that follows, and not the one that leads.
TEST_F(ArticulatedToolTest, AJointThatMimicsAMissingOneIsNotOfferedInItsPlace) {
  make();
  tool_->noteForeign(at(0.0, {"other_jaw"}));
  EXPECT_EQ(silence(1.0), "joints 'shoulder', 'elbow', 'jaw' have not been published yet");
  add(1.0, {"shoulder", "other_jaw", "elbow"});
  EXPECT_EQ(silence(1.0), "joint 'jaw' has not been published yet");
  tool_->noteForeign(at(1.0, {"other_jaw", "left_jaw"}));
  EXPECT_EQ(silence(1.0),
            "joint 'jaw' has not been published yet, but joint_states has left_jaw: if they are the same, set "
            "tool/joint_names");
}

TEST_F(ArticulatedToolTest, AJointIsShownWithItsNameInMessages) {
  make({{"j1", "shoulder"}, {"j2", "elbow"}});
  EXPECT_EQ(tool_->firstJointIn(at(1.0, {"shoulder", "elbow", "other_jaw"})), nullptr);
  EXPECT_EQ(silence(1.0),
            "joints 'shoulder' ('j1' in messages), 'elbow' ('j2' in messages), 'jaw' have not been published yet");
  add(1.0, {"j1", "jaw"});
  EXPECT_EQ(silence(1.0), "joint 'elbow' ('j2' in messages) has not been published yet");
}

TEST_F(ArticulatedToolTest, JointsThatTwoNodesPublishAreAConflictForOneAndAHalfSecondsAfterTheLastRefusal) {
  for (const std::string joint : {"shoulder", "elbow", "jaw"}) {
    make();
    tool_->add("/zeros", at(1.0, {"shoulder", "elbow", "jaw"}), steadyAt(0.0));
    EXPECT_EQ(tool_->conflict(steadyAt(0.0)), "");
    for (const double seconds : {0.1, 1.0}) {
      EXPECT_THROW(tool_->add("/driver", at(1.1, {joint}), steadyAt(seconds)), sweep_guard_core::SeveralPublishers);
    }
    tool_->add("/zeros", at(1.2, {"shoulder", "elbow", "jaw"}), steadyAt(1.1));
    tool_->reset();
    EXPECT_EQ(tool_->conflict(steadyAt(2.5)),
              "joint '" + joint + "' is published by /zeros and /driver: let one of them");
    EXPECT_EQ(tool_->conflict(steadyAt(2.6)), "");
  }
}

TEST_F(ArticulatedToolTest, NodesWithJointsOfTheirOwnAreNoConflict) {
  make();
  tool_->add("/arm", at(1.0, {"shoulder", "elbow"}), steadyAt(0.0));
  tool_->add("/hand", at(1.0, {"jaw"}), steadyAt(0.0));
  EXPECT_EQ(tool_->conflict(steadyAt(0.0)), "");
}

TEST_F(ArticulatedToolTest, AMissingPoseIsToldBesideMissingJoints) {
  make({}, ToolSource::kTopic);
  add(1.0, {"shoulder", "elbow"});
  EXPECT_EQ(silence(1.0), "the tool pose has not been published yet; joint 'jaw' has not been published yet");
  add(1.0, {"jaw"});
  EXPECT_EQ(silence(1.0), "the tool pose has not been published yet");
  tool_->add(sweep_guard_core::Time() + sweep_guard_core::fromSeconds(1.0), Eigen::Isometry3d::Identity());
  EXPECT_EQ(silence(1.0), "");
  EXPECT_TRUE(has(silence(1.2), "the tool pose has been silent for 0.20 s"));
}

}  // namespace
}  // namespace sweep_guard_ros
