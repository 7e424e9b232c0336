#include "ros/haptics/haptics_node.h"
#include "ros/run_node.h"

int main(int argc, char** argv) {
  return sweep_guard_ros::runNode("haptics", argc, argv, [&] {
    sweep_guard_ros::checkConfigured(ros::NodeHandle("~"), {argv + 1, argv + argc});
    auto node = std::make_shared<sweep_guard_ros::HapticsNode>(ros::NodeHandle(), ros::NodeHandle("~"),
                                                               sweep_guard_ros::Process::kOwn);
    node->start();
    return node;
  });
}
