#include "sweep_guard/haptics/passive_device.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "motion/random_scenes.h"

namespace sweep_guard_core {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr TurnLimits kLimits{/*max_rate=*/5.0, /*max_acceleration=*/500.0};

Vector3d rotationVector(const Quaterniond& turn) {
  const AngleAxisd from(turn.normalized());
  return from.angle() * from.axis();
}

struct Turned {
  Vector3d integral = Vector3d::Zero();  // of the turn rate
  Quaterniond orientation = Quaterniond::Identity();

  void step(const Vector3d& rate, double duration) {
    integral += duration * rate;
    const Quaterniond turn(AngleAxisd(duration * rate.norm(), rate.stableNormalized()));
    orientation = turn * orientation;
  }
};

// One lap around a cone turns about its axis by its solid angle, without a turn rate about that axis in the mean of the path.
TEST(ConingBoundTest, AHandThatGoesAroundAConeTurnsMoreThanItsEndsShow) {
  constexpr double kInterval = 0.05;
  constexpr int kSteps = 20000;
  Turned turned;
  for (int i = 0; i < kSteps; ++i) {
    const double angle = 2.0 * M_PI * (i + 0.5) / kSteps;
    turned.step({std::cos(angle), std::sin(angle), 0.0}, kInterval / kSteps);
  }
  const Vector3d shown = rotationVector(turned.orientation);
  EXPECT_LT(turned.integral.norm(), 1e-12);
  const double radius = 1.0 * kInterval / (2.0 * M_PI);
  EXPECT_NEAR(shown.norm(), M_PI * radius * radius, 1e-2 * shown.norm());
  EXPECT_LE(shown.norm(), coningBound(shown.norm(), kInterval, kLimits));
}

TEST(ConingBoundTest, IsNothingForTheShortestPath) {
  EXPECT_EQ(coningBound(0.0, 0.0, kLimits), 0.0);
  EXPECT_LT(coningBound(0.3, 0.06, {5.0, 1e-3}), 1e-6) << "the rate cannot change";
}

TEST(ConingBoundTest, WhereTheHandMayHaveTurnedAllAroundOnlyTheLongestWayIsKnown) {
  EXPECT_DOUBLE_EQ(coningBound(0.1, 2.0, kLimits), 10.1);
}

// Each motion keeps to its limits: the rate goes around, as tightly as the acceleration allows, or after random targets.
TEST(ConingBoundTest, NoMotionTurnsFartherFromWhatItsEndsShow) {
  RandomScenes random(21);
  double closest = 0.0;
  for (std::uint64_t i = 0, cases = caseCount(3000); i < cases; ++i) {
    const double rate = random.logUniform(0.5, 20.0);
    const TurnLimits limits{rate, rate * random.logUniform(2.0, 1000.0)};
    const double interval = random.logUniform(1e-3, 0.3);
    constexpr int kSteps = 200;
    const double step = interval / kSteps;
    const bool around = random.chance(0.3);
    const Quaterniond frame = Quaterniond::FromTwoVectors(Vector3d::UnitZ(), random.direction());
    const double lap = limits.max_acceleration / rate * random.uniform(0.2, 1.0);
    const double changes = random.uniform(0.0, 0.1);
    Vector3d target = rate * random.direction();
    Vector3d w = random.uniform(0.0, 1.0) * target;
    Turned turned;
    for (int k = 0; k < kSteps; ++k) {
      if (random.chance(changes)) target = rate * random.direction();
      const Vector3d change = target - w;
      w += std::min(1.0, limits.max_acceleration * step / std::max(1e-12, change.norm())) * change;
      const double angle = lap * step * (k + 0.5);
      turned.step(around ? Vector3d(frame * Vector3d(rate * std::cos(angle), rate * std::sin(angle), 0.0)) : w, step);
    }
    const Vector3d shown = rotationVector(turned.orientation);
    const double deviation = (shown - turned.integral).norm();
    const double bound = coningBound(shown.norm(), interval, limits);
    ASSERT_LE(deviation, (1.0 + 1e-6) * bound + 1e-12);
    closest = std::max(closest, deviation / bound);
  }
  EXPECT_GT(closest, 0.8) << "the bound is not far off";
}

}  // namespace
}  // namespace sweep_guard_core
