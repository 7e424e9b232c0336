#include "ros/parameters/parameters.h"
#include "ros/process/run_node.h"
#include "ros/sound/earcon_node.h"

int main(int argc, char** argv) {
  return sweep_guard_ros::runNode("earcon", argc, argv, [&] {
    sweep_guard_ros::checkConfigured(ros::NodeHandle("~"), {argv + 1, argv + argc});
    auto node = std::make_shared<sweep_guard_ros::EarconNode>(ros::NodeHandle(), ros::NodeHandle("~"));
    node->start();
    return node;
  });
}
