#pragma once

#include <ros/service_server.h>
#include <sweep_guard/Attach.h>

#include <functional>
#include <future>
#include <memory>
#include <string>

#include "ros/service/limited_calls.h"
#include "ros/service/service_dependencies.h"
#include "ros/service/service_threads.h"
#include "sweep_guard/guard/pose_with_frames.h"

namespace sweep_guard_ros {

/// Serves `~attach`: makes a workpiece that the tool holds part of the tool, or gives it back. Five calls are let in; any
/// more are answered BUSY.
class AttachService {
 public:
  /// See GuardThread::newestPose().
  using NewestPose = std::function<std::future<sweep_guard_core::PoseWithFrames>()>;
  /// See GuardThread::exchangeTool().
  using ExchangeTool =
      std::function<void(const std::shared_ptr<const Parameters>& before, const std::shared_ptr<const Parameters>& next,
                         const std::function<void()>& change_store)>;

  AttachService(const ros::NodeHandle& private_node, ServiceThreads& threads, const ServiceDependencies& dependencies,
                NewestPose newest_pose, ExchangeTool exchange_tool);

 private:
  using Event = ros::ServiceEvent<sweep_guard::Attach::Request, sweep_guard::Attach::Response>;

  bool onCall(Event& event);
  std::string attach(const std::string& id, const std::string& link);
  std::string detach(const std::string& id);
  std::shared_ptr<const sweep_guard_core::Workpiece> workpieceOf(const std::string& id) const;
  sweep_guard_core::PoseWithFrames newestPose() const;
  Eigen::Isometry3d lookup(const std::string& frame, sweep_guard_core::Time stamp) const;
  void require(const Parameters& next) const;

  const ServiceDependencies dependencies_;
  const NewestPose newest_pose_;
  const ExchangeTool exchange_tool_;
  LimitedCalls calls_;  // before the server, which uses it
  ros::ServiceServer server_;
};

}  // namespace sweep_guard_ros
