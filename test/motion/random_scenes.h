#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "sweep_guard/motion/velocity_limiter.h"

namespace sweep_guard_core {

/// Returns how many random cases a test runs: SWEEP_GUARD_CASES if that is set, as in a search at full size.
inline std::uint64_t caseCount(std::uint64_t short_run) {
  const char* const cases = std::getenv("SWEEP_GUARD_CASES");
  return cases == nullptr ? short_run : static_cast<std::uint64_t>(std::stod(cases));
}

/// A tool among planes, and a command.
struct MotionScene {
  Twist command_W;
  std::vector<FacingBall> facing;
  UncoveredSurfaces uncovered;
  BrakingLimits limits;
};

/// Draws scenes and directions that are equal for equal seeds.
class RandomScenes {
 public:
  /// @param least_angle  between planes that are nearly parallel [rad]
  explicit RandomScenes(std::uint64_t seed, double least_angle = 1e-9) : engine_(seed), least_angle_(least_angle) {}

  double uniform(double lower, double upper) {
    return lower + (upper - lower) * static_cast<double>(engine_() >> 11U) * 0x1p-53;
  }
  double logUniform(double lower, double upper) { return lower * std::pow(upper / lower, uniform(0.0, 1.0)); }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  size_t count(size_t below) { return static_cast<size_t>(uniform(0.0, static_cast<double>(below))); }

  Eigen::Vector3d direction() {
    for (;;) {
      const Eigen::Vector3d p(uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0));
      if (p.norm() > 0.1 && p.norm() <= 1.0) return p.normalized();
    }
  }

  /// Planes at 0 to 0.5 m around a tool of up to 0.3 m: alone, repeated, nearly parallel or opposite, some of them
  /// touched or beyond the standoff, some moving; commands of 1e-6 to 2 m/s and rad/s, some without a part.
  MotionScene scene() {
    MotionScene scene;
    scene.limits = {logUniform(0.1, 10.0), logUniform(0.002, 0.3), chance(0.3) ? 0.0 : logUniform(1e-4, 0.01),
                    chance(0.1) ? 0.0 : logUniform(0.002, 0.3)};
    if (!chance(0.2)) scene.command_W.v_W = logUniform(1e-6, 2.0) * direction();
    if (!chance(0.2)) scene.command_W.w_W = logUniform(1e-6, 2.0) * direction();
    if (chance(0.2)) scene.uncovered = {logUniform(1e-3, 1.0), chance(0.5) ? 0.0 : uniform(0.0, 0.1)};
    const size_t planes = 1 + count(20);
    for (size_t i = 0; i < planes; ++i) addPlane(scene);
    return scene;
  }

 private:
  Eigen::Vector3d normal(const std::vector<FacingBall>& facing) {
    if (facing.empty() || chance(0.6)) return direction();
    const Eigen::Vector3d other_W = facing[count(facing.size())].normal_W;
    const double side = chance(0.5) ? 1.0 : -1.0;
    return chance(0.5) ? Eigen::Vector3d(side * other_W)
                       : Eigen::Vector3d(side * other_W + logUniform(least_angle_, 0.1) * direction()).normalized();
  }

  void addPlane(MotionScene& scene) {
    FacingBall ball{normal(scene.facing), Eigen::Vector3d::Zero(), 0.0, 0.0};
    ball.surface_speed = chance(0.7) ? 0.0 : uniform(-0.2, 0.2);
    const double kind = uniform(0.0, 1.0);
    const double gap = kind < 0.1 ? scene.limits.standoff : kind < 0.2 ? -0.01 : logUniform(1e-5, 0.5);
    const size_t balls = 1 + count(4);
    for (size_t i = 0; i < balls; ++i) {
      ball.center_W = scene.limits.tool_radius * uniform(0.0, 1.0) * direction();
      ball.gap = chance(0.5) ? gap : gap + uniform(0.0, 0.1);
      scene.facing.push_back(ball);
    }
    if (chance(0.1)) scene.facing.push_back(scene.facing.back());
  }

  std::mt19937_64 engine_;
  double least_angle_;
};

}  // namespace sweep_guard_core
