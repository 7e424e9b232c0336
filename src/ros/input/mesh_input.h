#pragma once

#include <ros/subscriber.h>

#include <string>

#include "ros/input/workpiece_store.h"
#include "sweep_guard/ros/queue_thread.h"

namespace sweep_guard_ros {

/// Takes workpieces from the topics `mesh` and `mesh_vertices` into the store. Its own thread.
class MeshInput {
 public:
  MeshInput(const ros::NodeHandle& node, WorkpieceStore& workpieces);

  void start() { thread_.start(); }

  std::string meshTopic() const { return mesh_.getTopic(); }          ///< resolved
  std::string verticesTopic() const { return vertices_.getTopic(); }  ///< resolved
  std::uint32_t meshPublishers() const { return mesh_.getNumPublishers(); }
  std::uint32_t verticesPublishers() const { return vertices_.getNumPublishers(); }

 private:
  QueueThread thread_;  // outlives what calls back on it
  ros::Subscriber mesh_;
  ros::Subscriber vertices_;
};

}  // namespace sweep_guard_ros
