#include "simulation/depth_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "simulation/camera_pose.h"
#include "simulation/depth_noise.h"

namespace sweep_guard_simulation {
namespace {

constexpr std::uint32_t kColumns = 64;
constexpr std::uint32_t kRows = 48;
constexpr sweep_guard_core::Pinhole kCamera{60.0, 50.0, 30.0, 20.0};

// z = z0 + slope x in the camera's frame, of 2 m.
VisibleSurface slope(float z0, float slope) {
  return {Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, z0)),
          {-1.0F, -1.0F, -slope, 1.0F, -1.0F, slope, 1.0F, 1.0F, slope, -1.0F, 1.0F, -slope},
          {{0, 1, 2}, {0, 2, 3}}};
}

TEST(DepthRendererTest, EachPixelHasTheDepthWhereItsRayMeetsTheNearestSurface) {
  DepthRenderer renderer(kColumns, kRows, kCamera);
  const std::vector<float>& depths = renderer.render({slope(2.0F, 0.0F), slope(1.0F, 0.5F)});
  for (std::uint32_t v = 0; v < kRows; ++v) {
    for (std::uint32_t u = 0; u < kColumns; ++u) {
      const double x = (u - kCamera.cx) / kCamera.fx;
      const double y = (v - kCamera.cy) / kCamera.fy;
      const double near = 1.0 / (1.0 - 0.5 * x);
      const bool on_it = std::max(std::abs(x * near), std::abs(y * near)) < 0.999;
      if (!on_it) continue;
      EXPECT_NEAR(depths[v * kColumns + u], near, 1e-5) << u << ' ' << v;
    }
  }
}

TEST(DepthRendererTest, APixelThatMeetsNothingIsNaN) {
  DepthRenderer renderer(kColumns, kRows, kCamera);
  VisibleSurface beside = slope(1.0F, 0.0F);
  beside.X_CS.translation().x() = -1.0;
  const std::vector<float>& depths = renderer.render({beside});
  EXPECT_NEAR(depths[20 * kColumns + 29], 1.0, 1e-5);  // x = 0 is at column 30
  EXPECT_TRUE(std::isnan(depths[20 * kColumns + 31]));
}

// Of depths around one, so that none of them is a step.
TEST(DepthNoiseTest, NoiseAndStepsGrowWithTheSquareOfTheDepth) {
  for (const float z : {0.5F, 1.0F, 2.0F}) {
    std::vector<float> depths(100000);
    for (size_t i = 0; i < depths.size(); ++i) depths[i] = z * (1.0F + 5e-7F * static_cast<float>(i));
    const std::vector<std::uint16_t> seen = DepthNoise().seen(depths);
    double sum = 0.0;
    for (size_t i = 0; i < seen.size(); ++i) sum += std::pow(0.001 * seen[i] - depths[i], 2);
    const double rounding = std::hypot(DepthNoise::kStep * z * z, 0.001) / std::sqrt(12.0);
    const double expected = std::hypot(DepthNoise::kDeviation * z * z, rounding);
    EXPECT_NEAR(std::sqrt(sum / static_cast<double>(seen.size())), expected, 0.1 * expected) << z;
  }
}

TEST(DepthNoiseTest, WhatIsNotSeenHasNoDepth) {
  DepthNoise noise;
  EXPECT_EQ(noise.seen({NAN, 100.0F, 1.0F})[0], 0U);
  EXPECT_EQ(noise.seen({NAN, 100.0F, 1.0F})[1], 0U);
  EXPECT_NEAR(noise.seen({NAN, 100.0F, 1.0F})[2], 1000.0, 10.0);
}

TEST(CameraPoseTest, ItsAxisGoesThroughTheTargetAndItsPictureIsUpright) {
  const Eigen::Isometry3d X_CW = lookingAt({0.1, 0.2, 0.5}, {0.4, 0.6, 1.0}).inverse();
  const Eigen::Vector3d target_C = X_CW * Eigen::Vector3d(0.1, 0.2, 0.5);
  EXPECT_TRUE(target_C.isApprox(Eigen::Vector3d(0.0, 0.0, std::sqrt(0.5)), 1e-9)) << target_C;
  EXPECT_LT((X_CW.linear() * Eigen::Vector3d::UnitZ()).y(), 0.0);  // down in the picture is down
}

}  // namespace
}  // namespace sweep_guard_simulation
