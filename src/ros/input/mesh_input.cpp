#include "ros/input/mesh_input.h"

namespace sweep_guard_ros {
namespace {

constexpr std::uint32_t kQueued = 1000;  // each message may be of another workpiece

template <typename Msg>
ros::Subscriber subscribe(ros::NodeHandle node, const std::string& topic, WorkpieceStore& workpieces) {
  return node.subscribe<Msg>(
      topic, kQueued, [&workpieces](const typename Msg::ConstPtr& msg) { workpieces.accept(*msg); }, nullptr,
      ros::TransportHints().tcpNoDelay());
}

}  // namespace

MeshInput::MeshInput(const ros::NodeHandle& node, WorkpieceStore& workpieces)
    : mesh_(subscribe<sweep_guard::DeformableMesh>(thread_.on(node), "mesh", workpieces)),
      vertices_(subscribe<sweep_guard::MeshVertices>(thread_.on(node), "mesh_vertices", workpieces)) {}

}  // namespace sweep_guard_ros
