#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sweep_guard/geometry/convex_shape.h"

namespace sweep_guard_core {

/// One convex part of a tool.
struct ConvexPiece {
  std::string link;     ///< of the robot's description; empty for a tool without one
  ConvexShape shape_T;  ///< in the tool frame
};

/// The rigid tool, in its frame T: origin at the tip, z pointing out of the tip. It is the union of convex parts, under
/// a tree of boxes [P, Sec. 5; Gottschalk et al. 1996]: what does not meet a box does not meet the parts below it.
class Tool {
 public:
  /// A node of the tree: a leaf is a part, any other a box around the parts below it.
  struct Node {
    ConvexShape shape_T;
    std::optional<size_t> piece;       ///< of a leaf: index into parts()
    std::array<size_t, 2> below = {};  ///< of any other: indices into tree()
  };

  /// @throws InvalidInput if there is no part
  explicit Tool(std::vector<ConvexPiece> parts);
  /// A tool of one part.
  explicit Tool(const ConvexShape& shape_T);

  /// The cylinder of [P, Sec. 3.1]: see ConvexShape::cylinder().
  static Tool cylinder(double radius, double length, int sides = 32);

  const std::vector<ConvexPiece>& pieces() const { return pieces_; }
  const std::vector<Node>& tree() const { return tree_; }          ///< the root first
  const ConvexShape& whole() const { return tree_[0].shape_T; }    ///< around all parts
  const Eigen::AlignedBox3d& bounds_T() const { return bounds_; }  ///< of all parts, along the axes of T [m]
  double boundingRadius() const {
    return bounding_radius_;
  }  ///< bound on the distance of a tool point from the origin of T [m]

 private:
  size_t grow(std::vector<size_t> parts);
  ConvexShape boxAround(const std::vector<size_t>& parts) const;

  std::vector<ConvexPiece> pieces_;
  std::vector<Node> tree_;
  Eigen::AlignedBox3d bounds_;
  double bounding_radius_ = 0.0;
};

}  // namespace sweep_guard_core
