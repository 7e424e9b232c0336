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
constexpr double kOffset = 1e-3;  // of the tool's bounding radius
constexpr double kGain = 0.05;    // of the gap; a direction that gains less is not followed on

struct PlacedShape {
  const ConvexShape& shape_T;
  Eigen::Matrix3d R_MT;
  Eigen::Vector3d p_MT;

  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction_M) const {
    return p_MT + R_MT * shape_T.supportPoint(R_MT.transpose() * direction_M);
  }
};

// Returns the minimum of (1 - x) start + x end - curvature x (1 - x) for x in [0, 1].
double lowerBound(double start, double end, double curvature) {
  const double rise = end - start;
  if (std::abs(rise) >= curvature) return std::min(start, end);
  return start - (curvature - rise) * (curvature - rise) / (4.0 * curvature);
}

// Evaluates tool and triangle at a fraction s of one sub-motion. All positions are relative to a corner of the triangle
// at the start, so that no digits are lost far from the origin of M.
class RelativeTrajectory {
 public:
  RelativeTrajectory(const ConvexShape& shape_T, const Motion& sub_motion, const MovingTriangle& triangle, double start,
                     double end)
      : shape_T_(shape_T),
        base_M_(triangle.start_M[0]),
        R_MT_(sub_motion.X_MT_start.linear()),
        from_(sub_motion.X_MT_start.translation() - base_M_),
        travel_(sub_motion.X_MT_end.translation() - sub_motion.X_MT_start.translation()) {
    if (sub_motion.X_MT_start.linear() != sub_motion.X_MT_end.linear()) {
      angle_ = sub_motion.angle();
      axis_T_ = sub_motion.axis_T();
      axis_M_ = R_MT_ * axis_T_;
      radius_ = shape_T.radiusAbout(axis_T_);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d displacement = triangle.end_M[i] - triangle.start_M[i];
      corners_[i] = triangle.start_M[i] - base_M_ + start * displacement;
      displacements_[i] = (end - start) * displacement;
    }
  }

  PlacedShape tool(double s) const {
    if (angle_ == 0.0) return {shape_T_, R_MT_, from_ + s * travel_};
    return {shape_T_, R_MT_ * Eigen::AngleAxisd(s * angle_, axis_T_).toRotationMatrix(), from_ + s * travel_};
  }

  std::array<Eigen::Vector3d, 3> corners(double s) const {
    return {corners_[0] + s * displacements_[0], corners_[1] + s * displacements_[1],
            corners_[2] + s * displacements_[2]};
  }

  // Returns G(s) along a unit direction.
  double gap(const Eigen::Vector3d& n, double s) const {
    const PlacedShape placed = tool(s);
    const double least = n.dot(placed.p_MT) - shape_T_.support(placed.R_MT.transpose() * -n);
    const std::array<Eigen::Vector3d, 3> p = corners(s);
    return least - std::max({n.dot(p[0]), n.dot(p[1]), n.dot(p[2])});
  }

  // Returns up to which fraction, from `s` on with gap `gap`, direction n proves a gap larger than `least`. Searches
  // for the fraction where the gap is `aim`, and stops when little can be gained along n. Returns `s` if nothing is
  // proven.
  double advance(const Eigen::Vector3d& n, double s, double gap, double aim, double least) const {
    const double curvature_bound = 0.5 * angle_ * angle_ * radius_ * n.cross(axis_M_).norm();
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
  double maxDistance() const { return std::max(from_.norm(), (from_ + travel_).norm()); }

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
  std::array<Eigen::Vector3d, 3> displacements_;
};

struct Touch {
  double fraction;
  Separation separation;
};

double diameter(const std::array<Eigen::Vector3d, 3>& p) {
  return std::sqrt(std::max({(p[1] - p[0]).squaredNorm(), (p[2] - p[1]).squaredNorm(), (p[0] - p[2]).squaredNorm()}));
}

// Returns the face normal, the tool's axes, and the normals to one axis and one edge, in both directions.
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
  TimeOfImpactSearch(const ConvexShape& shape_T, const std::vector<Motion>& sub_motions, const MovingTriangle& triangle,
                     double margin)
      : shape_T_(shape_T), sub_motions_(sub_motions), triangle_(triangle), margin_(margin) {
    size_ = shape_T.boundingRadius() + std::max(diameter(triangle.start_M), diameter(triangle.end_M));
    const RelativeTrajectory first = trajectoryOf(0);
    const RelativeTrajectory last = trajectoryOf(sub_motions.size() - 1);
    // The poses have been rounded relative to their distance from the origin of M.
    tolerance_ = 2e-9 * size_ + 1e-14 * (first.base_M().norm() + std::max(first.maxDistance(), last.maxDistance()));
  }

