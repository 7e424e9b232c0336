#include "sweep_guard/detection/time_of_impact.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>

#include "common/floating_point.h"
#include "detection/trajectory.h"
#include "geometry/penetration.h"
#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {
namespace {

constexpr int kMaxDirections = 1000;
constexpr int kMaxKnown = 8;         // of these that need not be the direction of the closest points
constexpr double kOffset = 1e-3;     // of the tool's bounding radius
constexpr double kRounding = 2e-15;  // of the size
constexpr double kMinGap = 1e-6;     // of the size; the direction of a smaller one has few exact digits

double diameter(const std::array<Eigen::Vector3d, 3>& p) {
  return std::sqrt(std::max({(p[1] - p[0]).squaredNorm(), (p[2] - p[1]).squaredNorm(), (p[0] - p[2]).squaredNorm()}));
}

// Returns what the shape proposes, the face normal and the axes of the shape; if there is no neighbor, also the normals to one
// axis and one edge. All but the first are in both directions.
Proposals proposals(const PlacedCore& tool, const std::array<Eigen::Vector3d, 3>& corners, bool has_neighbors) {
  Proposals directions = {tool.proposeNormal(corners)};
  const auto propose = [&](const Eigen::Vector3d& direction) {
    const double length = direction.norm();
    if (!(length > 1e-12)) return;
    directions.push_back(direction / length);
    directions.push_back(-direction / length);
  };
  const Eigen::Matrix3d axes = tool.R_MT * tool.shape_T.axes_T();
  for (int i = 0; i < 3; ++i) propose(axes.col(i));
  const std::array<Eigen::Vector3d, 3> edges = {(corners[1] - corners[0]).normalized(),
                                                (corners[2] - corners[1]).normalized(),
                                                (corners[0] - corners[2]).normalized()};
  propose(edges[0].cross(edges[1]));
  if (has_neighbors) return directions;
  for (const Eigen::Vector3d& edge : edges) {
    for (int i = 0; i < 3; ++i) propose(edge.cross(axes.col(i)));
  }
  return directions;
}

}  // namespace

class ImpactFinder::Search {
 public:
  Search(ImpactFinder& finder, const MovingTriangle& triangle, const Eigen::Vector3d& guess_M)
      : finder_(finder), shape_T_(*finder.shape_T_), triangle_(triangle) {
    if (!guess_M.isZero(0.0)) guess_ = turning(shape_T_, finder.sub_motions_[0].R_MT_start.transpose() * guess_M);
    size_ = shape_T_.boundingRadius() + std::max(diameter(triangle.start_M), diameter(triangle.end_M));
    const Trajectory first = trajectoryOf(0);
    const double farthest = std::max(first.maxDistance(), trajectoryOf(count() - 1).maxDistance());
    // The poses have been rounded relative to their distance from the origin of M.
    tolerance_ = 2e-9 * size_ + 1e-14 * (first.base_M().norm() + farthest);
  }

  // Returns the impact of a triangle of which a point of the tool at the start is known.
  Impact overlapAt(const Eigen::Vector3d& point_M, const std::optional<Eigen::Vector3d>& contact_normal_M) {
    const Eigen::Vector3d normal = contact_normal_M ? *contact_normal_M : minimumTranslation();
    return {0.0, point_M, normal, finder_.depthAtEnd(triangle_, normal)};
  }

