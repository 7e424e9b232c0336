#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

#include "ros/node.h"
#include "ros/output/start_failure.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {

class SweepGuardNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      checkConfigured(getPrivateNodeHandle(), getMyArgv());
      node_ = std::make_unique<SweepGuardNode>(getNodeHandle(), getPrivateNodeHandle(), Process::kShared);
      node_->start();
    } catch (const sweep_guard_core::Error& error) {
      reportStartFailure(getNodeHandle(), getName(), error.what());
      throw;
    }
  }

  std::unique_ptr<SweepGuardNode> node_;
};

}  // namespace sweep_guard_ros

PLUGINLIB_EXPORT_CLASS(sweep_guard_ros::SweepGuardNodelet, nodelet::Nodelet)
