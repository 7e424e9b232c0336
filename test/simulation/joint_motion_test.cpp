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

  std::vector<StampedPositions> read(const std::map<std::string, double>& fixed = {}) {
    bag_.close();
    return readJointMotion(path_, "", arm(), fixed);
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

}  // namespace
}  // namespace sweep_guard_simulation
