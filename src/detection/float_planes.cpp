#include "detection/float_planes.h"

#include <cassert>
#include <cmath>

#include "detection/box_coordinates.h"

namespace sweep_guard_core {
namespace {

constexpr double kPlaneError = 0x1p-20;  // at most six roundings of 2^-24: normal, offset, three products, two sums
constexpr double kMaxSize = 1e30;        // larger than any coordinate, finite in float32

class FloatPlanes {
 public:
  FloatPlanes(double radius, double rounding) : radius_(radius), rounding_(rounding) {}

  // Adds n·p <= d, relative to the mesh's origin.
  void add(const Eigen::Vector3d& normal, double d) {
    const size_t i = planes_.count++;
    assert(planes_.count <= simd::kMaxPlanes);
    d = std::min(std::max(d, -kMaxSize), kMaxSize);
    const double doubt = kPlaneError * (radius_ + std::abs(d)) + rounding_;
    for (size_t axis = 0; axis < 3; ++axis) {
      planes_.normal[axis][i] = static_cast<float>(normal[static_cast<Eigen::Index>(axis)]);
    }
    planes_.outside[i] = static_cast<float>(d + doubt);
    planes_.inside[i] = static_cast<float>(d - doubt);
  }

  const simd::Planes& planes() const { return planes_; }

 private:
  simd::Planes planes_;
  double radius_;
  double rounding_;
};

}  // namespace

simd::Planes floatPlanes(const TriangleMesh& mesh_M, const SweptVolume& swept_M, const PerHalfSpace& outwards) {
  const Eigen::Matrix3d& R_MB = swept_M.box.X_MB.linear();
  const Eigen::Vector3d center = swept_M.box.X_MB.translation() - mesh_M.origin();
  FloatPlanes planes(mesh_M.radius(), 2.0 * BoxCoordinates(mesh_M, swept_M.box).rounding());
  size_t i = 0;
  swept_M.forEachHalfSpace([&](const Eigen::Vector3d& normal_B, double offset) {
    const Eigen::Vector3d normal_M = R_MB * normal_B;
    planes.add(normal_M, normal_M.dot(center) + offset + (outwards.empty() ? 0.0 : outwards[i++]));
  });
  return planes.planes();
}

simd::Planes floatPlanes(const TriangleMesh& mesh_M, const Eigen::AlignedBox3d& box_M) {
  const Eigen::AlignedBox3d box(box_M.min() - mesh_M.origin(), box_M.max() - mesh_M.origin());
  FloatPlanes planes(mesh_M.radius(), 0x1p-48 * mesh_M.origin().norm());
  for (int axis = 0; axis < 3; ++axis) {
    planes.add(Eigen::Vector3d::Unit(axis), box.max()[axis]);
    planes.add(-Eigen::Vector3d::Unit(axis), -box.min()[axis]);
  }
  return planes.planes();
}

}  // namespace sweep_guard_core
