#include "guard/rigid_shape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace sweep_guard_core {

double deviationFromRigid(const TriangleMesh& mesh_M, const std::vector<float>& positions_M) {
  const auto count = static_cast<Eigen::Index>(mesh_M.vertexCount());
  assert(positions_M.size() == 3 * mesh_M.vertexCount());
  if (!std::all_of(positions_M.begin(), positions_M.end(), [](float x) { return std::isfinite(x); }))
    return std::numeric_limits<double>::infinity();
  Eigen::Matrix3Xd before(3, count);
  for (Eigen::Index i = 0; i < count; ++i) before.col(i) = mesh_M.vertex(static_cast<size_t>(i));
  const Eigen::Matrix3Xd after = Eigen::Map<const Eigen::Matrix3Xf>(positions_M.data(), 3, count).cast<double>();
  const Eigen::Matrix4d best = Eigen::umeyama(before, after, /*with_scaling=*/false);
  const Eigen::Matrix3Xd moved = (best.topLeftCorner<3, 3>() * before).colwise() + best.topRightCorner<3, 1>();
  return (after - moved).colwise().norm().maxCoeff();
}

}  // namespace sweep_guard_core
