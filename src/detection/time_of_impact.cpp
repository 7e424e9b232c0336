#include "sweep_guard/detection/time_of_impact.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "geometry/penetration.h"
#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMaxDirections = 1000;
constexpr int kMaxTries = 40;
constexpr double kDrawn = 1e-3;  // of the tool's extent
constexpr double kGain = 0.05;   // of the gap that a direction is worth being followed for

struct PlacedShape {
  const ConvexShape& shape_T;
  Eigen::Matrix3d R_MT;
  Eigen::Vector3d p_MT;

  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction_M) const {
    return p_MT + R_MT * shape_T.supportPoint(R_MT.transpose() * direction_M);
  }
};

// The least of (1 - x) start + x end - curvature x (1 - x) for x in [0, 1].
double leastBetween(double start, double end, double curvature) {
  const double rise = end - start;
  if (std::abs(rise) >= curvature) return std::min(start, end);
  return start - (curvature - rise) * (curvature - rise) / (4.0 * curvature);
}

// Tool and triangle along one part of the motion, by its fraction s. Everything is relative to a corner of the
// triangle at the start, so that places far from the origin of M cost no digits.
class RelativeTrajectory {
 public:
  RelativeTrajectory(const ConvexShape& shape_T, const Motion& part, const MovingTriangle& triangle, double start,
                     double end)
      : shape_T_(shape_T),
        base_M_(triangle.start_M[0]),
        R_MT_(part.X_MT_start.linear()),
        from_(part.X_MT_start.translation() - base_M_),
        travel_(part.X_MT_end.translation() - part.X_MT_start.translation()) {
    if (part.X_MT_start.linear() != part.X_MT_end.linear()) {
      angle_ = part.angle();
      axis_T_ = part.axis_T();
      axis_M_ = R_MT_ * axis_T_;
      radius_ = shape_T.radiusAbout(axis_T_);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d way = triangle.end_M[i] - triangle.start_M[i];
      corners_[i] = triangle.start_M[i] - base_M_ + start * way;
      ways_[i] = (end - start) * way;
    }
  }

  PlacedShape tool(double s) const {
    if (angle_ == 0.0) return {shape_T_, R_MT_, from_ + s * travel_};
    return {shape_T_, R_MT_ * Eigen::AngleAxisd(s * angle_, axis_T_).toRotationMatrix(), from_ + s * travel_};
  }

  std::array<Eigen::Vector3d, 3> corners(double s) const {
    return {corners_[0] + s * ways_[0], corners_[1] + s * ways_[1], corners_[2] + s * ways_[2]};
  }

  // G(s) along a unit direction.
  double gap(const Eigen::Vector3d& n, double s) const {
    const PlacedShape placed = tool(s);
    const double least = n.dot(placed.p_MT) - shape_T_.support(placed.R_MT.transpose() * -n);
    const std::array<Eigen::Vector3d, 3> p = corners(s);
    return least - std::max({n.dot(p[0]), n.dot(p[1]), n.dot(p[2])});
  }

