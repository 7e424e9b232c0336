#include "detection/float_planes.h"

#include <cassert>
#include <cmath>

#include "detection/box_coordinates.h"

namespace sweep_guard_core {
namespace {

constexpr double kPlaneError = 0x1p-20;  // at most six roundings of 2^-24: normal, offset, three products, two sums
constexpr double kMaxSize = 1e30;        // larger than any coordinate, finite in float32

// Adds n·p <= d, relative to the mesh's origin.
void addPlane(const Eigen::Vector3d& normal, double d, double radius, double rounding, simd::Planes& planes) {
  const size_t i = planes.count++;
  assert(planes.count <= simd::kMaxPlanes);
  d = std::min(std::max(d, -kMaxSize), kMaxSize);
  const double doubt = kPlaneError * (radius + std::abs(d)) + rounding;
  for (size_t axis = 0; axis < 3; ++axis) {
    planes.normal[axis][i] = static_cast<float>(normal[static_cast<Eigen::Index>(axis)]);
  }
  planes.outside[i] = static_cast<float>(d + doubt);
  planes.inside[i] = static_cast<float>(d - doubt);
}

}  // namespace

simd::Planes floatPlanes(const TriangleMesh& mesh_M, const SweptVolume& swept_M, const PerHalfSpace& outwards) {
  const Eigen::Matrix3d& R_MB = swept_M.box.X_MB.linear();
  const Eigen::Vector3d center = swept_M.box.X_MB.translation() - mesh_M.origin();
  const double rounding = 2.0 * BoxCoordinates(mesh_M, swept_M.box).rounding();
  simd::Planes planes;
  size_t i = 0;
  swept_M.forEachHalfSpace([&](const Eigen::Vector3d& normal_B, double offset) {
    const Eigen::Vector3d normal_M = R_MB * normal_B;
    const double outwards_by = outwards.empty() ? 0.0 : outwards[i++];
    addPlane(normal_M, normal_M.dot(center) + offset + outwards_by, mesh_M.radius(), rounding, planes);
  });
  return planes;
}

simd::Planes floatPlanes(const TriangleMesh& mesh_M, const Eigen::AlignedBox3d& box_M) {
  const Eigen::AlignedBox3d box(box_M.min() - mesh_M.origin(), box_M.max() - mesh_M.origin());
  const double rounding = 0x1p-48 * mesh_M.origin().norm();
  simd::Planes planes;
  for (int axis = 0; axis < 3; ++axis) {
    addPlane(Eigen::Vector3d::Unit(axis), box.max()[axis], mesh_M.radius(), rounding, planes);
    addPlane(-Eigen::Vector3d::Unit(axis), -box.min()[axis], mesh_M.radius(), rounding, planes);
  }
  return planes;
}

}  // namespace sweep_guard_core
