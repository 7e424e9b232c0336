#include <chrono>
#include <memory>

#include "ros/haptics/haptics_node.h"
#include "ros/process/process.h"
#include "ros/process/run_node.h"

namespace {

constexpr auto kMaxRealTime = std::chrono::milliseconds(100);  // a cycle takes 0.03 ms

}  // namespace

int main(int argc, char** argv) {
  return sweep_guard_ros::runNode("haptics", argc, argv, [&] {
    sweep_guard_ros::checkConfigured(ros::NodeHandle("~"), {argv + 1, argv + argc});
    sweep_guard_ros::limitRealTime(kMaxRealTime);
    auto node = std::make_shared<sweep_guard_ros::HapticsNode>(ros::NodeHandle(), ros::NodeHandle("~"),
                                                               sweep_guard_ros::Process::kOwn);
    node->start();
    return node;
  });
}
