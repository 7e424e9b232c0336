#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace sweep_guard {

/// Three vertex indices, 0-based, of either winding.
using Triangle = std::array<std::uint32_t, 3>;

/// Largest coordinate accepted [m]. Beyond it double precision loses what a contact needs.
constexpr double kMaxCoordinate = 1e7;

/// A triangle mesh at one moment, in its frame M: checked once when it is made, immutable afterwards. Vertices are kept
/// as float32 offsets from an origin, the precision and the layout of the stream they come from; rounding() says what
/// that cost. Degenerate triangles and vertices without a triangle are kept: dropping them could lose a wire or a tip.
class TriangleMesh {
 public:
  /// @param vertices_M  positions [m], each coordinate finite and within +-kMaxCoordinate
  /// @param triangles   at least one, each index below vertices_M.size()
  /// @throws InvalidInput with the index of the first offender
  TriangleMesh(const std::vector<Eigen::Vector3d>& vertices_M, std::vector<Triangle> triangles);

  /// The same triangles after a deformation. Nothing but the positions is read: no structure is rebuilt.
  /// @param positions_M  x0 y0 z0 x1 ... [m], one triple per vertex of this mesh, bounds as above
  /// @throws InvalidInput on a wrong count or a bad coordinate
  TriangleMesh deformed(std::vector<float> positions_M) const;

  const std::vector<Triangle>& triangles() const { return topology_->triangles; }
  /// Each edge belongs to an even number of triangles: the surface has no border, and so an inside.
  bool closed() const { return topology_->closed; }
  size_t vertexCount() const { return offsets_.size() / 3; }

  /// Position of vertex `i` in M [m].
  Eigen::Vector3d vertex(size_t i) const { return origin_ + offset(i); }

  const Eigen::Vector3d& origin() const { return origin_; }  ///< in M [m]
  /// Position of vertex `i` relative to origin() [m]; exact in float32.
  Eigen::Vector3d offset(size_t i) const { return Eigen::Map<const Eigen::Vector3f>(&offsets_[3 * i]).cast<double>(); }

  /// Offsets of the vertices as they lie in memory, x0 y0 z0 x1 ... [m]; all deformations of a mesh have them in the same
  /// places.
  const std::vector<float>& places() const { return offsets_; }

  /// Largest distance [m] of a vertex from origin().
  double radius() const { return radius_; }

  /// The box along the axes of M that holds every vertex [m].
  Eigen::AlignedBox3d bounds_M() const { return {origin_ + bounds_.min(), origin_ + bounds_.max()}; }

  /// Largest distance [m] between a vertex as it was given and as it is kept. 0 for positions given in float32.
  double rounding() const { return rounding_; }

 private:
  struct Topology {
    std::vector<Triangle> triangles;
    bool closed;
  };

  TriangleMesh(std::shared_ptr<const Topology> topology, std::vector<float> positions_M);
  void measure();

  std::shared_ptr<const Topology> topology_;  // shared by all deformations
  std::vector<float> offsets_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  Eigen::AlignedBox3d bounds_;  // of the offsets
  double radius_ = 0.0;
  double rounding_ = 0.0;
};

}  // namespace sweep_guard
