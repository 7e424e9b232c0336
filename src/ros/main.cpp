#include <ros/ros.h>

#include "common/run_program.h"
#include "ros/node.h"
#include "ros/process.h"
#include "sweep_guard/common/error.h"

int main(int argc, char** argv) {
  return sweep_guard_core::runProgram("sweep_guard_node", [&] {
    ros::init(argc, argv, "sweep_guard");  // throws at a refused name or remapping
    const ros::NodeHandle alive;           // the console is silent without a handle
    try {
      const sweep_guard_ros::SweepGuardNode node{ros::NodeHandle(), ros::NodeHandle("~"),
                                                 sweep_guard_ros::Process::kOwn};
      sweep_guard_ros::limitMemory(node.parameters().max_memory);
      ros::waitForShutdown();
    } catch (const sweep_guard_core::Error& error) {
      ROS_FATAL("%s", error.what());
      return 2;
    }
    return 0;
  });
}
