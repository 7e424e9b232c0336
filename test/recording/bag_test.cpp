#include "recording/bag.h"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <std_msgs/Header.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <vector>

#include "recording/recording.h"
#include "refusal.h"
#include "sweep_guard/common/error.h"
#include "test_file.h"

namespace sweep_guard_recording {
namespace {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::StampedPose;

class BagTest : public testing::Test {
 protected:
  BagTest() : path_(sweep_guard_core::testFile(".bag")), bag_(path_, rosbag::bagmode::Write) {}
  ~BagTest() override { std::filesystem::remove(path_); }

  static geometry_msgs::PoseStamped pose(double stamp, double x) {
    geometry_msgs::PoseStamped message;
    message.header.stamp = ros::Time(stamp);
    message.pose.position.x = x;
    message.pose.orientation.z = 0.6;
    message.pose.orientation.w = 0.8;
    return message;
  }

  static geometry_msgs::TransformStamped transform(double stamp, double x, const std::string& child = "tool") {
    geometry_msgs::TransformStamped message;
    message.header.stamp = ros::Time(stamp);
    message.child_frame_id = child;
    message.transform.translation.x = x;
    message.transform.rotation.w = 1.0;
    return message;
  }

  template <typename Message>
  void write(const std::string& topic, const Message& message) {
    bag_.write(topic, ros::Time(1000.0 + ++written_), message);  // received in this order, whatever the stamps
  }

  std::vector<StampedPose> read(const std::string& topic = "") {
    bag_.close();
    return readBag(path_, topic);
  }

  std::string refusal(const std::string& topic = "") {
    return ::refusal([&] { read(topic); });
  }

  std::string path_;
  rosbag::Bag bag_;
  int written_ = 0;
};

TEST_F(BagTest, IsReadLikeTheMotionFileOfTheSamePoses) {
  std::ofstream text(path_ + ".txt");
  for (int i = 0; i < 100; ++i) {
    write("tool_pose", pose(12.5 + 0.01 * i, 0.125 * i));
    text << 12.5 + 0.01 * i << ' ' << 0.125 * i << " 0 0 0 0 0.6 0.8\n";
  }
  bag_.close();
  text.close();
  const Recording from_bag = readRecording(path_, "");
  const Recording from_text = readRecording(path_ + ".txt", "");
  std::filesystem::remove(path_ + ".txt");

  EXPECT_EQ(from_bag.name, "BagTest_IsReadLikeTheMotionFileOfTheSamePoses");
  ASSERT_EQ(from_bag.poses.size(), 100U);
  ASSERT_EQ(from_text.poses.size(), 100U);
  for (size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(from_bag.poses[i].stamp, from_text.poses[i].stamp);
    EXPECT_TRUE(from_bag.poses[i].X_WT.isApprox(from_text.poses[i].X_WT, 1e-15));
  }
}

TEST_F(BagTest, ReadsTransforms) {
  write("wrist", transform(3.0, 0.5));
  const std::vector<StampedPose> poses = read();
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_EQ(poses[0].stamp, sweep_guard_core::Time(std::chrono::seconds(3)));
  EXPECT_EQ(poses[0].X_WT.translation(), Eigen::Vector3d(0.5, 0.0, 0.0));
}

TEST_F(BagTest, TakesTheOnlyTopicOfPosesAmongOthers) {
  write("header", std_msgs::Header());
  write("tool_pose", pose(1.0, 0.5));
  EXPECT_EQ(read().size(), 1U);
}

TEST_F(BagTest, ListsTheTopicsWhereThereIsAChoice) {
  write("right", pose(1.0, 0.5));
  write("left", transform(1.0, 0.5));
  EXPECT_TRUE(has(refusal(), "motion_topic:=TOPIC, or --topic of evaluate_prediction); there are: left, right"));
}

TEST_F(BagTest, ReadsTheTopicThatIsAskedFor) {
  write("right", pose(1.0, 0.5));
  write("left", transform(1.0, 0.25));
  EXPECT_EQ(read("left").at(0).X_WT.translation().x(), 0.25);
}

TEST_F(BagTest, SaysWhichTopicsThereAreInsteadOfTheOneAskedFor) {
  write("right", pose(1.0, 0.5));
  EXPECT_TRUE(has(refusal("middle"), "on middle; there are: right"));
}

TEST_F(BagTest, RefusesABagWithoutPoses) {
  write("header", std_msgs::Header());
  EXPECT_TRUE(has(refusal(), "no PoseStamped or TransformStamped in the bag"));
  EXPECT_TRUE(has(refusal("tool_pose"), "no PoseStamped or TransformStamped in the bag"));
}

TEST_F(BagTest, NamesTheMessageThatItRefuses) {
  write("tool_pose", pose(1.0, 0.5));
  write("tool_pose", pose(2.0, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_TRUE(has(refusal(), "tool_pose, message 2: position is NaN"));
}

TEST_F(BagTest, RefusesAStampThatGoesBack) {
  write("tool_pose", pose(2.0, 0.5));
  write("tool_pose", pose(1.0, 0.5));
  EXPECT_TRUE(has(refusal(), "message 2: stamp is earlier"));
}

TEST_F(BagTest, RefusesFramesThatChange) {
  write("vicon", transform(1.0, 0.5, "tool"));
  write("vicon", transform(2.0, 0.5, "camera"));
  EXPECT_TRUE(has(refusal(), "frame is 'camera' in '', was 'tool' in '' before"));
}

TEST_F(BagTest, RefusesABagThatIsCutOff) {
  for (int i = 0; i < 1000; ++i) write("tool_pose", pose(1.0 + i, 0.5));
  bag_.close();
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 2);
  ASSERT_TRUE(isBag(path_));
  const std::string message = refusal();
  EXPECT_EQ(message.find(path_ + ": the bag "), 0U) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST(IsBagTest, IsFalseForWhatIsNone) {
  EXPECT_FALSE(isBag("/dev/zero"));
  EXPECT_FALSE(isBag(testing::TempDir()));
  EXPECT_FALSE(isBag("/nowhere"));
  const std::string loop = testing::TempDir() + "is_bag_test_loop";
  std::filesystem::create_symlink(loop, loop);
  EXPECT_FALSE(isBag(loop));
  std::filesystem::remove(loop);
}

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
