#include "guard/nearest_piece.h"

#include <algorithm>
#include <variant>

#include "common/floating_point.h"
#include "common/stage_clock.h"
#include "guard/tool_tree.h"

namespace sweep_guard_core {

bool WorkpieceOnPath::hasTouched(size_t piece) const {
  return touches != nullptr && contact.intendsAny() && touches->contains(workpiece.id, tool.pieces()[piece].link);
}

IntendedTriangles WorkpieceOnPath::intendedFor(size_t piece, const Motion& motion_M) const {
  if (!contact.intendsAny()) return {};
  return contact.trianglesIntendedFor(piece, {motion_M}, margin);
}

const PieceApproach& nearer(const PieceApproach& one, const PieceApproach& other) {
  return other.deviations < one.deviations ? other : one;
}

PieceBounds::PieceBounds(const Tool& tool, const UncertainStep& step, const ClusterBoxes& boxes,
                         std::vector<std::optional<double>>& buffer)
    : tool_(&tool), step_(&step), boxes_(&boxes), least_(&buffer) {
  buffer.assign(tool.tree().size(), std::nullopt);
}

double PieceBounds::least(size_t node) const {
  if (!bounded()) return -kInfinity;
  std::optional<double>& least = (*least_)[node];
  if (!least) {
    const UncertainBall ball = step_->ballAround(tool_->tree()[node].bounds_T);
    least = ball.deviationsWithin(boxes_->distanceFrom(ball.center_M));
  }
  return *least;
}

std::array<size_t, 2> PieceBounds::nearestFirst(const Tool::Node& node) const {
  const auto& [first, second] = node.below;
  if (least(second) < least(first)) return {second, first};
  return {first, second};
}

bool PieceBounds::anyWithin(double limit, const ContactPolicy& contact) const {
  TreeWalk<std::monostate> walk({});
  while (const auto at = walk.next()) {
    if (least(at->node) > limit) continue;
    const Tool::Node& node = tool_->tree()[at->node];
    if (!node.piece) {
      walk.goBelow(node.below, {});
    } else if (!contact.allows(*node.piece)) {
      return true;
    }
  }
  return false;
}

// One motion of the tool in a segment.
struct NearestPieceFinder::Search {
  NearestPieceFinder& finder;
  const WorkpieceOnPath& on_path;
  const Submesh& submesh;
  const PieceBounds& bounds;
  const Motion& motion_M;
  const UncertainPose& end_M;
  double at_most = kInfinity;

  // Whether no piece below a node counts, or comes nearer than `at_most`. The planes that cut the box of a piece take more time
  // than the box, and most boxes suffice. Without bounds, the boxes around pieces have to.
  bool isLeftOut(size_t number) const {
    const Tool::Node& node = on_path.tool.tree()[number];
    if (node.piece && on_path.contact.allows(*node.piece)) return true;
    if (bounds.least(number) > finder.limit(at_most)) return true;
    const bool box_helps = node.piece ? on_path.options.volume != VolumeKind::kObb : !bounds.bounded();
    if (!box_helps) return false;
    const SweptVolume box_M = sweptVolume(node.shape_T, motion_M, VolumeKind::kObb, on_path.margin);
    return finder.meter_.isSeparated(submesh, box_M, deviations(node.shape_T, box_M),
                                     finder.limit(node.piece ? at_most : kInfinity));
  }

  PerHalfSpace deviations(const ConvexShape& shape_T, const SweptVolume& swept_M) const {
    return planeDeviations(shape_T, end_M.X_MT, end_M.covariance_M, swept_M);
  }
  bool isNear(size_t piece, const SweptBody& body, const PerHalfSpace& deviations) const {
    IntendedTriangles intended = on_path.intendedFor(piece, motion_M);
    return finder.meter_.isNear(submesh, body.volume_M, deviations, &intended);
  }

  void measure(size_t piece, const SweptBody& body, const PerHalfSpace& deviations, PieceApproach& nearest,
               std::vector<UnseparatedPiece>& unseparated) {
    IntendedTriangles intended = on_path.intendedFor(piece, motion_M);
    const auto clearance = finder.meter_.measure(submesh, body.volume_M, deviations, &intended, std::max(0.0, at_most));
    if (!clearance) return;
    const PieceApproach approach{clearance->deviations, piece};
    if (!clearance->separated) unseparated.push_back({body, approach});
    if (!on_path.hasTouched(piece)) nearest = nearer(nearest, approach);
    at_most = std::min(at_most, nearest.deviations);
  }

  // Calls a function with each piece that is not left out, its body and deviations, first the one that may come nearer, until
  // the function returns true. Returns whether one did.
  template <typename Test>
  bool anyPiece(const Test& test) {
    TreeWalk<std::monostate> walk({});
    while (const auto at = walk.next()) {
      if (isLeftOut(at->node)) continue;
      const Tool::Node& node = on_path.tool.tree()[at->node];
      if (!node.piece) {
        walk.goBelow(bounds.nearestFirst(node), {});
        continue;
      }
      const SweptBody body = sweptBody(node.shape_T, motion_M, on_path.options.volume, on_path.margin);
      if (test(*node.piece, body, deviations(node.shape_T, body.volume_M))) return true;
    }
    return false;
  }
};

bool NearestPieceFinder::any(const WorkpieceOnPath& on_path, const Submesh& submesh, const SweptSegment& swept,
                             const PieceBounds& bounds) {
  if (submesh.empty()) return false;
  const InStage stage(Stage::kProbability);
  const std::optional<size_t>& only_piece = on_path.tool.tree()[0].piece;
  for (size_t i = 0; i < swept.bodies.size(); ++i) {
    const SweptBody& body = swept.bodies[i];
    Search search{*this, on_path, submesh, bounds, body.motion_M, swept.end_M};
    const auto isNear = [&](size_t piece, const SweptBody& swept_piece, const PerHalfSpace& deviations) {
      return search.isNear(piece, swept_piece, deviations);
    };
    const bool near =
        only_piece ? !on_path.contact.allows(*only_piece) && search.isNear(*only_piece, body, swept.deviations[i])
                   : meter_.mayBeNear(submesh, body.volume_M, swept.deviations[i]) && search.anyPiece(isNear);
    if (near) return true;
  }
  return false;
}

PieceApproach NearestPieceFinder::find(const WorkpieceOnPath& on_path, const Submesh& submesh,
                                       const SweptSegment& swept, const PieceBounds& bounds, double at_most,
                                       std::vector<UnseparatedPiece>& unseparated) {
  PieceApproach nearest;
  unseparated.clear();
  if (submesh.empty()) return nearest;
  const InStage stage(Stage::kProbability);
  const std::optional<size_t>& only_piece = on_path.tool.tree()[0].piece;
  for (size_t i = 0; i < swept.bodies.size(); ++i) {
    const SweptBody& body = swept.bodies[i];
    const double limit = std::min(at_most, nearest.deviations);
    Search search{*this, on_path, submesh, bounds, body.motion_M, swept.end_M, limit};
    if (only_piece) {
      if (on_path.contact.allows(*only_piece)) continue;
      search.measure(*only_piece, body, swept.deviations[i], nearest, unseparated);
    } else if (meter_.mayBeNear(submesh, body.volume_M, swept.deviations[i])) {
      search.anyPiece([&](size_t piece, const SweptBody& swept_piece, const PerHalfSpace& deviations) {
        search.measure(piece, swept_piece, deviations, nearest, unseparated);
        return false;
      });
    }
  }
  return nearest;
}

double NearestPieceFinder::limit(double at_most) const { return std::max(0.0, std::min(at_most, max_deviations_)); }

}  // namespace sweep_guard_core
