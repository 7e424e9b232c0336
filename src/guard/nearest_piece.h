#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "guard/contact_probability.h"
#include "guard/swept_path.h"
#include "sweep_guard/detection/submesh.h"
#include "sweep_guard/guard/contact_policy.h"

namespace sweep_guard_core {

/// A workpiece that a predicted path of a tool is tested against.
struct WorkpieceOnPath {
  const Tool& tool;
  const Workpiece& workpiece;
  ContactPolicy contact;
  const IntendedTouches* touches;  ///< null: none
  SweepOptions options;
  double margin;  ///< the tool is grown by this [m]: that of the options, and the rounding of the mesh

  /// Returns whether the link of a piece has touched the workpiece as intended, and not left it since.
  bool hasTouched(size_t piece) const;
  /// Returns the triangles that a piece is meant to touch during one motion.
  IntendedTriangles intendedFor(size_t piece, const Motion& motion_M) const;
};

/// A convex piece of the tool, and how near it comes to the mesh (Clearance).
struct PieceApproach {
  double deviations = std::numeric_limits<double>::infinity();
  std::optional<size_t> piece = {};  ///< empty: no piece comes near
};

/// Returns the nearer approach; of two equal ones, the first.
const PieceApproach& nearer(const PieceApproach& one, const PieceApproach& other);

/// A piece that no plane separates from the mesh: the detector has to tell whether it meets a triangle.
struct UnseparatedPiece {
  SweptBody body;
  PieceApproach approach;
};

/// Lower bounds on the deviations of the pieces below each node of a tool's tree, during one segment, before there are
/// volumes of the pieces. A piece that comes no nearer than in an earlier sweep need not be swept at all.
class PieceBounds {
 public:
  /// Bounds nothing.
  PieceBounds() = default;
  /// @param boxes   of the triangles that may be reached
  /// @param buffer  of the caller, overwritten; as all arguments, it must outlive this
  PieceBounds(const Tool& tool, const UncertainStep& step, const ClusterBoxes& boxes,
              std::vector<std::optional<double>>& buffer);

  bool bounded() const { return step_ != nullptr; }
  double least(size_t node) const;  ///< [standard deviations]; -infinity if nothing is bounded
  /// Returns the two nodes below a node, first the one that may come nearer.
  std::array<size_t, 2> nearestFirst(const Tool::Node& node) const;
  /// Returns whether a piece whose contact is not allowed may come as near as a limit. Only if bounded().
  bool anyWithin(double limit, const ContactPolicy& contact) const;

 private:
  const Tool* tool_ = nullptr;
  const UncertainStep* step_ = nullptr;
  const ClusterBoxes* boxes_ = nullptr;
  std::vector<std::optional<double>>* least_ = nullptr;  // of each node; empty: not computed yet
};

/// Finds the piece of the tool that comes nearest to a mesh in one segment of a predicted path, and the pieces that no plane
/// separates from it.
///
/// Idea: the tree of boxes is descended, the nearer box first [branch and bound]. A box, or a piece, is left out once
/// its bound exceeds the nearest approach found so far. Cost: in most segments a few boxes and no piece.
class NearestPieceFinder {
 public:
  explicit NearestPieceFinder(double max_deviations) : meter_(max_deviations), max_deviations_(max_deviations) {}

  /// Returns whether a piece is near. If none is, find() finds none. Takes a fraction of its time.
  bool any(const WorkpieceOnPath& on_path, const Submesh& submesh, const SweptSegment& swept,
           const PieceBounds& bounds);

  /// @param swept    with its deviations
  /// @param at_most  approaches at more standard deviations are not looked for
  /// @param[out] unseparated  overwritten; its buffer is used again
  PieceApproach find(const WorkpieceOnPath& on_path, const Submesh& submesh, const SweptSegment& swept,
                     const PieceBounds& bounds, double at_most, std::vector<UnseparatedPiece>& unseparated);

  /// Returns the largest number of deviations that counts under a limit.
  double limit(double at_most) const;

 private:
  struct Search;

  ClearanceMeter meter_;
  double max_deviations_;
};

}  // namespace sweep_guard_core
