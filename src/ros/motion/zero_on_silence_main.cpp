#include <ros/ros.h>

#include "common/run_program.h"
#include "ros/end_request.h"
#include "ros/motion/zero_on_silence.h"
#include "ros/output/start_failure.h"
#include "ros/process.h"
#include "sweep_guard/common/error.h"

int main(int argc, char** argv) {
  return sweep_guard_core::runProgram("zero_on_silence", [&] {
    ros::init(argc, argv, "zero_on_silence", ros::init_options::NoSigintHandler);
    sweep_guard_ros::EndRequest end;
    const ros::NodeHandle alive;  // the console is silent without a handle
    sweep_guard_ros::keepToLoopback();
    try {
      sweep_guard_ros::ZeroOnSilence node{ros::NodeHandle(), ros::NodeHandle("~")};
      node.start();
      end.await();
    } catch (const sweep_guard_core::Error& error) {
      sweep_guard_ros::reportStartFailure(ros::NodeHandle(), ros::this_node::getName(), error.what());
      return 2;
    }
    return 0;
  });
}
