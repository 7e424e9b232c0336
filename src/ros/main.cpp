#include <ros/ros.h>

#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/node.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "sweep_guard");
  try {
    const sweep_guard_ros::SweepGuardNode node{ros::NodeHandle(), ros::NodeHandle("~")};
    ros::waitForShutdown();
  } catch (const sweep_guard::Error& error) {
    ROS_FATAL("%s", error.what());
    return 2;
  }
  return 0;
}
