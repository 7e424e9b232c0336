#include "sweep_guard/geometry/swept_volume.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

// A point of the body at one pose, projected into the (Y, Z) plane of the box.
using PlanePoint = Eigen::Vector2d;

struct Face {
  PlanePoint y_max;
  PlanePoint y_min;
};

using ExtremeOfFace = Eigen::Vector3d (ConvexShape::*)(const Eigen::Vector3d&) const;

Face projectFace(const ConvexShape& shape, ExtremeOfFace extreme, const Eigen::Isometry3d& X_BT) {
  const Eigen::Vector3d y_axis_T = X_BT.linear().transpose().col(1);
  const Eigen::Vector3d highest = X_BT * (shape.*extreme)(y_axis_T);
  const Eigen::Vector3d lowest = X_BT * (shape.*extreme)(-y_axis_T);
  return {highest.tail<2>(), lowest.tail<2>()};
}

struct Line {
  PlanePoint from;
  PlanePoint to;
};

// Area of the rectangle |y| <= h.y, |z| <= h.z beyond the line a y + b z = d: with c = a h.y + b h.z - d, the distance
// of the corner beyond the line, this is a triangle with legs c / a and c / b minus its parts outside of the rectangle.
double areaCutOff(const Eigen::Vector2d& normal, double offset, const Eigen::Vector2d& h) {
  const double a = std::abs(normal.x());
  const double b = std::abs(normal.y());
  const double c = a * h.x() + b * h.y() - offset;
  if (c <= 0.0) return 0.0;
  constexpr double kParallel = 1e-9;
  if (a < kParallel) return c / b * 2.0 * h.x();
  if (b < kParallel) return c / a * 2.0 * h.y();
  const auto squareBeyond = [](double length) { return length > 0.0 ? length * length : 0.0; };
  return (c * c - squareBeyond(c - 2.0 * a * h.x()) - squareBeyond(c - 2.0 * b * h.y())) / (2.0 * a * b);
}

// Returns the plane through one of the lines, with its normal towards `outward`, that cuts off the largest area.
std::optional<HalfSpace> tightestPlane(const std::array<Line, 4>& lines, const Eigen::Vector2d& outward,
                                       const ConvexShape& shape, const Motion& motion_B,
                                       const Eigen::Vector3d& half_extents) {
  const double negligible = 1e-9 * half_extents.norm();
  std::optional<HalfSpace> tightest;
  double largest = negligible * half_extents.norm();
  for (const Line& line : lines) {
    const Eigen::Vector2d along = line.to - line.from;
    if (along.norm() <= negligible) continue;  // the points coincide
    const Eigen::Vector2d across = Eigen::Vector2d(along.y(), -along.x()).normalized();
    const Eigen::Vector2d facing = across.dot(outward) < 0.0 ? Eigen::Vector2d(-across) : across;
    // The line runs through points of the body: moved outwards, it cuts off no more than here.
    if (areaCutOff(facing, facing.dot(line.from), half_extents.tail<2>()) <= largest) continue;
    const Eigen::Vector3d normal(0.0, facing.x(), facing.y());
    const double offset = support(shape, motion_B, normal);
    const double area = areaCutOff(facing, offset, half_extents.tail<2>());
    if (area > largest) {
      largest = area;
      tightest = HalfSpace(normal, offset);
    }
  }
  return tightest;
}

}  // namespace