  // How far on from `s`, where the gap along n is `gap`, this direction proves a gap of more than `least`. Looks for
  // where the gap is `aim`, and ends where little is left to gain along n. Returns `s` itself if nothing is proven.
  double advance(const Eigen::Vector3d& n, double s, double gap, double aim, double least) const {
    const double curvature_bound = 0.5 * angle_ * angle_ * radius_ * n.cross(axis_M_).norm();
    const double enough = aim + std::max(aim - least, kGain * (gap - aim));
    double beyond = 1.0;  // not proven, where there is a gap_beyond
    double gap_beyond = kInfinity;
    for (int i = 0; i < kMaxTries && gap > enough && s < beyond; ++i) {
      const double share = gap_beyond < aim ? (gap - aim) / (gap - gap_beyond) : i == 0 ? 1.0 : 0.5;
      const double next = i == 0 ? beyond : s + std::clamp(share, 1e-3, 0.99) * (beyond - s);
      const double gap_next = this->gap(n, next);
      const double step = next - s;
      if (leastBetween(gap, gap_next, curvature_bound * step * step) > least) {
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
  double farthest() const { return std::max(from_.norm(), (from_ + travel_).norm()); }

 private:
  const ConvexShape& shape_T_;
  Eigen::Vector3d base_M_;
  Eigen::Matrix3d R_MT_;
  Eigen::Vector3d from_;
  Eigen::Vector3d travel_;
  double angle_ = 0.0;
  Eigen::Vector3d axis_T_ = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d axis_M_ = Eigen::Vector3d::UnitZ();
  double radius_ = 0.0;
  std::array<Eigen::Vector3d, 3> corners_;
  std::array<Eigen::Vector3d, 3> ways_;
};

struct Touch {
  double fraction;
  Separation separation;
};

double diameter(const std::array<Eigen::Vector3d, 3>& p) {
  return std::sqrt(std::max({(p[1] - p[0]).squaredNorm(), (p[2] - p[1]).squaredNorm(), (p[0] - p[2]).squaredNorm()}));
}

// The face normal, the tool's axes, and what is orthogonal to an axis and an edge; both ways each.
Proposals proposals(const Eigen::Matrix3d& R_MT, const std::array<Eigen::Vector3d, 3>& corners) {
  Proposals directions;
  const auto propose = [&](const Eigen::Vector3d& direction) {
    const double length = direction.norm();
    if (!(length > 1e-12)) return;
    directions.push_back(direction / length);
    directions.push_back(-direction / length);
  };
  for (int i = 0; i < 3; ++i) propose(R_MT.col(i));
  const std::array<Eigen::Vector3d, 3> edges = {(corners[1] - corners[0]).normalized(),
                                                (corners[2] - corners[1]).normalized(),
                                                (corners[0] - corners[2]).normalized()};
  propose(edges[0].cross(edges[1]));
  for (const Eigen::Vector3d& edge : edges) {
    for (int i = 0; i < 3; ++i) propose(edge.cross(R_MT.col(i)));
  }
  return directions;
}

class TimeOfImpactSearch {
 public:
  TimeOfImpactSearch(const ConvexShape& shape_T, const std::vector<Motion>& parts, const MovingTriangle& triangle,
                     double margin)
      : shape_T_(shape_T), parts_(parts), triangle_(triangle), margin_(margin) {
    size_ = shape_T.boundingRadius() + std::max(diameter(triangle.start_M), diameter(triangle.end_M));
    const RelativeTrajectory first = trajectory(0);
    const RelativeTrajectory last = trajectory(parts.size() - 1);
    // The poses themselves have been rounded, as far from the origin of M as they are.
    tolerance_ = 2e-9 * size_ + 1e-14 * (first.base_M().norm() + std::max(first.farthest(), last.farthest()));
  }

  std::optional<Impact> run(const std::optional<Eigen::Vector3d>& contact_normal_M) {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const RelativeTrajectory part = trajectory(i);
      const std::optional<Touch> touch = firstTouch(part, margin_ + parts_[i].deviation_bound);
      if (!touch) continue;
      const bool overlaps = i == 0 && touch->fraction == 0.0 && touch->separation.gap <= 0.0;
      const Eigen::Vector3d normal = !overlaps          ? touch->separation.normal
                                     : contact_normal_M ? *contact_normal_M
                                                        : minimumTranslationAtStart(part);
      const double time = (static_cast<double>(i) + touch->fraction) / static_cast<double>(parts_.size());
      const double depth = std::max(0.0, -trajectory(parts_.size() - 1).gap(normal, 1.0));
      return Impact{time, part.base_M() + touch->separation.on_obstacle, normal, depth};
    }
    return std::nullopt;
  }

 private:
  RelativeTrajectory trajectory(std::size_t part) const {
    const auto count = static_cast<double>(parts_.size());
    const auto i = static_cast<double>(part);
    return {shape_T_, parts_[part], triangle_, i / count, (i + 1.0) / count};
  }

  std::optional<Touch> firstTouch(const RelativeTrajectory& part, double margin) {
    double s = 0.0;
    double gap = normal_ ? part.gap(*normal_, s) : -kInfinity;
    while (true) {
      if (gap <= margin + tolerance_) {
        const Separation apart = separationAt(part, s, margin);
        if (apart.gap <= margin + tolerance_ || ++directions_ > kMaxDirections) break;
        normal_ = apart.normal;
        gap = apart.gap;
      }
      const double next = part.advance(*normal_, s, gap, margin + 0.5 * tolerance_, margin + 0.25 * tolerance_);
      if (next == 1.0) return std::nullopt;
      if (next == s) break;
      s = next;
      gap = -kInfinity;
    }
    return Touch{s, exactSeparationAt(part, s)};
  }

  // Exact enough to go on in time, or where it is this close.
  Separation separationAt(const RelativeTrajectory& part, double s, double margin) const {
    const PlacedShape tool = part.tool(s);
    return roughSeparation(tool, PointHull(part.corners(s)), margin, 0.25 * tolerance_, normal_.value_or(tool.p_MT));
  }

  // The direction of a distance that is next to nothing has few digits. So the tool is drawn out along it a little:
  // what the direction was wrong by shrinks as that way is shorter than the tool's radius of curvature.
  Separation exactSeparationAt(const RelativeTrajectory& part, double s) const {
    const PlacedShape tool = part.tool(s);
    const PointHull triangle(part.corners(s));
    Separation touch = separation(tool, triangle, 0.0, normal_.value_or(tool.p_MT));
    if (touch.gap <= 0.0) return touch;
    PlacedShape drawn = tool;
    drawn.p_MT += kDrawn * (shape_T_.boundingRadius() > 0.0 ? shape_T_.boundingRadius() : size_) * touch.normal;
    touch.normal = separation(drawn, triangle, 0.0, touch.normal).normal;
    return touch;
  }

  Eigen::Vector3d minimumTranslationAtStart(const RelativeTrajectory& part) const {
    const PlacedShape tool = part.tool(0.0);
    const std::array<Eigen::Vector3d, 3> corners = part.corners(0.0);
    return minimumTranslationDirection(tool, PointHull(corners), proposals(tool.R_MT, corners), std::max(size_, 1e-12));
  }

  const ConvexShape& shape_T_;
  const std::vector<Motion>& parts_;
  const MovingTriangle& triangle_;
  double margin_;
  double size_;       // of tool and triangle [m]
  double tolerance_;  // [m]
  int directions_ = 0;
  std::optional<Eigen::Vector3d> normal_;  // proves the gap so far
};

}  // namespace

std::optional<Impact> timeOfImpact(const ConvexShape& shape_T, const std::vector<Motion>& parts,
                                   const MovingTriangle& triangle, double margin,
                                   const std::optional<Eigen::Vector3d>& contact_normal_M) {
  assert(!parts.empty());
  assert(margin >= 0.0);
  return TimeOfImpactSearch(shape_T, parts, triangle, margin).run(contact_normal_M);
}

}  // namespace sweep_guard_core
