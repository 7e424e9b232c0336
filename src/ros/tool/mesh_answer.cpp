#include "ros/tool/mesh_answer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "ros/tool/mesh_wire.h"

namespace sweep_guard_ros {
namespace {

template <typename Value>
std::vector<Value> take(const std::string& bytes, size_t& at, size_t count) {
  std::vector<Value> values(count);
  std::memcpy(values.data(), bytes.data() + at, count * sizeof(Value));
  at += count * sizeof(Value);
  return values;
}

}  // namespace

std::optional<MeshSurface> surfaceFrom(const std::string& answer) {
  size_t at = 0;
  if (answer.size() < sizeof(MeshWireHeader)) return {};
  const MeshWireHeader header = take<MeshWireHeader>(answer, at, 1).front();
  if (header.vertices > kMaxMeshVertices || header.triangles > kMaxMeshTriangles) return {};
  if (header.vertices == 0 || header.triangles == 0) return {};
  if (answer.size() != wireSize(header)) return {};
  MeshSurface surface;
  for (const auto& [x, y, z] : take<std::array<double, 3>>(answer, at, header.vertices)) {
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) return {};
    surface.vertices.emplace_back(x, y, z);
  }
  surface.triangles = take<sweep_guard_core::Triangle>(answer, at, header.triangles);
  for (const sweep_guard_core::Triangle& triangle : surface.triangles) {
    if (*std::max_element(triangle.begin(), triangle.end()) >= header.vertices) return {};
  }
  return surface;
}

}  // namespace sweep_guard_ros
