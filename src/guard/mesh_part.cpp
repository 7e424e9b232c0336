#include "sweep_guard/guard/mesh_part.h"

#include <limits>

namespace sweep_guard {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// The box seen from the mesh's origin, grown by what rounding may cost: 2^-48 is a dozen roundings, with a margin.
Eigen::AlignedBox3d aboutOrigin(const TriangleMesh& mesh_M, const Eigen::AlignedBox3d& box_M) {
  const Eigen::Vector3d& origin_M = mesh_M.origin();
  const auto rounding = [&](const Eigen::Vector3d& corner_M) -> Eigen::Vector3d {
    return (corner_M.cwiseAbs() + origin_M.cwiseAbs()).array() * 0x1p-48;
  };
  return {box_M.min() - origin_M - rounding(box_M.min()), box_M.max() - origin_M + rounding(box_M.max())};
}

// One bit for each side of the box that the point lies beyond.
std::uint8_t sidesBeyond(const Eigen::Vector3d& p, const Eigen::AlignedBox3d& box) {
  unsigned bits = 0;
  for (int i = 0; i < 3; ++i) {
    bits |= static_cast<unsigned>(p[i] > box.max()[i]) << (2 * i);
    bits |= static_cast<unsigned>(p[i] < box.min()[i]) << (2 * i + 1);
  }
  return static_cast<std::uint8_t>(bits);
}

bool outOfReach(const TriangleMesh& mesh_M, const Eigen::AlignedBox3d& box) {
  return (box.min().array() > mesh_M.radius()).any() || (box.max().array() < -mesh_M.radius()).any();
}

// Gathers triangles, and numbers the vertices that they use anew.
class Gathering {
 public:
  explicit Gathering(size_t vertices) : index_(vertices, kNone) {}

  void add(std::uint32_t triangle, const Triangle& corners) {
    part_.triangles.push_back(triangle);
    part_.corners.push_back(corners);
  }

  // @param name  of a vertex in the mesh, by its number so far
  template <typename Name>
  MeshPart finish(const Name& name) && {
    for (Triangle& corners : part_.corners) {
      for (std::uint32_t& corner : corners) corner = renumbered(corner, name);
    }
    return std::move(part_);
  }

 private:
  template <typename Name>
  std::uint32_t renumbered(std::uint32_t corner, const Name& name) {
    if (index_[corner] == kNone) {
      index_[corner] = static_cast<std::uint32_t>(part_.vertices.size());
      part_.vertices.push_back(name(corner));
    }
    return index_[corner];
  }

  std::vector<std::uint32_t> index_;
  MeshPart part_;
};

bool beyondOneSide(const std::vector<std::uint8_t>& beyond, const Triangle& corners) {
  return (beyond[corners[0]] & beyond[corners[1]] & beyond[corners[2]]) != 0;
}

}  // namespace

MeshPart partWithin(const TriangleMesh& mesh_M, const Eigen::AlignedBox3d& box_M) {
  const Eigen::AlignedBox3d box = aboutOrigin(mesh_M, box_M);
  if (outOfReach(mesh_M, box)) return {};
  std::vector<std::uint8_t> beyond(mesh_M.vertexCount());
  for (size_t i = 0; i < beyond.size(); ++i) beyond[i] = sidesBeyond(mesh_M.offset(i), box);
  const std::vector<Triangle>& triangles = mesh_M.triangles();
  Gathering gathering(beyond.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (!beyondOneSide(beyond, triangles[i])) gathering.add(i, triangles[i]);
  }
  return std::move(gathering).finish([](std::uint32_t vertex) { return vertex; });
}

MeshPart partWithin(const TriangleMesh& mesh_M, const MeshPart& part, const Eigen::AlignedBox3d& box_M) {
  const Eigen::AlignedBox3d box = aboutOrigin(mesh_M, box_M);
  std::vector<std::uint8_t> beyond(part.vertices.size());
  for (size_t i = 0; i < beyond.size(); ++i) beyond[i] = sidesBeyond(mesh_M.offset(part.vertices[i]), box);
  Gathering gathering(beyond.size());
  for (size_t i = 0; i < part.corners.size(); ++i) {
    if (!beyondOneSide(beyond, part.corners[i])) gathering.add(part.triangles[i], part.corners[i]);
  }
  return std::move(gathering).finish([&](std::uint32_t vertex) { return part.vertices[vertex]; });
}

}  // namespace sweep_guard
