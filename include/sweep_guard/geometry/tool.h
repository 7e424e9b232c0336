#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sweep_guard/geometry/convex_shape.h"

namespace sweep_guard_core {

/// One convex piece of a tool.
struct ConvexPiece {
  std::string link;     ///< link of the robot description; empty for a tool without one
  ConvexShape shape_T;  ///< in the tool frame
};

/// The rigid tool in its frame T; by convention, the origin is at the tip and z points out of the tip. The tool is a
/// union of convex pieces under a tree of boxes [P, Sec. 5; Gottschalk et al. 1996]: a triangle that does not intersect
/// a box does not intersect the pieces below it.
class Tool {
 public:
  /// A node of the tree: a leaf is a piece, any other node is a box around the pieces below it.
  struct Node {
    ConvexShape shape_T;
    Eigen::AlignedBox3d bounds_T;      ///< of its pieces and of their faces (ConvexShape), along the axes of T [m]
    std::optional<size_t> piece;       ///< index into pieces(), for a leaf
    std::array<size_t, 2> below = {};  ///< indices into tree(), for other nodes
  };

  /// @throws InvalidInput if there is no piece, or if a box around several pieces would reach beyond kMaxCoordinate
  explicit Tool(std::vector<ConvexPiece> pieces);
  /// Makes a tool of one piece.
  explicit Tool(const ConvexShape& shape_T);

  /// Makes the round cylinder of [P, Sec. 3.1] around the z axis of T, with z in [-length, 0].
  /// @param radius  [m], 0 to kMaxCoordinate
  /// @param length  [m], 0 to kMaxCoordinate; not both 0
  /// @param sides   number of sides of the piece's mesh_T(), 3 to 1000
  /// @throws InvalidInput if an argument is out of range
  static Tool cylinder(double radius, double length, int sides = 32);

  const std::vector<ConvexPiece>& pieces() const { return pieces_; }
  const std::vector<Node>& tree() const { return tree_; }          ///< the root first
  const ConvexShape& whole() const { return tree_[0].shape_T; }    ///< the only piece, or a box around all
  const Eigen::AlignedBox3d& bounds_T() const { return bounds_; }  ///< of all pieces, along the axes of T [m]
  /// Returns an upper bound on the distance of a tool point from the origin of T [m].
  double boundingRadius() const { return bounding_radius_; }

 private:
  size_t grow(std::vector<size_t> pieces);
  Eigen::AlignedBox3d boundsWithFaces(const std::vector<size_t>& pieces) const;
  ConvexShape boxAround(const std::vector<size_t>& pieces) const;

  std::vector<ConvexPiece> pieces_;
  std::vector<Node> tree_;
  Eigen::AlignedBox3d bounds_;
  double bounding_radius_ = 0.0;
};

}  // namespace sweep_guard_core
