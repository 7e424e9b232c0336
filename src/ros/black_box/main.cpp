#include "ros/black_box/black_box_node.h"
#include "ros/parameters/parameters.h"
#include "ros/process/process.h"
#include "ros/process/run_node.h"

// For a recording. roslaunch gives its nodes 15 s.
constexpr auto kTimeToWrite = std::chrono::seconds(10);

int main(int argc, char** argv) {
  sweep_guard_ros::setNice(5);  // where processors are scarce, the guard has more of them
  const auto start = [&] {
    sweep_guard_ros::checkConfigured(ros::NodeHandle("~"), {argv + 1, argv + argc});
    auto node = std::make_shared<sweep_guard_ros::BlackBoxNode>(ros::NodeHandle(), ros::NodeHandle("~"),
                                                                sweep_guard_ros::Process::kOwn);
    node->start();
    return node;
  };
  return sweep_guard_ros::runNode("black_box", argc, argv, start, kTimeToWrite);
}
