#include "simulation/workpiece_messages.h"

namespace sweep_guard_simulation {
namespace {

constexpr std::uint32_t kRevision = 1;

}  // namespace

sweep_guard::DeformableMesh meshMessage(const Workpiece& workpiece, double t) {
  sweep_guard::DeformableMesh message;
  message.revision = kRevision;
  const std::vector<float> positions = workpiece.positions(t);
  for (size_t i = 0; i < positions.size(); i += 3) {
    geometry_msgs::Point& point = message.mesh.vertices.emplace_back();
    point.x = static_cast<double>(positions[i]);
    point.y = static_cast<double>(positions[i + 1]);
    point.z = static_cast<double>(positions[i + 2]);
  }
  for (const auto& [a, b, c] : workpiece.triangles()) {
    message.mesh.triangles.emplace_back().vertex_indices = {a, b, c};
  }
  return message;
}

sweep_guard::MeshVertices verticesMessage(const Workpiece& workpiece, double t) {
  sweep_guard::MeshVertices message;
  message.revision = kRevision;
  message.positions = workpiece.positions(t);
  return message;
}

}  // namespace sweep_guard_simulation
