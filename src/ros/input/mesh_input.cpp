#include "ros/input/mesh_input.h"

#include <ros/console.h>

#include "ros/input/future_stamp.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::InvalidInput;

constexpr std::uint32_t kQueueLength = 1000;  // each message may be of another workpiece

void checkHeader(const std::string& id, const std_msgs::Header& header) {
  if (id.empty()) throw InvalidInput("id is empty: name the workpiece");
  if (header.frame_id.empty()) throw InvalidInput("header.frame_id is empty: name the frame of the vertices");
  if (liesInFuture(fromMsg(header.stamp))) throw InvalidInput(kFutureStampText);
}

sweep_guard_core::Time latestStamp() { return now().stamp + kFutureTolerance; }

}  // namespace

MeshInput::MeshInput(const ros::NodeHandle& node, size_t max_triangles, sweep_guard_core::WorkpieceStore& workpieces,
                     sweep_guard_core::WarningMonitor& monitor)
    : max_triangles_(max_triangles),
      workpieces_(workpieces),
      monitor_(monitor),
      mesh_(subscribe<sweep_guard::DeformableMesh>(thread_.on(node), "mesh")),
      vertices_(subscribe<sweep_guard::MeshVertices>(thread_.on(node), "mesh_vertices")) {}

template <typename Msg>
ros::Subscriber MeshInput::subscribe(ros::NodeHandle node, const std::string& topic) {
  return node.subscribe<Msg>(
      topic, kQueueLength, [this](const typename Msg::ConstPtr& msg) { onMessage(*msg); }, nullptr,
      ros::TransportHints().tcpNoDelay());
}

void MeshInput::onMessage(const sweep_guard::DeformableMesh& msg) {
  const std::string refusal = refusalOf(msg, mesh_record_);
  refusal.empty() ? monitor_.meshAccepted(msg.id) : monitor_.meshRefused(msg.id, refusal);
}

void MeshInput::onMessage(const sweep_guard::MeshVertices& msg) {
  const std::string refusal = refusalOf(msg, vertices_record_);
  refusal.empty() ? monitor_.verticesAccepted(msg.id) : monitor_.verticesRefused(msg.id, refusal);
}

template <typename Msg>
std::string MeshInput::refusalOf(const Msg& msg, sweep_guard_core::InputRecord& record) {
  record.received({fromMsg(msg.header.stamp), std::chrono::steady_clock::now()});
  try {
    store(msg);
    return "";
  } catch (const std::exception& error) {  // invalid, or out of memory
    std::string refusal = "workpiece '" + msg.id + "' refused: " + error.what();
    record.error(refusal, /*refused=*/true);
    log_.error(msg.id, refusal);
    return refusal;
  }
}

void MeshInput::store(const sweep_guard::DeformableMesh& msg) {
  if (msg.mesh.vertices.empty() && msg.mesh.triangles.empty()) {
    if (!workpieces_.remove(msg.id)) ROS_WARN("no workpiece '%s' to remove", msg.id.c_str());
    return;
  }
  checkHeader(msg.id, msg.header);
  sweep_guard_core::TriangleMesh mesh_M = fromMsg(msg.mesh, max_triangles_);
  workpieces_.set({msg.id, msg.revision, fromMsg(msg.header.stamp), std::chrono::steady_clock::now(),
                   msg.header.frame_id, std::move(mesh_M)},
                  latestStamp());
}

void MeshInput::store(const sweep_guard::MeshVertices& msg) {
  checkHeader(msg.id, msg.header);
  workpieces_.deform({msg.id, msg.revision, fromMsg(msg.header.stamp), std::chrono::steady_clock::now(),
                      msg.header.frame_id, msg.positions},
                     latestStamp());
}

}  // namespace sweep_guard_ros