  Found run(const std::optional<Eigen::Vector3d>& contact_normal_M) {
    Found found;
    for (std::size_t i = 0; i < count(); ++i) {
      const Trajectory trajectory = trajectoryOf(i);
      Gap at = {0.0, direction_ ? trajectory.gap(*direction_, 0.0) : -kInfinity, 0.0};
      const std::optional<Separation> touch = firstTouch(trajectory, finder_.sub_motions_[i].margin, at);
      if (!touch) {
        found.separating_M = trajectory.inMesh(*direction_, 0.0);
        continue;
      }
      const Eigen::Vector3d point_M = trajectory.base_M() + touch->on_obstacle;
      const bool overlaps = i == 0 && at.fraction == 0.0 && touch->gap <= 0.0;
      if (overlaps) return {overlapAt(point_M, contact_normal_M)};
      const double time = (static_cast<double>(i) + at.fraction) / static_cast<double>(count());
      const Eigen::Vector3d& normal = touch->normal;
      const Eigen::Vector3d normal_T = trajectory.tool(at.fraction).R_MT.transpose() * normal;
      found.separating_M = finder_.sub_motions_[0].R_MT_start * normal_T;
      found.impact = Impact{time, point_M, normal, finder_.depthAtEnd(triangle_, normal)};
      return found;
    }
    return found;
  }

 private:
  std::size_t count() const { return finder_.sub_motions_.size(); }

  Trajectory trajectoryOf(std::size_t sub_motion) const {
    const auto all = static_cast<double>(count());
    const auto i = static_cast<double>(sub_motion);
    return {shape_T_, finder_.sub_motions_[sub_motion], triangle_, i / all, (i + 1.0) / all};
  }

  // Advances to the first fraction where the piece is not proven to be farther than the margin, or to the end: empty.
  std::optional<Separation> firstTouch(const Trajectory& trajectory, double margin, Gap& at) {
    bool stuck = false;  // no known direction proves anything from here on
    while (true) {
      const bool try_known = !stuck && directions_ < kMaxKnown;
      if (try_known) tryGuess(trajectory, at);
      const bool near = at.gap <= margin + tolerance_;
      const bool computed = near || !try_known;
      if (computed) {
        const bool close = near && at.gap > margin;
        if (auto touch = close ? cornerTouchAt(trajectory, at) : std::nullopt) return touch;
        const Separation apart = separationAt(trajectory, at.fraction, margin);
        if (overlapping(apart)) return apart;
        if (apart.gap <= margin + tolerance_) {
          return touchAt(trajectory, at.fraction, exactSeparationAt(trajectory, at.fraction));
        }
        direction_ = directionOf(apart.normal, trajectory.tool(at.fraction), try_known);
        at.gap = apart.gap;
      }
      const double from = at.fraction;
      trajectory.advance(*direction_, margin + 0.5 * tolerance_, margin + 0.25 * tolerance_, at);
      if (at.fraction == 1.0) return std::nullopt;
      stuck = at.fraction == from;
      if ((stuck && computed && !direction_->turns) || ++directions_ > kMaxDirections) {
        return touchAt(trajectory, at.fraction, exactSeparationAt(trajectory, at.fraction));
      }
    }
  }

  // A corner of the triangle is mostly next to a face of the piece.
  Direction directionOf(const Eigen::Vector3d& normal, const PlacedCore& tool, bool may_turn) const {
    const auto is_first = [this](const Feature& feature) { return feature.corner == features_.front().corner; };
    const bool of_one_corner = std::all_of(features_.begin(), features_.end(), is_first);
    return may_turn && of_one_corner ? turning(shape_T_, tool.R_MT.transpose() * normal) : fixed(normal);
  }

  // Follows the guess from here on if its gap is larger.
  void tryGuess(const Trajectory& trajectory, Gap& at) {
    if (!guess_ || direction_ == guess_) return;
    const double gap = trajectory.gap(*guess_, at.fraction);
    if (!(gap > at.gap)) return;
    direction_ = guess_;
    at.gap = gap;
  }

  // If a corner is just as far from the tool as the gap along a direction, that is the direction of the closest points.
  std::optional<Separation> cornerTouchAt(const Trajectory& trajectory, const Gap& at) const {
    const double s = at.fraction;
    const Eigen::Vector3d direction = trajectory.inMesh(*direction_, s);
    const Eigen::Vector3d corner = PointHull(trajectory.corners(s)).supportPoint(direction);
    const Eigen::Vector3d on_tool = corner + (at.gap + shape_T_.padding() + kRounding * size_) * direction;
    if (shape_T_.depthOf(trajectory.tool(s).inTool(on_tool)).depth < shape_T_.padding()) return std::nullopt;
    return Separation{direction, at.gap, on_tool, corner, {}};
  }

