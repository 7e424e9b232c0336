#include "ros/node.h"
#include "ros/process/process.h"
#include "ros/process/run_node.h"

int main(int argc, char** argv) {
  return sweep_guard_ros::runNode("sweep_guard", argc, argv, [&] {
    sweep_guard_ros::checkConfigured(ros::NodeHandle("~"), {argv + 1, argv + argc});
    auto node = std::make_shared<sweep_guard_ros::SweepGuardNode>(ros::NodeHandle(), ros::NodeHandle("~"),
                                                                  sweep_guard_ros::Process::kOwn);
    node->start();
    sweep_guard_ros::limitMemory(node->parameters().max_memory);
    return node;
  });
}
