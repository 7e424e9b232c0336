#pragma once

#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/MeshVertices.h>

#include <atomic>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "common/guarded_by.h"
#include "guard/workpiece_store.h"
#include "monitor/input_record.h"
#include "ros/connection/bounded.h"
#include "ros/input/worker.h"
#include "ros/parameters/parameters.h"
#include "ros/process/log_throttle.h"
#include "ros/threads/queue_thread.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// Converts the messages on the topics `mesh` and `mesh_vertices`, and puts them into the store. Reports every accepted
/// and every refused message to the monitor. One thread receives, one converts meshes, and one stores, so that neither a
/// large mesh nor a slow update delays another workpiece's vertices on their way in; the one that stores also converts what
/// came too early. Vertices do not overtake a mesh of their own workpiece.
class MeshInput {
 public:
  MeshInput(const ros::NodeHandle& node, const Parameters& parameters, sweep_guard_core::WorkpieceStore& workpieces,
            sweep_guard_core::WarningMonitor& monitor);

  void start(Supervisor& supervisor);

  /// Takes each mesh that came too early once simulated time has reached its stamp. To be called now and then. Any thread
  void takeEarly();

  /// Runs a job in the thread that changes the store of the workpieces.
  void changeStore(const Worker::Job& job) { storing_.push(job); }

  std::string meshTopic() const { return mesh_.getTopic(); }          ///< resolved
  std::string verticesTopic() const { return vertices_.getTopic(); }  ///< resolved
  std::uint32_t meshPublishers() const { return mesh_.getNumPublishers(); }
  std::uint32_t verticesPublishers() const { return vertices_.getNumPublishers(); }
  const sweep_guard_core::InputRecord& meshRecord() const { return mesh_record_; }
  const sweep_guard_core::InputRecord& verticesRecord() const { return vertices_record_; }
  /// Returns ids that came and are none of mesh_ids: the first hundred.
  std::set<std::string> passedOver() const {
    const sweep_guard_core::Lock lock(passed_over_mutex_);
    return passed_over_;
  }
  std::uint64_t droppedUpdates() const { return dropped_; }  ///< messages on both topics, since the start

 private:
  struct EarlyMesh {
    sweep_guard::DeformableMesh::ConstPtr msg;
    sweep_guard_core::SteadyTime received;
  };

  template <typename Msg>
  BoundedSubscriber subscribe(ros::NodeHandle node, const std::string& topic, size_t max_size,
                              sweep_guard_core::InputRecord& record);
  void onMessage(const sweep_guard::DeformableMesh::ConstPtr& msg);
  void onMessage(const sweep_guard::MeshVertices::ConstPtr& msg);
  void passOver(const std::string& id);
  bool readable(const std::string& id, const std_msgs::Header& header, sweep_guard_core::InputRecord& record);
  void unread(const std::string& reason, sweep_guard_core::InputRecord& record);
  bool enterConversion(const std::string& id, bool needed);
  void leaveConversion(const std::string& id);
  void pushToConversion(const std::string& id, const Worker::Job& job);
  sweep_guard_core::TriangleMesh meshOf(const sweep_guard::DeformableMesh& msg) const;
  void convert(const sweep_guard::DeformableMesh::ConstPtr& msg, sweep_guard_core::SteadyTime received);
  void pushToStore(const sweep_guard::MeshVertices::ConstPtr& msg, sweep_guard_core::SteadyTime received);
  void store(const sweep_guard::DeformableMesh& msg, sweep_guard_core::SteadyTime received,
             std::optional<sweep_guard_core::TriangleMesh> mesh_M);
  void store(const sweep_guard::MeshVertices& msg, sweep_guard_core::SteadyTime received);
  std::string refusal(const std::string& id, const std::exception& error, sweep_guard_core::InputRecord& record);
  void keepIfEarly(const sweep_guard::DeformableMesh::ConstPtr& msg, sweep_guard_core::SteadyTime received);
  void forgetEarly(const std::string& id);
  void storeEarly(const std::string& id);
  std::optional<EarlyMesh> dueOf(const std::string& id);
  void drop(const sweep_guard::DeformableMesh& msg, sweep_guard_core::SteadyTime received);
  void drop(const sweep_guard::MeshVertices& msg, sweep_guard_core::SteadyTime received);

  const std::set<std::string> mesh_ids_;
  const std::vector<std::string> other_tools_;
  const std::set<std::string> cameras_;  // ids
  const sweep_guard_core::Rules<bool> sheets_;
  const sweep_guard_core::Rules<double> paddings_;
  const size_t max_triangles_;
  const size_t max_waiting_bytes_;  // in each of three places
  sweep_guard_core::WorkpieceStore& workpieces_;
  sweep_guard_core::WarningMonitor& monitor_;
  LogThrottle log_;
  sweep_guard_core::InputRecord mesh_record_;
  sweep_guard_core::InputRecord vertices_record_;
  std::atomic<std::uint64_t> dropped_ = 0;
  mutable sweep_guard_core::Mutex passed_over_mutex_;
  std::set<std::string> passed_over_ GUARDED_BY(passed_over_mutex_);
  sweep_guard_core::Mutex conversion_mutex_;
  std::map<std::string, size_t> in_conversion_ GUARDED_BY(conversion_mutex_);  // by id: messages that converting_ has
  sweep_guard_core::Mutex early_mutex_;
  std::map<std::string, EarlyMesh> early_ GUARDED_BY(early_mutex_);  // by id
  Worker storing_;                                                   // before what pushes jobs
  Worker converting_;                                                // before the thread that pushes jobs
  QueueThread thread_;                                               // before the subscribers, which use its queue
  BoundedSubscriber mesh_;
  BoundedSubscriber vertices_;
};

}  // namespace sweep_guard_ros
