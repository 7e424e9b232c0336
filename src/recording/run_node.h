#pragma once

#include <ros/ros.h>

#include <string>

#include "ros/process/process.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_recording {

/// Runs a program: constructs a Node from its private parameters and calls its run().
/// @return exit status; 2, with one line in the log, if a parameter or a file is refused or cannot be read
template <typename Node>
int runNode(int argc, char** argv, const std::string& name) {
  sweep_guard_ros::logInUtf8();
  ros::init(argc, argv, name);
  sweep_guard_ros::ParameterReader parameters{
      ros::NodeHandle("~")};  // outlives the node: without a handle the console is silent
  sweep_guard_ros::keepToLoopback();
  try {
    Node node(parameters);
    parameters.warnOfUnread();
    node.run();
  } catch (const sweep_guard_core::Error& error) {
    ROS_FATAL("%s", error.what());
    return 2;
  }
  return 0;
}

}  // namespace sweep_guard_recording
