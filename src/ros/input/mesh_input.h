#pragma once

#include <ros/subscriber.h>
#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/MeshVertices.h>

#include <string>

#include "guard/workpiece_store.h"
#include "monitor/input_record.h"
#include "ros/log_throttle.h"
#include "sweep_guard/monitor/warning_monitor.h"
#include "sweep_guard/ros/queue_thread.h"

namespace sweep_guard_ros {

/// Converts the messages on the topics `mesh` and `mesh_vertices`, and puts them into the store. Reports every accepted
/// and every refused message to the monitor. Has its own thread.
class MeshInput {
 public:
  MeshInput(const ros::NodeHandle& node, size_t max_triangles, sweep_guard_core::WorkpieceStore& workpieces,
            sweep_guard_core::WarningMonitor& monitor);

  void start() { thread_.start(); }

  std::string meshTopic() const { return mesh_.getTopic(); }          ///< resolved
  std::string verticesTopic() const { return vertices_.getTopic(); }  ///< resolved
  std::uint32_t meshPublishers() const { return mesh_.getNumPublishers(); }
  std::uint32_t verticesPublishers() const { return vertices_.getNumPublishers(); }
  const sweep_guard_core::InputRecord& meshRecord() const { return mesh_record_; }
  const sweep_guard_core::InputRecord& verticesRecord() const { return vertices_record_; }

 private:
  template <typename Msg>
  ros::Subscriber subscribe(ros::NodeHandle node, const std::string& topic);
  void onMessage(const sweep_guard::DeformableMesh& msg);
  void onMessage(const sweep_guard::MeshVertices& msg);
  template <typename Msg>
  std::string refusalOf(const Msg& msg, sweep_guard_core::InputRecord& record);
  void store(const sweep_guard::DeformableMesh& msg);
  void store(const sweep_guard::MeshVertices& msg);

  const size_t max_triangles_;
  sweep_guard_core::WorkpieceStore& workpieces_;
  sweep_guard_core::WarningMonitor& monitor_;
  LogThrottle log_;
  sweep_guard_core::InputRecord mesh_record_;
  sweep_guard_core::InputRecord vertices_record_;
  QueueThread thread_;  // before the subscribers, which use its queue
  ros::Subscriber mesh_;
  ros::Subscriber vertices_;
};

}  // namespace sweep_guard_ros
