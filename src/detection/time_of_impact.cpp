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
constexpr double kGain = 0.05;       // of the gap; a direction that gains less is not followed on

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

  // Returns G(s) along a unit direction.
  double gap(const Eigen::Vector3d& n, double s) const {
    const PlacedCore placed = tool(s);
    const double least = n.dot(placed.p_MT) - shape_T_.support(placed.R_MT.transpose() * -n);
    const std::array<Eigen::Vector3d, 3> p = corners(s);
    return least - std::max({n.dot(p[0]), n.dot(p[1]), n.dot(p[2])});
  }

  // Returns up to which fraction, from `s` on with gap `gap`, direction n proves a gap larger than `least`. Searches
  // for the fraction where the gap is `aim`, and stops when little can be gained along n. Returns `s` if nothing is
  // proven.
  double advance(const Eigen::Vector3d& n, double s, double gap, double aim, double least) const {
    const double curvature_bound =
        0.5 * motion_.angle * motion_.angle * motion_.radius * n.cross(motion_.axis_M).norm();
    const double enough = aim + std::max(aim - least, kGain * (gap - aim));
    double beyond = 1.0;  // not proven if gap_beyond is finite
    double gap_beyond = kInfinity;
    for (int i = 0; i < kMaxTries && gap > enough && s < beyond; ++i) {
      const double share = gap_beyond < aim ? (gap - aim) / (gap - gap_beyond) : i == 0 ? 1.0 : 0.5;
      const double next = i == 0 ? beyond : s + std::clamp(share, 1e-3, 0.99) * (beyond - s);
      const double gap_next = this->gap(n, next);
      const double step = next - s;
      if (lowerBound(gap, gap_next, curvature_bound * step * step) > least) {
        s = next;
        gap = gap_next;
      } else {
        beyond = next;
        gap_beyond = gap_next;
      }
    }
    return s;
  }

  const Eigen::Vector3d& base_M() const { return base_M_; }
  double maxDistance() const { return std::max(from_.norm(), (from_ + motion_.travel_M).norm()); }

 private:
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
      : finder_(finder),
        shape_T_(*finder.shape_T_),
        triangle_(triangle),
        guess_T_(finder.sub_motions_[0].R_MT_start.transpose() * guess_M) {
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
        finder_.separating_M_ = *normal_;
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
    double s = 0.0;
    bool stuck = false;  // no known direction proves anything from here on
    while (true) {
      const bool try_known = !stuck && (s == 0.0 || directions_ < kMaxKnown);
      const Known known = try_known ? bestKnown(trajectory, s) : Known{};
      double gap = known.gap;
      const bool computed = gap <= margin + tolerance_;
      if (!computed) {
        normal_ = known.direction;
      } else {
        const bool close = gap > margin;
        if (const auto touch = close ? cornerTouchAt(trajectory, s, known) : std::nullopt) return touch;
        const Separation apart = close ? exactSeparationAt(trajectory, s) : separationAt(trajectory, s, margin);
        if (overlapping(apart)) return Touch{s, apart};
        const bool touches = apart.gap <= margin + tolerance_;
        if (touches) return touchAt(trajectory, s, close ? apart : exactSeparationAt(trajectory, s));
        normal_ = apart.normal;
        gap = apart.gap;
      }
      const double next = trajectory.advance(*normal_, s, gap, margin + 0.5 * tolerance_, margin + 0.25 * tolerance_);
      if (next == 1.0) return std::nullopt;
      stuck = next == s;
      if ((stuck && computed) || ++directions_ > kMaxDirections) {
        return touchAt(trajectory, next, exactSeparationAt(trajectory, next));
      }
      s = next;
    }
  }

  struct Known {
    Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
    double gap = -kInfinity;
  };

  // Returns the direction followed so far or the guess, which turns with the tool: the one with the larger gap.
  Known bestKnown(const Trajectory& trajectory, double s) const {
    Known best;
    if (normal_) best = {*normal_, trajectory.gap(*normal_, s)};
    if (guess_T_.isZero(0.0)) return best;
    const Eigen::Vector3d guess = trajectory.tool(s).R_MT * guess_T_;
    const double gap = trajectory.gap(guess, s);
    return gap > best.gap ? Known{guess, gap} : best;
  }

  // If a corner is just as far from the tool as the gap along a direction, that is the direction of the closest points.
  std::optional<Touch> cornerTouchAt(const Trajectory& trajectory, double s, const Known& known) const {
    const auto& [direction, gap] = known;
    const Eigen::Vector3d corner = PointHull(trajectory.corners(s)).supportPoint(direction);
    const Eigen::Vector3d on_tool = corner + (gap + shape_T_.padding() + kRounding * size_) * direction;
    if (shape_T_.depthOf(trajectory.tool(s).inTool(on_tool)).depth < shape_T_.padding()) return std::nullopt;
    return Touch{s, {direction, gap, on_tool, corner}};
  }

  bool overlapping(const Separation& apart) const {
    return apart.gap <= 0.0 && (apart.on_tool - apart.on_obstacle).norm() <= shape_T_.padding() + kRounding * size_;
  }

  Eigen::Vector3d initialDirection(const PlacedCore& tool) const {
    return normal_ ? *normal_ : guess_T_.isZero(0.0) ? tool.p_MT : tool.R_MT * guess_T_;
  }

  // Returns a separation that is exact enough to advance, or if the gap is this small. The gap is that of the padded piece.
  Separation separationAt(const Trajectory& trajectory, double s, double margin) const {
    const PlacedCore tool = trajectory.tool(s);
    Separation apart = roughSeparation(tool, PointHull(trajectory.corners(s)), margin + shape_T_.padding(),
                                       0.25 * tolerance_, initialDirection(tool));
    apart.gap -= shape_T_.padding();
    return apart;
  }

  Separation exactSeparationAt(const Trajectory& trajectory, double s) const {
    const PlacedCore tool = trajectory.tool(s);
    Separation apart = separation(tool, PointHull(trajectory.corners(s)), 0.0, initialDirection(tool));
    apart.gap -= shape_T_.padding();
    return apart;
  }

  // The direction of a tiny distance has few exact digits. The tool is therefore moved away along it by a little: the
  // error of the direction shrinks by the ratio of this distance to the tool's radius of curvature.
  Touch touchAt(const Trajectory& trajectory, double s, Separation exact) const {
    const double distance = exact.gap + shape_T_.padding();
    const double offset = kOffset * (shape_T_.boundingRadius() > 0.0 ? shape_T_.boundingRadius() : size_);
    if (distance > 0.0 && distance < offset) {
      PlacedCore moved = trajectory.tool(s);
      moved.p_MT += offset * exact.normal;
      exact.normal = separation(moved, PointHull(trajectory.corners(s)), 0.0, exact.normal).normal;
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
  Eigen::Vector3d guess_T_;  // zero for none
  double size_;              // of tool and triangle [m]
  double tolerance_;         // [m]
  int directions_ = 0;
  std::optional<Eigen::Vector3d> normal_;  // proves the gap up to the current fraction
};

void ImpactFinder::begin(const ConvexShape& shape_T, const std::vector<Motion>& sub_motions, double margin) {
  assert(!sub_motions.empty());
  assert(margin >= 0.0);
  shape_T_ = &shape_T;
  separating_M_.setZero();
  normals_M_.clear();
  next_normal_ = 0;
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

double ImpactFinder::depthAtEnd(const MovingTriangle& triangle, const Eigen::Vector3d& normal_M) const {
  return std::max(0.0, -Trajectory(*shape_T_, sub_motions_.back(), triangle, 0.0, 1.0).gap(normal_M, 1.0));
}

Eigen::Vector3d ImpactFinder::lastNormal() const {
  return normals_M_.empty() ? Eigen::Vector3d::Zero() : normals_M_[(next_normal_ + kNormals - 1) % kNormals];
}

const Eigen::Vector3d& ImpactFinder::remember(const Eigen::Vector3d& normal_M) {
  if (normals_M_.size() < kNormals) normals_M_.emplace_back();
  Eigen::Vector3d& place = normals_M_[next_normal_];
  next_normal_ = (next_normal_ + 1) % kNormals;
  return place = normal_M;
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