  std::optional<Impact> run(const std::optional<Eigen::Vector3d>& contact_normal_M) {
    for (std::size_t i = 0; i < sub_motions_.size(); ++i) {
      const RelativeTrajectory trajectory = trajectoryOf(i);
      const std::optional<Touch> touch = firstTouch(trajectory, margin_ + sub_motions_[i].deviation_bound);
      if (!touch) continue;
      const bool overlaps = i == 0 && touch->fraction == 0.0 && touch->separation.gap <= 0.0;
      const Eigen::Vector3d normal = !overlaps          ? touch->separation.normal
                                     : contact_normal_M ? *contact_normal_M
                                                        : minimumTranslationAtStart(trajectory);
      const double time = (static_cast<double>(i) + touch->fraction) / static_cast<double>(sub_motions_.size());
      const double depth = std::max(0.0, -trajectoryOf(sub_motions_.size() - 1).gap(normal, 1.0));
      return Impact{time, trajectory.base_M() + touch->separation.on_obstacle, normal, depth};
    }
    return std::nullopt;
  }

 private:
  RelativeTrajectory trajectoryOf(std::size_t sub_motion) const {
    const auto count = static_cast<double>(sub_motions_.size());
    const auto i = static_cast<double>(sub_motion);
    return {shape_T_, sub_motions_[sub_motion], triangle_, i / count, (i + 1.0) / count};
  }

  std::optional<Touch> firstTouch(const RelativeTrajectory& trajectory, double margin) {
    double s = 0.0;
    double gap = normal_ ? trajectory.gap(*normal_, s) : -kInfinity;
    while (true) {
      if (gap <= margin + tolerance_) {
        const Separation apart = separationAt(trajectory, s, margin);
        if (apart.gap <= margin + tolerance_ || ++directions_ > kMaxDirections) break;
        normal_ = apart.normal;
        gap = apart.gap;
      }
      const double next = trajectory.advance(*normal_, s, gap, margin + 0.5 * tolerance_, margin + 0.25 * tolerance_);
      if (next == 1.0) return std::nullopt;
      if (next == s) break;
      s = next;
      gap = -kInfinity;
    }
    return Touch{s, exactSeparationAt(trajectory, s)};
  }

  // Returns a separation that is exact enough to advance, or if the gap is this small.
  Separation separationAt(const RelativeTrajectory& trajectory, double s, double margin) const {
    const PlacedShape tool = trajectory.tool(s);
    return roughSeparation(tool, PointHull(trajectory.corners(s)), margin, 0.25 * tolerance_,
                           normal_.value_or(tool.p_MT));
  }

  // The direction of a tiny distance has few exact digits. The tool is therefore moved away along it by a little: the
  // error of the direction shrinks by the ratio of this distance to the tool's radius of curvature.
  Separation exactSeparationAt(const RelativeTrajectory& trajectory, double s) const {
    const PlacedShape tool = trajectory.tool(s);
    const PointHull triangle(trajectory.corners(s));
    Separation touch = separation(tool, triangle, 0.0, normal_.value_or(tool.p_MT));
    if (touch.gap <= 0.0) return touch;
    PlacedShape moved = tool;
    moved.p_MT += kOffset * (shape_T_.boundingRadius() > 0.0 ? shape_T_.boundingRadius() : size_) * touch.normal;
    touch.normal = separation(moved, triangle, 0.0, touch.normal).normal;
    return touch;
  }

  Eigen::Vector3d minimumTranslationAtStart(const RelativeTrajectory& trajectory) const {
    const PlacedShape tool = trajectory.tool(0.0);
    const std::array<Eigen::Vector3d, 3> corners = trajectory.corners(0.0);
    return minimumTranslationDirection(tool, PointHull(corners), proposals(tool.R_MT, corners), std::max(size_, 1e-12));
  }

  const ConvexShape& shape_T_;
  const std::vector<Motion>& sub_motions_;
  const MovingTriangle& triangle_;
  double margin_;
  double size_;       // of tool and triangle [m]
  double tolerance_;  // [m]
  int directions_ = 0;
  std::optional<Eigen::Vector3d> normal_;  // proves the gap up to the current fraction
};

}  // namespace

std::optional<Impact> timeOfImpact(const ConvexShape& shape_T, const std::vector<Motion>& sub_motions,
                                   const MovingTriangle& triangle, double margin,
                                   const std::optional<Eigen::Vector3d>& contact_normal_M) {
  assert(!sub_motions.empty());
  assert(margin >= 0.0);
  return TimeOfImpactSearch(shape_T, sub_motions, triangle, margin).run(contact_normal_M);
}

}  // namespace sweep_guard_core
