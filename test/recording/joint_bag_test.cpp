#include "recording/bag.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <std_msgs/Header.h>

#include <filesystem>
#include <vector>

#include "refusal.h"
#include "sweep_guard/common/error.h"
#include "test_file.h"

namespace sweep_guard_recording {
namespace {

class JointBagTest : public testing::Test {
 protected:
  JointBagTest() : path_(sweep_guard_core::testFile(".bag")), bag_(path_, rosbag::bagmode::Write) {}
  ~JointBagTest() override { std::filesystem::remove(path_); }

  void write(const std::string& topic, double position) {
    sensor_msgs::JointState message;
    message.name = {"elbow"};
    message.position = {position};
    bag_.write(topic, ros::Time(1000.0 + ++written_), message);
  }

  std::vector<double> read(const std::string& topic = "") {
    bag_.close();
    std::vector<double> positions;
    readJointBag(path_, topic, [&](const std::string&, const sensor_msgs::JointState& message) {
      positions.push_back(message.position.at(0));
    });
    return positions;
  }

  std::string refusal(const std::string& topic = "") {
    return ::refusal([&] { read(topic); });
  }

  std::string path_;
  rosbag::Bag bag_;
  int written_ = 0;
};

TEST_F(JointBagTest, ReadsTheOnlyTopicInTheOrderOfTheBag) {
  bag_.write("header", ros::Time(1.0), std_msgs::Header());
  write("joint_states", 0.5);
  write("joint_states", 0.25);
  EXPECT_EQ(read(), (std::vector<double>{0.5, 0.25}));
}

TEST_F(JointBagTest, ListsTheTopicsWhereThereIsAChoice) {
  write("right/joint_states", 0.5);
  write("left/joint_states", 0.5);
  EXPECT_TRUE(
      has(refusal(), "choose one topic (joints_topic:=TOPIC); there are: left/joint_states, right/joint_states"));
}

TEST_F(JointBagTest, ReadsTheTopicThatIsAskedFor) {
  write("right/joint_states", 0.5);
  write("left/joint_states", 0.25);
  EXPECT_EQ(read("left/joint_states"), std::vector<double>{0.25});
}

TEST_F(JointBagTest, RefusesABagWithoutJoints) {
  bag_.write("header", ros::Time(1.0), std_msgs::Header());
  EXPECT_TRUE(has(refusal(), path_ + ": no sensor_msgs/JointState in the bag; record one of them"));
}

TEST_F(JointBagTest, NamesTheMessageThatIsRefused) {
  write("joint_states", 0.5);
  write("joint_states", 0.25);
  bag_.close();
  const std::string text = ::refusal([&] {
    readJointBag(path_, "", [](const std::string&, const sensor_msgs::JointState& message) {
      if (message.position.at(0) < 0.5) throw sweep_guard_core::InvalidInput("too little");
    });
  });
  EXPECT_TRUE(has(text, path_ + ": joint_states, message 2: too little"));
}

}  // namespace
}  // namespace sweep_guard_recording
