#include <ros/ros.h>

#include "common/run_program.h"
#include "ros/black_box/black_box_node.h"
#include "ros/end_request.h"
#include "ros/output/start_failure.h"
#include "ros/parameters/parameters.h"
#include "ros/process.h"
#include "sweep_guard/common/error.h"

int main(int argc, char** argv) {
  return sweep_guard_core::runProgram("black_box_node", [&] {
    ros::init(argc, argv, "black_box", ros::init_options::NoSigintHandler);  // throws at a refused name or remapping
    sweep_guard_ros::EndRequest end;
    const ros::NodeHandle alive;  // the console is silent without a handle
    sweep_guard_ros::keepToLoopback();
    try {
      sweep_guard_ros::checkConfigured(ros::NodeHandle("~"), {argv + 1, argv + argc});
      sweep_guard_ros::BlackBoxNode node{ros::NodeHandle(), ros::NodeHandle("~"), sweep_guard_ros::Process::kOwn};
      node.start();
      end.await();
    } catch (const sweep_guard_core::Error& error) {
      sweep_guard_ros::reportStartFailure(ros::NodeHandle(), ros::this_node::getName(), error.what());
      return 2;
    }
    return 0;
  });
}
