// Leads two tools towards each other, each with a guard that launch/bimanual.launch has started.
#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sweep_guard/Warning.h>

#include "guard_probe.h"
#include "listener.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Warning;

class Hand {
 public:
  explicit Hand(const std::string& name)
      : publisher_(node_.advertise<geometry_msgs::PoseStamped>(name + "/tool_pose", 100)),
        warnings_(name + "/sweep_guard/warning") {}

  void moveTo(double x) { publisher_.publish(poseAt({x, 0.0, 0.0}, ros::Time::now())); }
  Warning warning() const { return warnings_.next(); }

 private:
  ros::NodeHandle node_;
  ros::Publisher publisher_;
  Listener<Warning> warnings_;
};

TEST(BimanualTest, EachGuardSeesTheToolOfTheOther) {
  ros::AsyncSpinner spinner(1);
  spinner.start();
  Hand left("/left");
  Hand right("/right");
  Listener<Warning> merged("/warning_merger/warning");
  double gap = 1.0;
  Warning of_left;
  Warning of_right;
  const auto step = [&] {
    left.moveTo(-0.5 * gap);
    right.moveTo(0.5 * gap);
    of_left = left.warning();
    of_right = right.warning();
  };
  for (int i = 0; i < 1000 && !(of_left.clear && of_right.clear); ++i) step();
  ASSERT_TRUE(of_left.clear) << of_left.text;
  ASSERT_TRUE(of_right.clear) << of_right.text;
  const auto foresees = [](const Warning& warning) {
    return warning.level == Warning::CONSIDERED || warning.level == Warning::REFLEX;
  };
  bool left_foresaw = false;
  bool right_foresaw = false;
  for (int i = 0; i < 1000 && !(of_left.contact && of_right.contact); ++i) {
    gap = std::max(0.0, gap - 0.01);
    step();
    left_foresaw = left_foresaw || foresees(of_left);
    right_foresaw = right_foresaw || foresees(of_right);
  }
  EXPECT_TRUE(left_foresaw);
  EXPECT_TRUE(right_foresaw);
  EXPECT_EQ(of_left.mesh_id, "/right/sweep_guard/tool");
  EXPECT_EQ(of_right.mesh_id, "/left/sweep_guard/tool");
  step();
  EXPECT_TRUE(merged.next().contact);
}

}  // namespace
}  // namespace sweep_guard_ros
