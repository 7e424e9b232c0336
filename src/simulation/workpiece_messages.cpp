#include "simulation/workpiece_messages.h"

#include <tf2_eigen/tf2_eigen.h>

#include <utility>

namespace sweep_guard_simulation {
namespace {

constexpr std::uint32_t kRevision = 1;

}  // namespace

sweep_guard::DeformableMesh meshMessage(const std::vector<float>& positions,
                                        const std::vector<sweep_guard_core::Triangle>& triangles) {
  sweep_guard::DeformableMesh message;
  message.revision = kRevision;
  for (size_t i = 0; i < positions.size(); i += 3) {
    message.mesh.vertices.push_back(
        tf2::toMsg(Eigen::Vector3d(Eigen::Map<const Eigen::Vector3f>(&positions[i]).cast<double>())));
  }
  for (const auto& [a, b, c] : triangles) {
    message.mesh.triangles.emplace_back().vertex_indices = {a, b, c};
  }
  return message;
}

sweep_guard::MeshVertices verticesMessage(std::vector<float> positions) {
  sweep_guard::MeshVertices message;
  message.revision = kRevision;
  message.positions = std::move(positions);
  return message;
}

}  // namespace sweep_guard_simulation
