#pragma once

#include <ros/ros.h>

#include <string>

#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_simulation {

/// The main program of a node of the demo: makes it of its private parameters and runs it.
/// @return exit status; 2, after one line that says why, if a parameter or a file is refused or cannot be read
template <typename Node>
int runNode(int argc, char** argv, const std::string& name) {
  ros::init(argc, argv, name);
  sweep_guard_ros::ParameterReader parameters{
      ros::NodeHandle("~")};  // outlives the node: without a handle the console is silent
  try {
    ros::Time::waitForValid();
    Node node(parameters);
    parameters.warnOfUnread();
    node.run();
  } catch (const sweep_guard_core::Error& error) {
    ROS_FATAL("%s", error.what());
    return 2;
  }
  return 0;
}

}  // namespace sweep_guard_simulation
