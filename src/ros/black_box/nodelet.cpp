#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

#include "ros/black_box/black_box_node.h"
#include "ros/output/start_failure.h"
#include "ros/parameters/parameters.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {

class BlackBoxNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      checkConfigured(getPrivateNodeHandle(), getMyArgv());
      node_ = std::make_unique<BlackBoxNode>(getNodeHandle(), getPrivateNodeHandle(), Process::kShared);
      node_->start();
    } catch (const sweep_guard_core::Error& error) {
      reportStartFailure(getNodeHandle(), getName(), error.what());
      throw;
    }
  }

  std::unique_ptr<BlackBoxNode> node_;
};

}  // namespace sweep_guard_ros

PLUGINLIB_EXPORT_CLASS(sweep_guard_ros::BlackBoxNodelet, nodelet::Nodelet)
