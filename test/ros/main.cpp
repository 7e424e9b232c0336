#include <gtest/gtest.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "sweep_guard_test");
  const ros::NodeHandle alive;
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
