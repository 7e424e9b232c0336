#include "ros/parameters/parameters.h"
#include "ros/process/process.h"
#include "ros/process/run_node.h"
#include "ros/scene/scene_input_node.h"

int main(int argc, char** argv) {
  sweep_guard_ros::keepFreedMemory();
  return sweep_guard_ros::runNode("scene_input", argc, argv, [&] {
    sweep_guard_ros::checkConfigured(ros::NodeHandle("~"), {argv + 1, argv + argc});
    auto node = std::make_shared<sweep_guard_ros::SceneInputNode>(ros::NodeHandle(), ros::NodeHandle("~"),
                                                                  sweep_guard_ros::Process::kOwn);
    node->start();
    return node;
  });
}
