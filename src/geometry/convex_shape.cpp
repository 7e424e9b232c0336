#include "sweep_guard/geometry/convex_shape.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "geometry/shape_surface.h"
#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_core {
namespace {

template <typename... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <typename... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

Eigen::Vector3d discSupport(double z, double radius, const Eigen::Vector3d& direction) {
  const Eigen::Vector2d radial = direction.head<2>();
  const double length = radial.norm();
  if (length == 0.0) return {0.0, 0.0, z};
  return {radius * radial.x() / length, radius * radial.y() / length, z};
}

// Returns the direction in which a disc around the origin leaves a triangle in its plane soonest.
Eigen::Vector2d normalOfDisc(const std::array<Eigen::Vector2d, 3>& corners) {
  Eigen::Vector2d nearest = corners[0];  // of the points of the edges, to the center
  int to_the_left = 0;
  for (size_t i = 0; i < 3; ++i) {
    const Eigen::Vector2d& from = corners[i];
    const Eigen::Vector2d edge = corners[(i + 1) % 3] - from;
    const double length = edge.squaredNorm();
    const double share = length > 0.0 ? std::clamp(-edge.dot(from) / length, 0.0, 1.0) : 0.0;
    const Eigen::Vector2d p = from + share * edge;
    if (p.squaredNorm() < nearest.squaredNorm()) nearest = p;
    to_the_left += from.x() * edge.y() - from.y() * edge.x() > 0.0 ? 1 : 0;
  }
  const bool around_center = to_the_left == 0 || to_the_left == 3;
  const double distance = nearest.norm();
  if (distance == 0.0) return Eigen::Vector2d::UnitX();
  return (around_center ? 1.0 : -1.0) / distance * nearest;
}

double sign(double x) { return static_cast<double>((x > 0.0) - (x < 0.0)); }

// Of a point outside of the core, the distance is from its nearest point.
ConvexShape::Depth depthInCylinder(const Eigen::Vector3d& p, double radius, double length) {
  const double from_axis = p.head<2>().norm();
  const Eigen::Vector3d radial =
      from_axis > 0.0 ? Eigen::Vector3d(p.x() / from_axis, p.y() / from_axis, 0.0) : Eigen::Vector3d::UnitX();
  const double side = from_axis - radius;
  const double end = std::max(p.z(), -length - p.z());
  const Eigen::Vector3d axial(0.0, 0.0, p.z() >= -length - p.z() ? 1.0 : -1.0);
  if (side > 0.0 && end > 0.0) {
    const double distance = Eigen::Vector2d(side, end).norm();
    return {-distance, (side * radial + end * axial) / distance};
  }
  return side > end ? ConvexShape::Depth{-side, radial} : ConvexShape::Depth{-end, axial};
}

ConvexShape::Depth depthInBox(const Eigen::Vector3d& p, const Eigen::Vector3d& half_extents) {
  const Eigen::Vector3d beyond = p.cwiseAbs() - half_extents;
  Eigen::Index axis = 0;
  const double most = beyond.maxCoeff(&axis);
  if (most <= 0.0) return {-most, std::copysign(1.0, p[axis]) * Eigen::Vector3d::Unit(axis)};
  const Eigen::Vector3d out = beyond.cwiseMax(0.0);
  return {-out.norm(), out.normalized().cwiseProduct(p.unaryExpr(&sign))};
}

ConvexShape::Depth depthAtSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d along = to - from;
  const double length = along.squaredNorm();
  const double share = length > 0.0 ? std::clamp(along.dot(p - from) / length, 0.0, 1.0) : 0.0;
  const Eigen::Vector3d out = p - (from + share * along);
  const double distance = out.norm();
  const Eigen::Vector3d orthogonal = length > 0.0 ? along.unitOrthogonal() : Eigen::Vector3d::UnitZ();
  return {-distance, distance > 0.0 ? Eigen::Vector3d(out / distance) : orthogonal};
}

