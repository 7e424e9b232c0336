#pragma once

#include <Eigen/Core>
#include <array>

#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_core {

/// Integrals over a surface and over the volume of the vertical prisms below it. Surfaces that face down count negative
/// for the volume: of a closed surface remains what it encloses.
struct SurfaceSums {
  double volume = 0.0;                                      ///< [m^3]
  Eigen::Vector3d volume_moment = Eigen::Vector3d::Zero();  ///< of the position over the volume [m^4]
  Eigen::Vector3d area = Eigen::Vector3d::Zero();           ///< of the normal over the surface [m^2]
  Eigen::Matrix3d area_moment = Eigen::Matrix3d::Zero();    ///< of position times transposed normal [m^3]
};

/// Sums the integrals over prisms, many of them at once.
class PrismAccumulator {
 public:
  /// Begins with sums of 0.
  void begin();

  /// Adds the prism below a triangle.
  /// @param corners  counter-clockwise seen from the side of the normal [m]
  /// @param heights  of the corners above the floor of the prism [m]
  void add(const std::array<const Eigen::Vector3d*, 3>& corners, const std::array<double, 3>& heights);

  SurfaceSums sums();

 private:
  void addBatch();

  simd::PrismBatch batch_;
  simd::PrismSums sums_;
};

inline void PrismAccumulator::add(const std::array<const Eigen::Vector3d*, 3>& corners,
                                  const std::array<double, 3>& heights) {
  if (batch_.count == simd::kPrisms) addBatch();
  const size_t at = batch_.count++;
  for (size_t i = 0; i < 3; ++i) {
    batch_.corner[i][0][at] = corners[i]->x();
    batch_.corner[i][1][at] = corners[i]->y();
    batch_.corner[i][2][at] = corners[i]->z();
    batch_.height[i][at] = heights[i];
  }
}

}  // namespace sweep_guard_core
