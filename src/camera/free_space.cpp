#include "camera/free_space.h"

#include <cmath>

namespace sweep_guard_core {

bool FreeSpace::contains(const Eigen::Vector3d& p_F) const {
  const Eigen::Vector3d p_C = X_CF * p_F;
  if (!(p_C.z() > 0.0)) return false;
  const double u = std::round(camera.fx * p_C.x() / p_C.z() + camera.cx);
  const double v = std::round(camera.fy * p_C.y() / p_C.z() + camera.cy);
  if (!(u >= 1.0 && u + 1.0 < width && v >= 1.0 && v + 1.0 < height)) return false;
  const auto depth = static_cast<float>(p_C.z());
  const float* row = &depths[(static_cast<size_t>(v) - 1) * stride + static_cast<size_t>(u) - 1];
  for (int i = 0; i < 3; ++i, row += stride) {
    if (!(row[0] > depth && row[1] > depth && row[2] > depth)) return false;
  }
  return true;
}

}  // namespace sweep_guard_core
