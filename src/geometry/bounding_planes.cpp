#include "sweep_guard/geometry/bounding_planes.h"

#include <array>
#include <cmath>
#include <optional>

namespace sweep_guard {
namespace {

// A point of the tool at one pose, in the plane (Y, Z) of the box.
using PlanePoint = Eigen::Vector2d;

struct Face {
  PlanePoint y_max;
  PlanePoint y_min;
};

using ExtremeOfFace = Eigen::Vector3d (Tool::*)(const Eigen::Vector3d&) const;

Face projectFace(const Tool& tool, ExtremeOfFace extreme, const Eigen::Isometry3d& X_BT) {
  const Eigen::Vector3d y_axis_T = X_BT.linear().transpose().col(1);
  const Eigen::Vector3d highest = X_BT * (tool.*extreme)(y_axis_T);
  const Eigen::Vector3d lowest = X_BT * (tool.*extreme)(-y_axis_T);
  return {highest.tail<2>(), lowest.tail<2>()};
}

struct Candidate {
  PlanePoint from;
  PlanePoint to;
};

// The deepest of the planes through the candidate lines, each with the normal that points the way of `outward`.
std::optional<HalfSpace> deepestPlane(const std::array<Candidate, 4>& lines, const Eigen::Vector2d& outward,
                                      const Tool& tool, const Motion& motion_B, const Eigen::Vector3d& half_extents) {
  const double negligible = 1e-9 * half_extents.norm();
  std::optional<HalfSpace> deepest;
  double deepest_cut = negligible;
  for (const Candidate& line : lines) {
    const Eigen::Vector2d along = line.to - line.from;
    if (along.norm() <= negligible) continue;  // one point gives no line
    const Eigen::Vector2d across = Eigen::Vector2d(along.y(), -along.x()).normalized();
    const Eigen::Vector2d facing = across.dot(outward) < 0.0 ? Eigen::Vector2d(-across) : across;
    const Eigen::Vector3d normal(0.0, facing.x(), facing.y());
    const double offset = support(tool, motion_B, normal);
    const double cut = normal.cwiseAbs().dot(half_extents) - offset;
    if (cut > deepest_cut) {
      deepest_cut = cut;
      deepest = HalfSpace(normal, offset);
    }
  }
  return deepest;
}

}  // namespace

std::vector<HalfSpace> boundingPlanes(const Tool& tool, const Motion& motion, const OrientedBox& box) {
  const Eigen::Isometry3d X_BM = box.X_MB.inverse();
  const Motion motion_B{X_BM * motion.X_MT_start, X_BM * motion.X_MT_end};
  const Face front_start = projectFace(tool, &Tool::frontExtreme, motion_B.X_MT_start);
  const Face front_end = projectFace(tool, &Tool::frontExtreme, motion_B.X_MT_end);
  const Face rear_start = projectFace(tool, &Tool::rearExtreme, motion_B.X_MT_start);
  const Face rear_end = projectFace(tool, &Tool::rearExtreme, motion_B.X_MT_end);

  const auto sides = [&](PlanePoint Face::*y) {
    return std::array<Candidate, 4>{{{rear_start.*y, front_start.*y},
                                     {rear_end.*y, front_end.*y},
                                     {rear_start.*y, front_end.*y},
                                     {rear_end.*y, front_start.*y}}};
  };
  const auto fronts = [](const Face& start, const Face& end) {
    return std::array<Candidate, 4>{
        {{start.y_max, end.y_max}, {start.y_max, end.y_min}, {start.y_min, end.y_max}, {start.y_min, end.y_min}}};
  };
  const Eigen::Vector2d tip = (motion_B.X_MT_start.linear().col(2) + motion_B.X_MT_end.linear().col(2)).tail<2>();
  const Eigen::Vector2d side = std::copysign(1.0, tip.y()) * Eigen::Vector2d(tip.y(), -tip.x());  // towards +Y

  std::vector<HalfSpace> planes;
  const auto add = [&](const std::array<Candidate, 4>& lines, const Eigen::Vector2d& outward) {
    if (const auto plane = deepestPlane(lines, outward, tool, motion_B, box.half_extents)) planes.push_back(*plane);
  };
  add(sides(&Face::y_max), side);
  add(sides(&Face::y_min), -side);
  add(fronts(front_start, front_end), tip);
  add(fronts(rear_start, rear_end), -tip);
  return planes;
}

}  // namespace sweep_guard
