#include "simulation/workpiece_messages.h"

#include <tf2_eigen/tf2_eigen.h>

namespace sweep_guard_simulation {
namespace {

constexpr std::uint32_t kRevision = 1;

}  // namespace

sweep_guard::DeformableMesh meshMessage(const Workpiece& workpiece, double t) {
  sweep_guard::DeformableMesh message;
  message.revision = kRevision;
  const std::vector<float> positions = workpiece.positions(t);
  for (size_t i = 0; i < positions.size(); i += 3) {
    message.mesh.vertices.push_back(
        tf2::toMsg(Eigen::Vector3d(Eigen::Map<const Eigen::Vector3f>(&positions[i]).cast<double>())));
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