  bool overlapping(const Separation& apart) const {
    return apart.gap <= 0.0 && (apart.on_tool - apart.on_obstacle).norm() <= shape_T_.padding() + kRounding * size_;
  }

  Eigen::Vector3d initialDirection(const PlacedCore& tool) const {
    return direction_ ? direction_->at(tool) : tool.p_MT;
  }

  // Returns a separation that is exact enough to advance, or if the gap is this small. The gap is that of the padded piece.
  Separation separationAt(const Trajectory& trajectory, double s, double margin) {
    const PlacedCore tool = trajectory.tool(s);
    const std::array<Eigen::Vector3d, 3> corners = trajectory.corners(s);
    Separation apart = roughSeparation(tool, PointHull(corners), margin + shape_T_.padding(), 0.25 * tolerance_,
                                       initialDirection(tool), pointsOf(features_, tool, corners));
    features_ = featuresOf(apart.simplex, tool, corners);
    apart.gap -= shape_T_.padding();
    return apart;
  }

  Separation exactSeparationAt(const Trajectory& trajectory, double s) {
    const PlacedCore tool = trajectory.tool(s);
    const std::array<Eigen::Vector3d, 3> corners = trajectory.corners(s);
    Separation apart =
        separation(tool, PointHull(corners), 0.0, initialDirection(tool), pointsOf(features_, tool, corners));
    features_ = featuresOf(apart.simplex, tool, corners);
    apart.gap -= shape_T_.padding();
    return apart;
  }

  // The direction of a tiny distance has few exact digits. The tool is therefore moved away along it by a little: the
  // error of the direction shrinks by the ratio of this distance to the tool's radius of curvature.
  Separation touchAt(const Trajectory& trajectory, double s, Separation exact) {
    const double distance = exact.gap + shape_T_.padding();
    const double offset = kOffset * (shape_T_.boundingRadius() > 0.0 ? shape_T_.boundingRadius() : size_);
    if (distance > 0.0 && distance < offset) {
      PlacedCore moved = trajectory.tool(s);
      moved.p_MT += offset * exact.normal;
      const std::array<Eigen::Vector3d, 3> corners = trajectory.corners(s);
      exact.normal =
          separation(moved, PointHull(corners), 0.0, exact.normal, pointsOf(features_, moved, corners)).normal;
    }
    return exact;
  }

  // Padding adds the same to the depth along any direction. If the piece without padding is apart from the triangle, the
  // direction of the closest points is the best of all.
  Eigen::Vector3d minimumTranslation() {
    const Trajectory trajectory = trajectoryOf(0);
    const PlacedCore tool = trajectory.tool(0.0);
    const std::array<Eigen::Vector3d, 3> corners = trajectory.corners(0.0);
    const PointHull triangle(corners);
    const NeighborNormals& neighbors = finder_.normals_M_;
    if (shape_T_.padding() > 0.0) {
      const Separation apart = separation(tool, triangle, 0.0, finder_.lastNormal());
      if (apart.gap > kMinGap * size_) return finder_.remember(apart.normal);
    }
    const auto touches = [&](const Eigen::Vector3d& normal, double depth) {
      return tool.touchesACorner(corners, normal, depth, 1e-9 * size_);
    };
    // By reference: std::function allocates nothing for it.
    return finder_.remember(minimumTranslationDirection(tool, triangle, proposals(tool, corners, !neighbors.empty()),
                                                        neighbors, std::max(size_, 1e-12), std::ref(touches)));
  }

  ImpactFinder& finder_;
  const ConvexShape& shape_T_;
  const MovingTriangle& triangle_;
  std::optional<Direction> guess_;
  double size_;       // of tool and triangle [m]
  double tolerance_;  // [m]
  int directions_ = 0;
  Features features_;
  std::optional<Direction> direction_;  // proves the gap up to the current fraction
};

