#pragma once

#include <cstddef>
#include <cstdint>

namespace sweep_guard_ros {

/// Begins the answer that mesh_reader writes to its standard output (exit status 0). The vertices follow as double
/// x0 y0 z0 x1 ..., then the triangles as three uint32 vertex indices each. If mesh_reader refuses the file (exit
/// status 1), its answer is the reason as text.
struct MeshWireHeader {
  std::uint32_t vertices;
  std::uint32_t triangles;
};

constexpr std::uint32_t kMaxMeshTriangles = 1000000;
constexpr std::uint32_t kMaxMeshVertices = 3 * kMaxMeshTriangles;
constexpr std::size_t kMaxMeshFile = std::size_t{32} << 20U;  ///< [byte]

/// Returns the length of an answer [byte].
constexpr std::size_t wireSize(const MeshWireHeader& header) {
  return sizeof header + std::size_t{header.vertices} * 3 * sizeof(double) +
         std::size_t{header.triangles} * 3 * sizeof(std::uint32_t);
}

}  // namespace sweep_guard_ros