ConvexShape::Depth depthInFaces(const Eigen::Vector3d& p, const LinearFunctions& faces) {
  const double none = -std::numeric_limits<double>::infinity();
  if (faces.empty()) return {none, Eigen::Vector3d::UnitZ()};
  const size_t nearest = faces.largest(p);
  const double beyond = faces.value(nearest, p);
  return {beyond <= 0.0 ? -beyond : none, faces.gradient(nearest)};
}

}  // namespace

size_t LinearFunctions::largest(const Eigen::Vector3d& p) const {
  assert(!empty());
  static const auto find = simd::kernels().largest;
  const size_t found = find({x_.data(), y_.data(), z_.data(), constant_.data(), x_.size()}, {p.x(), p.y(), p.z()});
  return std::min(found, size_ - 1);
}

Eigen::Isometry3d ConvexShape::X_TS() const {
  Eigen::Isometry3d X_TS = Eigen::Isometry3d::Identity();
  X_TS.linear() = R_TS_;
  X_TS.translation() = p_TS_;
  return X_TS;
}

double ConvexShape::support(const Eigen::Vector3d& direction_T) const {
  const Eigen::Vector3d d = R_TS_.transpose() * direction_T;
  const double of_body =
      std::visit(Overloaded{[&](const Cylinder& cylinder) {
                              return cylinder.radius * d.head<2>().norm() + cylinder.length * std::max(0.0, -d.z());
                            },
                            [&](const Box& half_extents) { return half_extents.dot(d.cwiseAbs()); },
                            [&](const Points& points) { return points.reach.value(points.reach.largest(d), d); }},
                 body_S_);
  return direction_T.dot(p_TS_) + of_body + padding_;
}

Eigen::Vector3d ConvexShape::coreSupportPoint(const Eigen::Vector3d& direction_T) const {
  const Eigen::Vector3d d = R_TS_.transpose() * direction_T;
  const Eigen::Vector3d p_S = std::visit(
      Overloaded{
          [&](const Cylinder& cylinder) {
            return discSupport(d.z() < 0.0 ? -cylinder.length : 0.0, cylinder.radius, d);
          },
          [&](const Box& half_extents) -> Eigen::Vector3d { return half_extents.cwiseProduct(d.unaryExpr(&sign)); },
          [&](const Points& points) { return points.corners[points.reach.largest(d)]; }},
      body_S_);
  return p_TS_ + R_TS_ * p_S;
}

Eigen::Vector3d ConvexShape::supportPoint(const Eigen::Vector3d& direction_T) const {
  const Eigen::Vector3d p_T = coreSupportPoint(direction_T);
  const double length = direction_T.norm();
  return padding_ == 0.0 || length == 0.0 ? p_T : Eigen::Vector3d(p_T + padding_ / length * direction_T);
}

Eigen::Vector3d ConvexShape::proposeNormal(const std::array<Eigen::Vector3d, 3>& corners_T) const {
  if (asCylinder() == nullptr) {
    return -depthOf((corners_T[0] + corners_T[1] + corners_T[2]) / 3.0).outwards_T;
  }
  std::array<Eigen::Vector2d, 3> corners;
  for (size_t i = 0; i < 3; ++i) corners[i] = (R_TS_.transpose() * (corners_T[i] - p_TS_)).head<2>();
  const Eigen::Vector2d across = normalOfDisc(corners);
  return R_TS_ * Eigen::Vector3d(across.x(), across.y(), 0.0);
}

ConvexShape::Depth ConvexShape::depthOf(const Eigen::Vector3d& p_T) const {
  const Eigen::Vector3d p = R_TS_.transpose() * (p_T - p_TS_);
  const Depth of_body = std::visit(
      Overloaded{[&](const Cylinder& cylinder) { return depthInCylinder(p, cylinder.radius, cylinder.length); },
                 [&](const Box& half_extents) { return depthInBox(p, half_extents); },
                 [&](const Points& points) {
                   return points.corners.size() <= 2 ? depthAtSegment(p, points.corners.front(), points.corners.back())
                                                     : depthInFaces(p, points.faces);
                 }},
      body_S_);
  return {of_body.depth + padding_, R_TS_ * of_body.outwards_T};
}

