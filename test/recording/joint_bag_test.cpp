#include "recording/joint_bag.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/JointState.h>

#include <filesystem>
#include <limits>

#include "refusal.h"
#include "test_file.h"

namespace sweep_guard_recording {
namespace {

class JointBagTest : public testing::Test {
 protected:
  JointBagTest() : path_(sweep_guard_core::testFile(".bag")), bag_(path_, rosbag::bagmode::Write) {}
  ~JointBagTest() override { std::filesystem::remove(path_); }

  void write(const std::string& topic, double stamp, const std::vector<std::string>& names,
             const std::vector<double>& positions) {
    sensor_msgs::JointState message;
    message.header.stamp = ros::Time(stamp);
    message.name = names;
    message.position = positions;
    bag_.write(topic, ros::Time(1000.0 + ++written_), message);
  }

  std::vector<RecordedJoints> read(const std::string& topic = "") {
    bag_.close();
    return readJointBag(path_, topic, {"shoulder", "elbow"});
  }

  const std::string path_;
  rosbag::Bag bag_;
  int written_ = 0;
};

TEST_F(JointBagTest, GivesThePositionsInTheOrderAskedFor) {
  write("/joints", 10.0, {"elbow", "gripper", "shoulder"}, {0.2, 9.0, 0.1});
  write("/joints", 10.5, {"elbow", "gripper", "shoulder"}, {0.4, 9.0, 0.3});
  const std::vector<RecordedJoints> states = read();
  ASSERT_EQ(states.size(), 2U);
  EXPECT_EQ(states[0].positions, (std::vector<double>{0.1, 0.2}));
  EXPECT_EQ(states[1].positions, (std::vector<double>{0.3, 0.4}));
  EXPECT_EQ(states[1].stamp - states[0].stamp, std::chrono::milliseconds(500));
}

TEST_F(JointBagTest, LeavesOutMessagesThatLackAJointOrAreNotLater) {
  write("/joints", 10.0, {"shoulder", "elbow"}, {0.1, 0.2});
  write("/gripper", 10.1, {"gripper"}, {9.0});
  write("/joints", 10.2, {"shoulder", "elbow"}, {0.1});
  write("/joints", 10.0, {"shoulder", "elbow"}, {0.5, 0.6});
  write("/other", 10.3, {"shoulder", "elbow"}, {0.7, 0.8});
  EXPECT_EQ(read("/joints").size(), 1U);
}

TEST_F(JointBagTest, RefusesABagWithoutTheJointsAndPositionsThatAreNotFinite) {
  write("/joints", 10.0, {"shoulder"}, {0.1});
  EXPECT_NE(::refusal([&] { read(); }).find("has all joints"), std::string::npos);
  bag_.open(path_, rosbag::bagmode::Write);
  write("/joints", 10.0, {"shoulder", "elbow"}, {0.1, std::numeric_limits<double>::quiet_NaN()});
  EXPECT_NE(::refusal([&] { read(); }).find("'elbow' is not finite"), std::string::npos);
}

}  // namespace
}  // namespace sweep_guard_recording
