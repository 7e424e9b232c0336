#pragma once

#include <nodelet/nodelet.h>

#include <memory>

#include "ros/output/start_failure.h"
#include "ros/parameters/parameters.h"
#include "ros/threads/supervisor.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {

/// A node in the process of a nodelet manager.
template <typename Node>
class NodeletOf : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      checkConfigured(getPrivateNodeHandle(), getMyArgv());
      node_ = std::make_unique<Node>(getNodeHandle(), getPrivateNodeHandle(), Process::kShared);
      node_->start();
    } catch (const sweep_guard_core::Error& error) {
      reportStartFailure(getNodeHandle(), getName(), error.what());
      throw;
    }
  }

  std::unique_ptr<Node> node_;
};

}  // namespace sweep_guard_ros
