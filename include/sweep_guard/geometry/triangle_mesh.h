#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "sweep_guard/geometry/enclosure.h"
#include "sweep_guard/geometry/mesh_order.h"
#include "sweep_guard/geometry/vertex_blocks.h"

namespace sweep_guard_core {

/// Largest absolute coordinate accepted [m]. Beyond it double precision is too coarse for a contact. Vertices that are sent
/// as float32 are too coarse from about 130 km on: see kMaxSentRounding.
constexpr double kMaxCoordinate = 1e7;

/// Largest float32Rounding() of vertices that are sent as float32 [m]: for two large coordinates reached at 131 km, for one
/// at 262 km.
constexpr double kMaxSentRounding = 0.01;

/// Returns how far a vertex may be from where it was before its sender rounded it to float32 [m]: half a step of float32
/// on each axis.
/// @param largest  largest absolute coordinate on each axis [m]
double float32Rounding(const Eigen::Vector3d& largest);

class Grid;

/// A checked triangle mesh at one time, in its frame M. Stores vertices as float32 offsets from an origin; rounding()
/// bounds the error. Keeps degenerate triangles and unused vertices, because they may be a wire or a tip. All indices
/// are those given to the constructor (the sender's), except in places(), order() and blocks().
class TriangleMesh {
 public:
  /// @param vertices_M  positions [m], each coordinate finite and within +-kMaxCoordinate
  /// @param triangles   at least one, each index below vertices_M.size()
  /// @param is_sheet    the sender says that it encloses nothing
  /// @param rounded     how far the positions may be from the true ones already [m], >= 0; joins rounding()
  /// @throws InvalidInput if there is no triangle, or naming the first invalid triangle or else vertex, or if the
  ///     environment variable SWEEP_GUARD_SIMD is wrong (simd::kernels())
  TriangleMesh(const std::vector<Eigen::Vector3d>& vertices_M, std::vector<Triangle> triangles, bool is_sheet = false,
               double rounded = 0.0);
  /// `rounded` comes after `is_sheet`.
  TriangleMesh(const std::vector<Eigen::Vector3d>&, std::vector<Triangle>, double) = delete;

  /// Makes the mesh of a grid, of which no triangle exists yet. It is a sheet.
  explicit TriangleMesh(const Grid& grid);

  /// Grows margin() by this: the surface counts as nearer by so much, whatever the tool. deform() keeps it.
  /// @param padding  [m], >= 0; not checked
  void pad(double padding) { padding_ = padding; }
  double padding() const { return padding_; }  ///< [m]

  /// Replaces the positions of all vertices in one pass; rebuilds no structure. Exchanges buffers and allocates
  /// nothing, except for a spare buffer at the first call on a mesh with renumbered vertices. rounding() is then that of
  /// positions which were rounded to float32 before.
  /// @param[in,out] positions_M  x0 y0 z0 x1 ... [m], one triple per vertex, bounds as above; on return a buffer of the
  ///                             same size with unspecified contents
  /// @throws InvalidInput for a wrong count or an invalid coordinate; mesh and positions do not change
  void deform(std::vector<float>& positions_M);
  /// Replaces the positions of all vertices of a grid, and says which of its triangles exist, and from where its vertices have come.
  /// Exchanges buffers and allocates nothing, but for their boxes at the first call.
  /// @param[in,out] places_M  as in deform(), at the places of the grid
  /// @param[in,out] before_M  where the vertices were before, by an earlier call (asserted to be in bounds): the way from there is
  ///                          part of the mesh in motion, see blocksInMotion()
  /// @param[in,out] existing  for each cluster the bits of its triangles that exist; on return another such buffer
  /// @throws InvalidInput as deform() does
  void deform(std::vector<float>& places_M, std::vector<float>& before_M, std::vector<std::uint64_t>& existing);
  /// @throws InvalidInput if these are not three coordinates per vertex
  void checkCount(const std::vector<float>& positions_M) const;

