#include "hull_volume.h"

#ifdef SWEEP_GUARD_HAS_QHULL
#include <libqhullcpp/Qhull.h>
#endif

namespace sweep_guard {

#ifdef SWEEP_GUARD_HAS_QHULL
std::optional<double> hullVolume(const std::vector<Eigen::Vector3d>& points) {
  orgQhull::Qhull hull("", 3, static_cast<int>(points.size()), points.data()->data(), "Qt");
  return hull.volume();
}
#else
std::optional<double> hullVolume(const std::vector<Eigen::Vector3d>&) { return std::nullopt; }
#endif

}  // namespace sweep_guard
