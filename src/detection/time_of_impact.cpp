#include "sweep_guard/detection/time_of_impact.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>

#include "geometry/penetration.h"
#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMaxDirections = 1000;
constexpr int kMaxKnown = 8;  // of these that need not be the direction of the closest points
constexpr int kMaxTries = 40;
constexpr double kOffset = 1e-3;     // of the tool's bounding radius
constexpr double kRounding = 2e-15;  // of the size
constexpr double kMinGap = 1e-6;     // of the size; the direction of a smaller one has few exact digits

// A piece at a pose, without its padding: GJK needs fewer steps for a segment than for a capsule, and the direction to it has
// more exact digits.
struct PlacedCore {
  const ConvexShape& shape_T;
  Eigen::Matrix3d R_MT;
  Eigen::Vector3d p_MT;

  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction_M) const {
    return p_MT + R_MT * shape_T.coreSupportPoint(R_MT.transpose() * direction_M);
  }

  Eigen::Vector3d inTool(const Eigen::Vector3d& p_M) const { return R_MT.transpose() * (p_M - p_MT); }

  // Returns whether this, moved out of a triangle by its depth along a normal, touches a corner, up to a tolerance [m].
  bool touchesACorner(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& normal, double depth,
                      double tolerance) const {
    const double reach = std::max({normal.dot(corners[0]), normal.dot(corners[1]), normal.dot(corners[2])});
    return std::any_of(corners.begin(), corners.end(), [&](const Eigen::Vector3d& corner) {
      const Eigen::Vector3d p = corner - (depth - tolerance) * normal;
      return normal.dot(corner) > reach - tolerance && shape_T.depthOf(inTool(p)).depth >= shape_T.padding();
    });
  }

  Eigen::Vector3d proposeNormal(const std::array<Eigen::Vector3d, 3>& corners) const {
    return R_MT * shape_T.proposeNormal({inTool(corners[0]), inTool(corners[1]), inTool(corners[2])});
  }
};

// Returns the minimum of (1 - x) start + x end - curvature x (1 - x) for x in [0, 1].
double lowerBound(double start, double end, double curvature) {
  const double rise = end - start;
  if (std::abs(rise) >= curvature) return std::min(start, end);
  return start - (curvature - rise) * (curvature - rise) / (4.0 * curvature);
}

// A direction along which the gap is followed in time: fixed in M, or in T, where the piece reaches equally far along it.
struct Direction {
  Eigen::Vector3d unit;  // in T if it turns, else in M
  bool turns;
  double reach;  // support of the piece against a direction that turns [m]

  Eigen::Vector3d at(const PlacedCore& tool) const { return turns ? tool.R_MT * unit : unit; }

  bool operator==(const Direction& other) const { return turns == other.turns && unit == other.unit; }
};

Direction fixed(const Eigen::Vector3d& direction_M) { return {direction_M, false, 0.0}; }

Direction turning(const ConvexShape& shape_T, const Eigen::Vector3d& direction_T) {
  return {direction_T, true, shape_T.support(-direction_T)};
}

// The gap at a fraction of a sub-motion.
struct Gap {
  double fraction;
  double gap;   // [m]
  double rate;  // decrease per fraction, 0 if unknown [m]
};

// The points of piece and triangle that are next to each other, fixed to both.
class Features {
 public:
  Features() = default;
  Features(const PointPairs& points, const PlacedCore& tool, const std::array<Eigen::Vector3d, 3>& corners) {
    for (const auto& [on_tool, on_obstacle] : points) {
      const auto corner = std::find(corners.begin(), corners.end(), on_obstacle);
      assert(corner != corners.end());
      features_.push_back({tool.inTool(on_tool), static_cast<size_t>(corner - corners.begin())});
    }
  }

  PointPairs at(const PlacedCore& tool, const std::array<Eigen::Vector3d, 3>& corners) const {
    PointPairs points;
    for (const auto& [p_T, corner] : features_) points.push_back({tool.p_MT + tool.R_MT * p_T, corners[corner]});
    return points;
  }

  bool ofOneCorner() const {
    return std::all_of(features_.begin(), features_.end(),
                       [&](const Feature& feature) { return feature.corner == features_.front().corner; });
  }

 private:
  struct Feature {
    Eigen::Vector3d p_T;
    size_t corner;
  };
  boost::container::static_vector<Feature, 4> features_;
};

// Returns the share of the way that uses up a gap at this rate, if it is known and high enough.
double shareOf(double way, double gap, double rate, double otherwise) {
  return rate * way > gap ? std::clamp(gap / (rate * way), 1e-5, 0.99) : otherwise;
}

struct Touch {
  double fraction;
  Separation separation;
};

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

