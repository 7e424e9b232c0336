#include "ros/motion/zero_on_silence.h"
#include "ros/process/run_node.h"

int main(int argc, char** argv) {
  return sweep_guard_ros::runNode("zero_on_silence", argc, argv, [] {
    auto node = std::make_shared<sweep_guard_ros::ZeroOnSilence>(ros::NodeHandle(), ros::NodeHandle("~"));
    node->start();
    return node;
  });
}
