#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "sweep_guard/geometry/mesh_order.h"
#include "sweep_guard/geometry/vertex_blocks.h"

namespace sweep_guard_core {

/// Largest coordinate accepted [m]. Beyond it double precision loses what a contact needs.
constexpr double kMaxCoordinate = 1e7;

/// A triangle mesh at one moment, in its frame M, checked. Vertices are kept as float32 offsets from an origin, the
/// precision and the layout of the stream they come from; rounding() says what that cost. Degenerate triangles and
/// vertices without a triangle are kept: dropping them could lose a wire or a tip. Indices are the sender's everywhere,
/// but for places(), order() and blocks().
class TriangleMesh {
 public:
  /// @param vertices_M  positions [m], each coordinate finite and within +-kMaxCoordinate
  /// @param triangles   at least one, each index below vertices_M.size()
  /// @throws InvalidInput with the index of the first offender
  TriangleMesh(const std::vector<Eigen::Vector3d>& vertices_M, std::vector<Triangle> triangles);

  /// Deforms it. One pass over the positions; no structure is rebuilt. Buffers are exchanged and nothing is allocated,
  /// but for a spare one the first time, where vertices are renumbered.
  /// @param[in,out] positions_M  x0 y0 z0 x1 ... [m], one triple per vertex, bounds as above; afterwards room for the
  ///                             next ones, its contents are of no use
  /// @throws InvalidInput on a wrong count or a bad coordinate: the mesh stays as it was
  void deform(std::vector<float>& positions_M);

  /// The same triangles after a deformation, likewise.
  TriangleMesh deformed(std::vector<float> positions_M) const;

  const std::vector<Triangle>& triangles() const { return topology_->triangles; }
  /// Each edge belongs to an even number of triangles: the surface has no border, and so an inside.
  bool closed() const { return topology_->closed; }
  size_t vertexCount() const { return offsets_.size() / 3; }

  /// Position of vertex `i` in M [m].
  Eigen::Vector3d vertex(size_t i) const { return origin_ + offset(i); }

  const Eigen::Vector3d& origin() const { return origin_; }  ///< in M [m]
  /// Position of vertex `i` relative to origin() [m]; exact in float32.
  Eigen::Vector3d offset(size_t i) const {
    const std::vector<std::uint32_t>& places = topology_->order.vertex_places;
    const size_t place = places.empty() ? i : places[i];
    return Eigen::Map<const Eigen::Vector3f>(&offsets_[3 * place]).cast<double>();
  }

  /// Offsets of the vertices by their places in order(): x0 y0 z0 x1 ... [m].
  const std::vector<float>& places() const { return offsets_; }
  /// Boxes around blocks of these [m].
  const VertexBlocks& blocks() const { return blocks_; }
  /// Of vertices and triangles in memory; the same for all deformations.
  const MeshOrder& order() const { return topology_->order; }
  /// Bound on the distance [m] of a vertex from origin(): the farthest corner of the box around all.
  double radius() const { return radius_; }

  /// The box along the axes of M that holds every vertex [m].
  Eigen::AlignedBox3d bounds_M() const { return {origin_ + blocks_.bounds().min(), origin_ + blocks_.bounds().max()}; }

  /// Largest distance [m] between a vertex as it was given and as it is kept. 0 for positions given in float32.
  double rounding() const { return rounding_; }

 private:
  struct Topology {
    std::vector<Triangle> triangles;
    bool closed;
    MeshOrder order;
  };

  explicit TriangleMesh(std::shared_ptr<const Topology> topology) : topology_(std::move(topology)) {}
  bool exchange(std::vector<float>& sent);
  bool measure();

  std::shared_ptr<const Topology> topology_;  // shared by all deformations
  std::vector<float> offsets_;                // in their places
  std::vector<float> spare_;                  // only where the vertices are renumbered
  VertexBlocks blocks_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  double radius_ = 0.0;
  double rounding_ = 0.0;
};

}  // namespace sweep_guard_core