// Evaluates tool and triangle at a fraction s of one sub-motion. All positions are relative to a corner of the triangle
// at the start, so that no digits are lost far from the origin of M.
class ImpactFinder::Trajectory {
 public:
  Trajectory(const ConvexShape& shape_T, const SubMotion& sub_motion, const MovingTriangle& triangle, double start,
             double end)
      : shape_T_(shape_T), motion_(sub_motion), base_M_(triangle.start_M[0]), from_(sub_motion.p_MT_start - base_M_) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d displacement = triangle.end_M[i] - triangle.start_M[i];
      corners_[i] = triangle.start_M[i] - base_M_ + start * displacement;
      displacements_[i] = (end - start) * displacement;
    }
  }

  PlacedCore tool(double s) const {
    if (s == 0.0) return {shape_T_, motion_.R_MT_start, from_};
    if (s == 1.0 || motion_.angle == 0.0) return {shape_T_, motion_.R_MT_end, from_ + s * motion_.travel_M};
    const Eigen::AngleAxisd turn(s * motion_.angle, motion_.axis_T);
    return {shape_T_, motion_.R_MT_start * turn.toRotationMatrix(), from_ + s * motion_.travel_M};
  }

  std::array<Eigen::Vector3d, 3> corners(double s) const {
    return {corners_[0] + s * displacements_[0], corners_[1] + s * displacements_[1],
            corners_[2] + s * displacements_[2]};
  }

  Eigen::Vector3d inMesh(const Direction& direction, double s) const { return direction.at(tool(s)); }

  // Returns G(s) along a direction.
  double gap(const Direction& direction, double s) const {
    const PlacedCore placed = tool(s);
    const Eigen::Vector3d n = direction.at(placed);
    const double reach = direction.turns ? direction.reach : shape_T_.support(placed.R_MT.transpose() * -n);
    const std::array<Eigen::Vector3d, 3> p = corners(s);
    return n.dot(placed.p_MT) - reach - std::max({n.dot(p[0]), n.dot(p[1]), n.dot(p[2])});
  }

  // Advances from a fraction up to which a gap larger than `least` is proven along the direction. Searches for the fraction
  // where the gap is `aim`.
  void advance(const Direction& direction, double aim, double least, Gap& at) const {
    const double curvature = curvatureBound(direction);
    const double enough = aim + (aim - least);
    double beyond = 1.0;  // not proven if gap_beyond is finite
    double gap_beyond = kInfinity;
    for (int i = 0; i < kMaxTries && at.gap > enough && at.fraction < beyond; ++i) {
      const double rate = gap_beyond < aim ? (at.gap - gap_beyond) / (beyond - at.fraction) : at.rate;
      const double share = shareOf(beyond - at.fraction, at.gap - aim, rate, gap_beyond < kInfinity ? 0.5 : 1.0);
      const double next = share == 1.0 ? beyond : at.fraction + share * (beyond - at.fraction);
      const double gap_next = gap(direction, next);
      const double step = next - at.fraction;
      at.rate = (at.gap - gap_next) / step;
      if (lowerBound(at.gap, gap_next, curvature * step * step) > least) {
        at.fraction = next;
        at.gap = gap_next;
      } else {
        beyond = next;
        gap_beyond = gap_next;
      }
    }
  }

  const Eigen::Vector3d& base_M() const { return base_M_; }
  double maxDistance() const { return std::max(from_.norm(), (from_ + motion_.travel_M).norm()); }

 private:
  // Returns half the bound of |G''|.
  double curvatureBound(const Direction& direction) const {
    if (motion_.angle == 0.0) return 0.0;
    const Eigen::Vector3d& axis = direction.turns ? motion_.axis_T : motion_.axis_M;
    const double rate = motion_.angle * direction.unit.cross(axis).norm();
    if (!direction.turns) return 0.5 * rate * motion_.angle * motion_.radius;
    return 0.5 * rate * (motion_.angle * farthestCorner() + 2.0 * fastestCorner());
  }

  // Relative to the origin of T.
  double farthestCorner() const {
    double farthest = 0.0;
    for (size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d start = corners_[i] - from_;
      farthest = std::max({farthest, start.norm(), (start + displacements_[i] - motion_.travel_M).norm()});
    }
    return farthest;
  }

  double fastestCorner() const {
    double fastest = 0.0;
    for (const Eigen::Vector3d& displacement : displacements_) {
      fastest = std::max(fastest, (displacement - motion_.travel_M).norm());
    }
    return fastest;
  }

  const ConvexShape& shape_T_;
  const SubMotion& motion_;
  Eigen::Vector3d base_M_;
  Eigen::Vector3d from_;
  std::array<Eigen::Vector3d, 3> corners_;
  std::array<Eigen::Vector3d, 3> displacements_;
};

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

  std::optional<Impact> run(const std::optional<Eigen::Vector3d>& contact_normal_M) {
    finder_.separating_M_.setZero();
    for (std::size_t i = 0; i < count(); ++i) {
      const Trajectory trajectory = trajectoryOf(i);
      const std::optional<Touch> touch = firstTouch(trajectory, finder_.sub_motions_[i].margin);
      if (!touch) {
        finder_.separating_M_ = trajectory.inMesh(*direction_, 0.0);
        continue;
      }
      const Eigen::Vector3d point_M = trajectory.base_M() + touch->separation.on_obstacle;
      const bool overlaps = i == 0 && touch->fraction == 0.0 && touch->separation.gap <= 0.0;
      if (overlaps) return overlapAt(point_M, contact_normal_M);
      const double time = (static_cast<double>(i) + touch->fraction) / static_cast<double>(count());
      const Eigen::Vector3d& normal = touch->separation.normal;
      const Eigen::Vector3d normal_T = trajectory.tool(touch->fraction).R_MT.transpose() * normal;
      finder_.separating_M_ = finder_.sub_motions_[0].R_MT_start * normal_T;
      return Impact{time, point_M, normal, finder_.depthAtEnd(triangle_, normal)};
    }
    return std::nullopt;
  }

 private:
  std::size_t count() const { return finder_.sub_motions_.size(); }

  Trajectory trajectoryOf(std::size_t sub_motion) const {
    const auto all = static_cast<double>(count());
    const auto i = static_cast<double>(sub_motion);
    return {shape_T_, finder_.sub_motions_[sub_motion], triangle_, i / all, (i + 1.0) / all};
  }

  std::optional<Touch> firstTouch(const Trajectory& trajectory, double margin) {
    Gap at = {0.0, direction_ ? trajectory.gap(*direction_, 0.0) : -kInfinity, 0.0};
    bool stuck = false;  // no known direction proves anything from here on
    while (true) {
      const bool try_known = !stuck && directions_ < kMaxKnown;
      if (try_known) tryGuess(trajectory, at);
      const bool near = at.gap <= margin + tolerance_;
      const bool computed = near || !try_known;
      if (computed) {
        const bool close = near && at.gap > margin;
        if (const auto touch = close ? cornerTouchAt(trajectory, at) : std::nullopt) return touch;
        const Separation apart = separationAt(trajectory, at.fraction, margin);
        if (overlapping(apart)) return Touch{at.fraction, apart};
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
    return may_turn && features_.ofOneCorner() ? turning(shape_T_, tool.R_MT.transpose() * normal) : fixed(normal);
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
  std::optional<Touch> cornerTouchAt(const Trajectory& trajectory, const Gap& at) const {
    const double s = at.fraction;
    const Eigen::Vector3d direction = trajectory.inMesh(*direction_, s);
    const Eigen::Vector3d corner = PointHull(trajectory.corners(s)).supportPoint(direction);
    const Eigen::Vector3d on_tool = corner + (at.gap + shape_T_.padding() + kRounding * size_) * direction;
    if (shape_T_.depthOf(trajectory.tool(s).inTool(on_tool)).depth < shape_T_.padding()) return std::nullopt;
    return Touch{s, {direction, at.gap, on_tool, corner, {}}};
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
                                       initialDirection(tool), features_.at(tool, corners));
    features_ = {apart.simplex, tool, corners};
    apart.gap -= shape_T_.padding();
    return apart;
  }

  Separation exactSeparationAt(const Trajectory& trajectory, double s) {
    const PlacedCore tool = trajectory.tool(s);
    const std::array<Eigen::Vector3d, 3> corners = trajectory.corners(s);
    Separation apart = separation(tool, PointHull(corners), 0.0, initialDirection(tool), features_.at(tool, corners));
    features_ = {apart.simplex, tool, corners};
    apart.gap -= shape_T_.padding();
    return apart;
  }

  // The direction of a tiny distance has few exact digits. The tool is therefore moved away along it by a little: the
  // error of the direction shrinks by the ratio of this distance to the tool's radius of curvature.
  Touch touchAt(const Trajectory& trajectory, double s, Separation exact) {
    const double distance = exact.gap + shape_T_.padding();
    const double offset = kOffset * (shape_T_.boundingRadius() > 0.0 ? shape_T_.boundingRadius() : size_);
    if (distance > 0.0 && distance < offset) {
      PlacedCore moved = trajectory.tool(s);
      moved.p_MT += offset * exact.normal;
      const std::array<Eigen::Vector3d, 3> corners = trajectory.corners(s);
      exact.normal = separation(moved, PointHull(corners), 0.0, exact.normal, features_.at(moved, corners)).normal;
    }
    return {s, exact};
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
  separating_M_.setZero();
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

std::optional<Impact> ImpactFinder::find(const MovingTriangle& triangle,
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
  return overlap ? overlap : finder.find(triangle, contact_normal_M);
}

}  // namespace sweep_guard_core
