#pragma once

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "data_path.h"
#include "sweep_guard/geometry/convex_shape.h"
#include "sweep_guard/geometry/triangle_mesh.h"
#include "sweep_guard/ros/tool/mesh_file.h"

namespace sweep_guard_core {

/// A convex piece and, independently, the corners of what stands for it.
struct VolumePiece {
  ConvexShape shape_T;
  std::vector<Eigen::Vector3d> corners_T;
};

inline VolumePiece cylinderPiece(double radius, double length) {
  constexpr int kSides = 32;
  const double angle = 2.0 * M_PI / kSides;
  const double same_area = radius * std::sqrt(M_PI / (0.5 * kSides * std::sin(angle)));
  std::vector<Eigen::Vector3d> corners_T;
  for (int i = 0; i < kSides; ++i) {
    for (const double z : {0.0, -length}) {
      corners_T.emplace_back(same_area * std::cos(i * angle), same_area * std::sin(i * angle), z);
    }
  }
  return {ConvexShape::cylinder(radius, length, kSides), corners_T};
}

inline VolumePiece boxPiece(const Eigen::Vector3d& half) {
  std::vector<Eigen::Vector3d> corners_T;
  for (int i = 0; i < 8; ++i) {
    corners_T.emplace_back((i & 1) != 0 ? half.x() : -half.x(), (i & 2) != 0 ? half.y() : -half.y(),
                           (i & 4) != 0 ? half.z() : -half.z());
  }
  return {ConvexShape::box(half), corners_T};
}

constexpr char kFingerMesh[] = "urdf/franka_description/meshes/visual/finger.dae";

/// @param scale  1 / unit of length [1/m]
inline VolumePiece fingerPiece(double scale) {
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& p : sweep_guard_ros::readMesh(dataPath(kFingerMesh)).vertices)
    points.emplace_back(scale * p);
  const ConvexShape shape_T = ConvexShape::hull(points);
  std::vector<Eigen::Vector3d> corners_T;
  for (size_t i = 0; i < shape_T.mesh_T().vertexCount(); ++i) corners_T.push_back(shape_T.mesh_T().vertex(i));
  return {shape_T, corners_T};
}

/// @param size  of the mesh that the piece is put into [m]
/// @throws std::invalid_argument if there is no piece of this name
inline VolumePiece pieceNamed(std::string_view name, double size) {
  if (name == "cylinder") return cylinderPiece(0.04 * size, 0.5 * size);
  if (name == "box") return boxPiece(size * Eigen::Vector3d(0.05, 0.1, 0.15));
  if (name == "finger") return fingerPiece(4.0 * size);
  throw std::invalid_argument("there is no piece " + std::string(name));
}

/// Returns a number that differs where vertices or triangles differ: FNV-1a of their bytes.
inline std::uint64_t hashOf(const TriangleMesh& mesh) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  const auto add = [&](const void* bytes, size_t count) {
    for (size_t i = 0; i < count; ++i) {
      hash = (hash ^ static_cast<const unsigned char*>(bytes)[i]) * 0x100000001b3U;
    }
  };
  for (const auto& triangle : mesh.triangles()) {
    for (const std::uint32_t vertex : triangle) {
      const Eigen::Vector3d p = mesh.vertex(vertex);
      add(p.data(), 3 * sizeof(double));
    }
  }
  return hash;
}

/// Volumes that pieces have in common with meshes: a line `mesh FILE HASH`, below it lines `piece NAME VOLUME` [m^3], below
/// each a line for each pose: the 3 x 4 numbers of X_MT, row by row [-, m], and the common volume [m^3]. Numbers are
/// hexadecimal.
constexpr char kVolumesFile[] = "/test/interaction/volumes.txt";

}  // namespace sweep_guard_core
