#include "sweep_guard/haptics/force_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "motion/random_scenes.h"

namespace sweep_guard_core {
namespace {

using Complex = std::complex<double>;

// The damping that a device needs beside a simulated wall H(z) = z^-m (K + B (z - 1) / (T z)), at the frequency angle / T:
// T/2 / (1 - cos(angle)) Re{(1 - e^(-j angle)) H(e^(j angle))} [Colgate and Schenkel 1997].
double neededDamping(double stiffness, const SampledDevice& device, int delay_periods, double angle) {
  const Complex z = std::polar(1.0, angle);
  const Complex wall =
      std::pow(z, -delay_periods) * (stiffness + device.virtual_damping * (z - 1.0) / (device.period * z));
  return device.period / 2 / (1.0 - std::cos(angle)) * std::real((1.0 - 1.0 / z) * wall);
}

TEST(StiffnessBoundTest, ADeviceWithTheBoundHasTheDampingOfColgateAndSchenkelAtEachFrequency) {
  RandomScenes random(3);
  for (int i = 0; i < 200; ++i) {
    const SampledDevice device{random.uniform(0.5, 5.0), random.uniform(0.0, 0.4), random.logUniform(5e-4, 5e-3)};
    const int periods = static_cast<int>(random.count(50));
    const double stiffness = maxStiffness(device, periods * device.period);
    for (int j = 1; j <= 500; ++j) {
      ASSERT_LE(neededDamping(stiffness, device, periods, M_PI * j / 500.0), device.damping + 1e-9);
    }
  }
}

// At low frequencies, without virtual damping, nothing is left of it: a stiffer wall is active.
TEST(StiffnessBoundTest, WithoutVirtualDampingTheBoundIsTheBest) {
  const SampledDevice device{2.0, 0.0, 0.001};
  for (const int periods : {0, 1, 10, 50}) {
    const double stiffness = maxStiffness(device, periods * device.period);
    EXPECT_GT(neededDamping(1.001 * stiffness, device, periods, 1e-4), device.damping);
  }
}

TEST(StiffnessBoundTest, IsZeroIfTheSimulatedDamperIsStronger) {
  EXPECT_EQ(maxStiffness({1.0, 1.5, 0.001}, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(maxStiffness({2.0, 0.0, 0.001}, 0.0), 4000.0);
  EXPECT_DOUBLE_EQ(maxStiffness({2.5, 0.5, 0.001}, 0.0195), 100.0);
}

// The matrix diag(b, c) less what a spring and a damper at the point take, (1, lever) (1, lever)', loses its determinant.
TEST(StiffnessBoundTest, WithALeverForceAndTorqueTogetherUseUpTheDamping) {
  const double b = 2.0, c = 0.01, lever = 0.08;
  const double damping = dampingWithLever(b, c, lever);
  EXPECT_NEAR((b - damping) * (c - damping * lever * lever), std::pow(damping * lever, 2), 1e-12);
  EXPECT_EQ(dampingWithLever(b, c, 0.0), b);
}

}  // namespace
}  // namespace sweep_guard_core
