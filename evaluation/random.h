#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <random>

#include "common/rotation_between.h"

namespace sweep_guard_evaluation {

constexpr double kPi = 3.14159265358979323846;

/// Draws random numbers that are equal on every machine for equal seeds: the standard fixes the engines, but not the
/// distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Returns a number in [lower, upper).
  double uniform(double lower, double upper) {
    return lower + (upper - lower) * static_cast<double>(engine_() >> 11U) * 0x1p-53;
  }

  /// Returns a unit vector, all directions alike.
  Eigen::Vector3d direction() {
    const double z = uniform(-1.0, 1.0);
    const double angle = uniform(0.0, 2.0 * kPi);
    const double radius = std::sqrt(1.0 - z * z);
    return {radius * std::cos(angle), radius * std::sin(angle), z};
  }

  /// Returns a rotation that takes z to `z_W`, with a random angle about it.
  Eigen::Matrix3d frameWithZ(const Eigen::Vector3d& z_W) {
    const Eigen::AngleAxisd turn(uniform(0.0, 2.0 * kPi), Eigen::Vector3d::UnitZ());
    return (sweep_guard_core::rotationBetween(Eigen::Vector3d::UnitZ(), z_W) * turn).toRotationMatrix();
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace sweep_guard_evaluation
