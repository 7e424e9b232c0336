#include "detection/trajectory.h"

#include <cmath>

#include "common/floating_point.h"

namespace sweep_guard_core {
namespace {

constexpr int kMaxTries = 40;

// Returns the minimum of (1 - x) start + x end - curvature x (1 - x) for x in [0, 1].
double lowerBound(double start, double end, double curvature) {
  const double rise = end - start;
  if (std::abs(rise) >= curvature) return std::min(start, end);
  return start - (curvature - rise) * (curvature - rise) / (4.0 * curvature);
}

// Returns the share of the remaining motion that uses up a gap at this rate, if it is known and high enough.
double shareOf(double rest, double gap, double rate, double otherwise) {
  return rate * rest > gap ? std::clamp(gap / (rate * rest), 1e-5, 0.99) : otherwise;
}

}  // namespace

Direction fixed(const Eigen::Vector3d& direction_M) { return {direction_M, false, 0.0}; }

Direction turning(const ConvexShape& shape_T, const Eigen::Vector3d& direction_T) {
  return {direction_T, true, shape_T.support(-direction_T)};
}

PlacedCore ImpactFinder::Trajectory::tool(double s) const {
  if (s == 0.0) return {shape_T_, motion_.R_MT_start, from_};
  if (s == 1.0 || motion_.angle == 0.0) return {shape_T_, motion_.R_MT_end, from_ + s * motion_.travel_M};
  const Eigen::AngleAxisd turn(s * motion_.angle, motion_.axis_T);
  return {shape_T_, motion_.R_MT_start * turn.toRotationMatrix(), from_ + s * motion_.travel_M};
}

double ImpactFinder::Trajectory::gap(const Direction& direction, double s) const {
  const PlacedCore placed = tool(s);
  const Eigen::Vector3d n = direction.at(placed);
  const double reach = direction.turns ? direction.reach : shape_T_.support(placed.R_MT.transpose() * -n);
  const std::array<Eigen::Vector3d, 3> p = corners(s);
  return n.dot(placed.p_MT) - reach - std::max({n.dot(p[0]), n.dot(p[1]), n.dot(p[2])});
}

void ImpactFinder::Trajectory::advance(const Direction& direction, double aim, double least, Gap& at) const {
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

double ImpactFinder::Trajectory::curvatureBound(const Direction& direction) const {
  if (motion_.angle == 0.0) return 0.0;
  const Eigen::Vector3d& axis = direction.turns ? motion_.axis_T : motion_.axis_M;
  const double rate = motion_.angle * direction.unit.cross(axis).norm();
  if (!direction.turns) return 0.5 * rate * motion_.angle * motion_.radius;
  return 0.5 * rate * (motion_.angle * farthestCorner() + 2.0 * fastestCorner());
}

double ImpactFinder::Trajectory::farthestCorner() const {
  double farthest = 0.0;
  for (size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d start = corners_[i] - from_;
    farthest = std::max({farthest, start.norm(), (start + displacements_[i] - motion_.travel_M).norm()});
  }
  return farthest;
}

double ImpactFinder::Trajectory::fastestCorner() const {
  double fastest = 0.0;
  for (const Eigen::Vector3d& displacement : displacements_) {
    fastest = std::max(fastest, (displacement - motion_.travel_M).norm());
  }
  return fastest;
}

}  // namespace sweep_guard_core