void ImpactFinder::begin(const ConvexShape& shape_T, const std::vector<Motion>& sub_motions, double margin) {
  assert(!sub_motions.empty());
  assert(margin >= 0.0);
  shape_T_ = &shape_T;
  normals_M_.clear();
  depth_normal_M_.setZero();
  sub_motions_.clear();
  for (const Motion& motion : sub_motions) {
    const Eigen::Vector3d travel_M = motion.X_MT_end.translation() - motion.X_MT_start.translation();
    const Eigen::Matrix3d R_MT = motion.X_MT_start.linear();
    SubMotion shared = {R_MT,
                        R_MT,
                        motion.X_MT_start.translation(),
                        travel_M,
                        margin + motion.deviation_bound,
                        0.0,
                        Eigen::Vector3d::UnitZ(),
                        Eigen::Vector3d::UnitZ(),
                        0.0};
    if (R_MT != motion.X_MT_end.linear()) {
      shared.angle = motion.angle();
      shared.axis_T = motion.axis_T();
      shared.R_MT_end = R_MT * Eigen::AngleAxisd(shared.angle, shared.axis_T).toRotationMatrix();
      shared.axis_M = R_MT * shared.axis_T;
      shared.radius = shape_T.radiusAbout(shared.axis_T);
    }
    sub_motions_.push_back(shared);
  }
}

// Neighbors mostly have the same normal.
double ImpactFinder::depthAtEnd(const MovingTriangle& triangle, const Eigen::Vector3d& normal_M) {
  const SubMotion& last = sub_motions_.back();
  const Eigen::Vector3d normal_T = last.R_MT_end.transpose() * normal_M;
  if (normal_M != depth_normal_M_) {
    depth_normal_M_ = normal_M;
    depth_reach_ = shape_T_->support(-normal_T);
  }
  return std::max(0.0, -Trajectory(*shape_T_, last, triangle, 0.0, 1.0).gap({normal_T, true, depth_reach_}, 1.0));
}

Eigen::Vector3d ImpactFinder::lastNormal() const {
  return normals_M_.empty() ? Eigen::Vector3d::Zero() : normals_M_.back();
}

const Eigen::Vector3d& ImpactFinder::remember(const Eigen::Vector3d& normal_M) {
  if (normals_M_.size() == normals_M_.capacity()) normals_M_.erase(normals_M_.begin());
  normals_M_.push_back(normal_M);
  return normals_M_.back();
}

std::optional<Impact> ImpactFinder::overlapAtStart(const MovingTriangle& triangle,
                                                   const std::optional<Eigen::Vector3d>& contact_normal_M) {
  const PlacedCore tool{*shape_T_, sub_motions_[0].R_MT_start, sub_motions_[0].p_MT_start};
  for (const Eigen::Vector3d& corner : triangle.start_M) {
    if (shape_T_->depthOf(tool.inTool(corner)).depth < 0.0) continue;
    if (contact_normal_M) return Impact{0.0, corner, *contact_normal_M, depthAtEnd(triangle, *contact_normal_M)};
    return Search(*this, triangle, Eigen::Vector3d::Zero()).overlapAt(corner, contact_normal_M);
  }
  return std::nullopt;
}

ImpactFinder::Found ImpactFinder::find(const MovingTriangle& triangle,
                                       const std::optional<Eigen::Vector3d>& contact_normal_M,
                                       const Eigen::Vector3d& guess_M) {
  return Search(*this, triangle, guess_M).run(contact_normal_M);
}

std::optional<Impact> timeOfImpact(const ConvexShape& shape_T, const std::vector<Motion>& sub_motions,
                                   const MovingTriangle& triangle, double margin,
                                   const std::optional<Eigen::Vector3d>& contact_normal_M) {
  ImpactFinder finder;
  finder.begin(shape_T, sub_motions, margin);
  const std::optional<Impact> overlap = finder.overlapAtStart(triangle, contact_normal_M);
  return overlap ? overlap : finder.find(triangle, contact_normal_M).impact;
}

}  // namespace sweep_guard_core