Clips boundingPlanes(const ConvexShape& shape, const Motion& motion, const OrientedBox& box) {
  const Eigen::Isometry3d X_BM = box.X_MB.inverse();
  const Motion motion_B{X_BM * motion.X_MT_start, X_BM * motion.X_MT_end, 0.0, X_BM.linear() * motion.mesh_translation};
  const Face front_start = projectFace(shape, &ConvexShape::frontSupport, motion_B.X_MT_start);
  const Face front_end = projectFace(shape, &ConvexShape::frontSupport, motion_B.X_MT_end);
  const Face rear_start = projectFace(shape, &ConvexShape::rearSupport, motion_B.X_MT_start);
  const Face rear_end = projectFace(shape, &ConvexShape::rearSupport, motion_B.X_MT_end);

  const auto sides = [&](PlanePoint Face::*y) {
    return std::array<Line, 4>{{{rear_start.*y, front_start.*y},
                                {rear_end.*y, front_end.*y},
                                {rear_start.*y, front_end.*y},
                                {rear_end.*y, front_start.*y}}};
  };
  const auto fronts = [](const Face& start, const Face& end) {
    return std::array<Line, 4>{
        {{start.y_max, end.y_max}, {start.y_max, end.y_min}, {start.y_min, end.y_max}, {start.y_min, end.y_min}}};
  };
  const Eigen::Vector3d axis_T = shape.axis_T();
  const Eigen::Vector2d tip = (motion_B.X_MT_start.linear() * axis_T + motion_B.X_MT_end.linear() * axis_T).tail<2>();
  const Eigen::Vector2d side = std::copysign(1.0, tip.y()) * Eigen::Vector2d(tip.y(), -tip.x());  // towards +Y

  Clips planes;
  const auto add = [&](const std::array<Line, 4>& lines, const Eigen::Vector2d& outward) {
    if (const auto plane = tightestPlane(lines, outward, shape, motion_B, box.half_extents)) planes.push_back(*plane);
  };
  add(sides(&Face::y_max), side);
  add(sides(&Face::y_min), -side);
  add(fronts(front_start, front_end), tip);
  add(fronts(rear_start, rear_end), -tip);
  return planes;
}

VolumeKind volumeKind(const std::string& name) {
  if (name == "obb") return VolumeKind::kObb;
  if (name == "obb_planes") return VolumeKind::kObbPlanes;
  if (name == "hull") return VolumeKind::kHull;
  throw InvalidInput("volume '" + name + "' is unknown: use obb, obb_planes or hull");
}

std::string nameOf(VolumeKind kind) {
  if (kind == VolumeKind::kHull) return "hull";
  return kind == VolumeKind::kObb ? "obb" : "obb_planes";
}

std::vector<HalfSpace> SweptVolume::halfSpaces_B() const {
  std::vector<HalfSpace> half_spaces;
  forEachHalfSpace([&](const Eigen::Vector3d& normal, double offset) { half_spaces.emplace_back(normal, offset); });
  return half_spaces;
}

SweptVolume SweptVolume::grown(double distance) const {
  SweptVolume grown = *this;
  grown.margin += distance;
  grown.box.half_extents.array() += distance;
  for (HalfSpace& clip_B : grown.clips_B) clip_B = clip_B.grown(distance);
  return grown;
}

double deviationBound(const ConvexShape& shape, const Motion& motion) {
  return std::max(chordError(shape.radiusAbout(motion.axis_T()), motion.angle()), motion.deviation_bound);
}

SweptVolume sweptVolume(const ConvexShape& shape, const Motion& motion, VolumeKind kind, double extra_margin) {
  assert(motion.angle() < 1.6 && extra_margin >= 0.0);
  // The volume is computed relative to the tool and moved at the end: far from the mesh's origin it would lose digits.
  const Eigen::Translation3d there(motion.X_MT_start.translation());
  const Motion near{there.inverse() * motion.X_MT_start, there.inverse() * motion.X_MT_end, 0.0,
                    motion.mesh_translation};

  SweptVolume volume;
  volume.box = boundingBox(shape, near);
  if (kind != VolumeKind::kObb) volume.clips_B = boundingPlanes(shape, near, volume.box);
  const Eigen::Vector3d& mean_T = shape.moments_T().mean;
  volume.interior_B = volume.box.X_MB.inverse() * (0.5 * (near.X_MT_start * mean_T + near.X_MT_end * mean_T));
  volume.box.X_MB = there * volume.box.X_MB;

  return volume.grown(deviationBound(shape, motion) + extra_margin);
}

}  // namespace sweep_guard_core