// The distance from a line is convex: it is largest at a corner, or on a rim.
double ConvexShape::radiusAbout(const Eigen::Vector3d& axis_T) const {
  const auto away = [&](const Eigen::Vector3d& p_S) { return (p_TS_ + R_TS_ * p_S).cross(axis_T).norm(); };
  const auto farthest_of = [&](const auto& corners) {
    double most = 0.0;
    for (const Eigen::Vector3d& corner : corners) most = std::max(most, away(corner));
    return most;
  };
  const double of_body =
      std::visit(Overloaded{[&](const Cylinder& cylinder) {
                              const double rear = away({0.0, 0.0, -cylinder.length});
                              return cylinder.radius + std::max(away(Eigen::Vector3d::Zero()), rear);
                            },
                            [&](const Box& half_extents) { return farthest_of(boxCorners(half_extents)); },
                            [&](const Points& points) { return farthest_of(points.corners); }},
                 body_S_);
  return of_body + padding_;
}

double ConvexShape::boundingRadiusOfBody() const {
  const auto farthest_of = [&](const auto& corners) {
    double most = 0.0;
    for (const Eigen::Vector3d& corner : corners) most = std::max(most, (p_TS_ + R_TS_ * corner).norm());
    return most;
  };
  const Eigen::Vector3d origin_S = -(R_TS_.transpose() * p_TS_);
  const auto rim = [&](double z, double radius) {
    return Eigen::Vector2d(origin_S.head<2>().norm() + radius, origin_S.z() - z).norm();
  };
  return std::visit(Overloaded{[&](const Cylinder& cylinder) {
                                 return std::max(rim(0.0, cylinder.radius), rim(-cylinder.length, cylinder.radius));
                               },
                               [&](const Box& half_extents) { return farthest_of(boxCorners(half_extents)); },
                               [&](const Points& points) { return farthest_of(points.corners); }},
                    body_S_);
}

Eigen::Vector3d ConvexShape::faceSupport(double z, const Eigen::Vector3d& direction_T) const {
  const Eigen::Vector3d d = faces_.R_TF.transpose() * direction_T;
  const Eigen::Vector3d p_F =
      faces_.round ? discSupport(z, faces_.half_sides.x(), d)
                   : Eigen::Vector3d(sign(d.x()) * faces_.half_sides.x(), sign(d.y()) * faces_.half_sides.y(), z);
  const double length = direction_T.norm();
  const Eigen::Vector3d p_T = faces_.p_T + faces_.R_TF * p_F;
  return padding_ == 0.0 || length == 0.0 ? p_T : Eigen::Vector3d(p_T + padding_ / length * direction_T);
}

Eigen::Vector3d ConvexShape::frontSupport(const Eigen::Vector3d& direction_T) const {
  return faceSupport(faces_.front, direction_T);
}

Eigen::Vector3d ConvexShape::rearSupport(const Eigen::Vector3d& direction_T) const {
  return faceSupport(faces_.rear, direction_T);
}

double support(const ConvexShape& shape, const Eigen::Isometry3d& X_MT, const Eigen::Vector3d& direction_M) {
  return direction_M.dot(X_MT.translation()) + shape.support(X_MT.linear().transpose() * direction_M);
}

double support(const ConvexShape& shape, const Motion& motion, const Eigen::Vector3d& direction_M) {
  return std::max(support(shape, motion.X_MT_start, direction_M), support(shape, motion.X_MT_end, direction_M)) +
         std::max(0.0, direction_M.dot(motion.mesh_translation));
}

}  // namespace sweep_guard_core
