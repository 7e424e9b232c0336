#include "detection/inside.h"

#include <cmath>

#include "geometry/crossing.h"

namespace sweep_guard_core {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kInside = 0.75;  // of a surface with holes: from this winding number on

// An open part and its fan are closed, so that the rest of its winding number is the solid angle of the fan.
template <typename Corner>
double windingNumber(const Corner& corner, const Triangle* first, const Enclosure::OpenPart& part) {
  const Triangle* const caps = first + part.own;
  const Triangle* const last = caps + part.caps;
  double angle = 0.0;
  for (const Triangle* cap = caps; cap != last; ++cap) angle += solidAngle(corner, *cap);
  return crossings(corner, first, last) - angle / (4.0 * kPi);
}

}  // namespace

bool inside(const TriangleMesh& mesh_M, const Eigen::Vector3d& p_M) {
  if (!mesh_M.bounds_M().contains(p_M)) return false;
  const Eigen::Vector3d p = p_M - mesh_M.origin();
  const auto corner = [&](std::uint32_t vertex) -> Eigen::Vector3d { return mesh_M.offset(vertex) - p; };
  const Enclosure& enclosure = mesh_M.enclosure();
  const std::vector<Triangle>& closed = enclosure.closedTriangles();
  if (crossings(corner, closed.data(), closed.data() + closed.size()) != 0) return true;
  double sum = 0.0;
  for (const Enclosure::OpenPart& part : enclosure.openParts()) {
    const double number = windingNumber(corner, enclosure.openTriangles().data() + part.first, part);
    if (std::abs(number) > kInside) return true;
    sum += number;
  }
  return std::abs(sum) > kInside;
}

}  // namespace sweep_guard_core
