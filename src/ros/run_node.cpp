#include "ros/run_node.h"

#include <ros/ros.h>

#include "common/run_program.h"
#include "ros/end_request.h"
#include "ros/output/start_failure.h"
#include "ros/process.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {

int runNode(const char* name, int argc, char** argv, const std::function<std::shared_ptr<void>()>& start,
            std::chrono::milliseconds time_to_end) {
  return sweep_guard_core::runProgram(name, [&] {
    shareHeaps();
    ros::init(argc, argv, name, ros::init_options::NoSigintHandler);  // throws at a refused name or remapping
    EndRequest end(time_to_end);
    const ros::NodeHandle alive;  // the console is silent without a handle
    keepToLoopback();
    try {
      const std::shared_ptr<void> node = start();
      end.await();
    } catch (const sweep_guard_core::Error& error) {
      reportStartFailure(ros::NodeHandle(), ros::this_node::getName(), error.what());
      return 2;
    }
    return 0;
  });
}

}  // namespace sweep_guard_ros