  const std::vector<Triangle>& triangles() const { return topology_->triangles; }
  /// Returns the bits of the triangles of a cluster that exist: all, but in a grid.
  /// @param cluster  of this mesh, or of a submesh of it
  std::uint64_t existing(const Cluster& cluster) const {
    return existing_.empty() ? cluster.all() : existing_[cluster.number];
  }
  /// Returns triangles(), which stay the same object for all deformations and copies.
  std::shared_ptr<const std::vector<Triangle>> sharedTriangles() const { return {topology_, &topology_->triangles}; }
  /// Returns what the surface encloses: of a sheet nothing.
  const Enclosure& enclosure() const { return topology_->enclosure; }
  /// Returns whether for every point off the surface it is known whether it lies inside: the surface has no border.
  bool closed() const { return !isSheet() && enclosure().openEdges() == 0; }
  /// Returns the number of edges at its borders; 0 of a sheet, which has no inside.
  size_t openEdges() const { return enclosure().openEdges(); }
  bool isSheet() const { return topology_->is_sheet; }
  size_t vertexCount() const { return offsets_.size() / 3; }

  /// Returns the position of vertex `i` in M [m]; i < vertexCount(), not checked.
  Eigen::Vector3d vertex(size_t i) const { return origin_ + offset(i); }

  const Eigen::Vector3d& origin() const { return origin_; }  ///< of the offsets, in M [m]; zero after deform()
  /// Returns the position of vertex `i` relative to origin() [m]; exact in float32.
  Eigen::Vector3d offset(size_t i) const {
    const std::vector<std::uint32_t>& places = topology_->order.vertex_places;
    const size_t place = places.empty() ? i : places[i];
    return Eigen::Map<const Eigen::Vector3f>(&offsets_[3 * place]).cast<double>();
  }

  /// Returns the offsets of the vertices at their places in order(): x0 y0 z0 x1 ... [m].
  const std::vector<float>& places() const { return offsets_; }
  /// Returns the boxes around blocks of places(), relative to origin() [m].
  const VertexBlocks& blocks() const { return blocks_; }
  /// Returns where the vertices of a grid were before, as places(); of any other mesh none.
  const std::vector<float>& placesBefore() const { return before_; }
  /// Returns the boxes around each block of a grid both before and now.
  const VertexBlocks& blocksInMotion() const { return blocks_in_motion_; }
  /// Returns the position of vertex `i` of a grid before, in M [m].
  Eigen::Vector3d vertexBefore(size_t i) const {
    return origin_ + Eigen::Map<const Eigen::Vector3f>(&before_[3 * i]).cast<double>();
  }

  /// Returns the order of vertices and triangles in memory; it is the same for all deformations.
  const MeshOrder& order() const { return topology_->order; }
  /// Returns an upper bound on the distance [m] of a vertex from origin(), of a grid also before: that of the farthest corner of
  /// the box around all vertices.
  double radius() const { return radius_; }

  /// Returns the box along the axes of M that contains every vertex as stored [m].
  Eigen::AlignedBox3d bounds_M() const { return {origin_ + blocks_.bounds().min(), origin_ + blocks_.bounds().max()}; }

  /// Returns an upper bound on the distance [m] between a vertex and what is stored of it: what storing it as float32
  /// costs, after deform() what sending it as float32 has cost (1e-7 m at coordinates of 1 m).
  double rounding() const { return rounding_; }
  /// Returns how far around its stored triangles the mesh may be, or is to be kept free: rounding() and padding() [m].
  double margin() const { return rounding_ + padding_; }

 private:
  struct Topology {
    std::vector<Triangle> triangles;
    bool is_sheet;
    Enclosure enclosure;
    MeshOrder order;
  };

  bool exchange(std::vector<float>& sent);
  bool measure();
  bool takeBounds(const Eigen::AlignedBox3d& bounds);
  void roundTo(const Eigen::AlignedBox3d& bounds);

  std::shared_ptr<const Topology> topology_;  // shared by all deformations
  std::vector<float> offsets_;                // at their places
  std::vector<float> spare_;                  // only if the vertices are renumbered
  std::vector<std::uint64_t> existing_;       // of each cluster; empty: all
  VertexBlocks blocks_;
  std::vector<float> before_;  // of a grid, at their places
  VertexBlocks blocks_in_motion_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  double radius_ = 0.0;
  double rounding_ = 0.0;
  double padding_ = 0.0;
};

}  // namespace sweep_guard_core
