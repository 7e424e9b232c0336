#pragma once

#include <memory>
#include <vector>

#include "ros/camera/camera_input.h"
#include "ros/threads/queue_thread.h"

namespace sweep_guard_ros {

/// The depth cameras of a guard, as the parameter `cameras` has them. They share the thread that receives.
class Cameras {
 public:
  Cameras(const ros::NodeHandle& node, const CameraInputDependencies& dependencies);
  ~Cameras() { thread_.stop(); }
  Cameras(const Cameras&) = delete;
  Cameras& operator=(const Cameras&) = delete;

  void start(Supervisor& supervisor);  ///< starts nothing without a camera

  const std::vector<std::unique_ptr<CameraInput>>& all() const { return all_; }

 private:
  QueueThread thread_;  // before the cameras, whose subscribers use its queue
  std::vector<std::unique_ptr<CameraInput>> all_;
};

}  // namespace sweep_guard_ros
