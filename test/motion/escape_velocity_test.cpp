#include "sweep_guard/motion/velocity_limiter.h"

#include <gtest/gtest.h>

#include <limits>

#include "motion/floor.h"
#include "refusal.h"

namespace sweep_guard_core {
namespace {

using Eigen::Vector3d;

constexpr double kEscapeSpeed = 0.02;

Twist escape(const Twist& command_W, const std::vector<FacingBall>& facing, double escape_speed = kEscapeSpeed) {
  return escapeVelocity(command_W, facing, {}, kLimits, escape_speed);
}

TEST(EscapeVelocityTest, ScalesTheCommandDownToTheEscapeSpeed) {
  const Twist output_W = escape({{0.3, 0.0, 0.4}, {0.0, 0.0, 5.0}}, {floorAt(0.001)});
  EXPECT_TRUE(output_W.v_W.isApprox(Vector3d(0.006, 0.0, 0.008), 1e-12));
  EXPECT_TRUE(output_W.w_W.isApprox(Vector3d(0.0, 0.0, 0.1), 1e-12));
}

TEST(EscapeVelocityTest, KeepsASlowCommandAsItIs) {
  const Twist command{{0.0, 0.0, 0.01}, Vector3d::Zero()};
  EXPECT_EQ(escape(command, {floorAt(0.001)}).v_W, command.v_W);
}

TEST(EscapeVelocityTest, NeedsEveryGapToGrow) {
  const Twist up{{0.0, 0.0, 0.01}, Vector3d::Zero()};
  EXPECT_FALSE(isZero(escape(up, {floorAt(0.001)})));
  EXPECT_TRUE(isZero(escape(up, {floorAt(0.001), {-Vector3d::UnitZ(), Vector3d::Zero(), 1.0, 0.0}})));
  EXPECT_TRUE(isZero(escape({{0.01, 0.0, 0.0}, Vector3d::Zero()}, {floorAt(0.001)})));
}

TEST(EscapeVelocityTest, CountsTheSurfaceAndTheTurn) {
  const Twist up{{0.0, 0.0, 0.01}, Vector3d::Zero()};
  EXPECT_TRUE(isZero(escape(up, {floorAt(0.001, Vector3d::Zero(), /*surface_speed=*/0.01)})));
  EXPECT_FALSE(isZero(escape(up, {floorAt(0.001, Vector3d::Zero(), /*surface_speed=*/-0.01)})));
  const Twist turning{{0.0, 0.0, 0.01}, {0.0, 0.11, 0.0}};
  EXPECT_TRUE(isZero(escape(turning, {floorAt(0.001, {0.1, 0.0, 0.0})})));
  EXPECT_FALSE(isZero(escape(turning, {floorAt(0.001, {-0.1, 0.0, 0.0})})));
}

// The tip rises at first, and its arc leads it down again before the tool is at rest.
TEST(EscapeVelocityTest, LeadsAwayUntilTheToolIsAtRest) {
  const FacingBall tip = floorAt(0.001, {0.0, 0.0, 0.1});
  EXPECT_TRUE(isZero(escape({{0.0, 0.0, 0.04}, {0.0, 2.5, 0.0}}, {tip}, 0.5)));
  EXPECT_FALSE(isZero(escape({{0.0, 0.0, 0.04}, {0.0, 1.0, 0.0}}, {tip}, 0.5)));
  EXPECT_TRUE(isZero(escape({{0.0, 0.0, 0.05}, Vector3d::Zero()}, {floorAt(0.001, Vector3d::Zero(), 0.049)}, 0.5)));
}

TEST(EscapeVelocityTest, CanStopBeforeWhatNoPlaneStandsFor) {
  const Twist up{{0.0, 0.0, 0.01}, Vector3d::Zero()};
  const Twist output_W = escapeVelocity(up, {}, {0.001, 0.0}, kLimits, kEscapeSpeed);
  EXPECT_NEAR(output_W.v_W.z(), stoppingSpeed(0.001, kLimits), 1e-12);
  EXPECT_LT(output_W.v_W.z(), 0.01);
}

TEST(EscapeVelocityTest, RefusesNaN) {
  const Twist command{{0.0, 0.0, std::numeric_limits<double>::quiet_NaN()}, Vector3d::Zero()};
  EXPECT_TRUE(has(refusal([&] { escape(command, {}); }), "commanded velocity"));
}

}  // namespace
}  // namespace sweep_guard_core
