#include "simulation/joystick.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sweep_guard/common/error.h"

namespace sweep_guard_simulation {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;

const sweep_guard_core::Time kNow(std::chrono::seconds(100));

Joystick::Options plain() {
  Joystick::Options options;
  options.linear = {1, 2, 4};
  options.angular = {10, 20, 40};
  options.dead_zone = 0.5;
  return options;
}

TEST(JoystickTest, MovesAndTurnsAlongTheAxesOfTheDevice) {
  Joystick joystick(plain());
  joystick.setAxes({1, 1, 1, 1, -1, 1}, kNow);
  EXPECT_EQ(joystick.velocity(kNow).v_W, Vector3d(1, 2, 4));
  EXPECT_EQ(joystick.velocity(kNow).w_W, Vector3d(10, -20, 40));
}

TEST(JoystickTest, RisesFromNothingAtTheBorderOfTheDeadZone) {
  Joystick joystick(plain());
  joystick.setAxes({0.5F, -0.75F, 0.25F, -0.5F, 0.75F, 3.0F}, kNow);
  EXPECT_EQ(joystick.velocity(kNow).v_W, Vector3d(0, -1, 0));
  EXPECT_EQ(joystick.velocity(kNow).w_W, Vector3d(0, 10, 40));
}

TEST(JoystickTest, MappingSwapsReversesAndLeavesOut) {
  Joystick::Options options = plain();
  options.linear_axes = {2, -1, 0};
  options.linear.z() = -4;
  Joystick joystick(options);
  joystick.setAxes({1, 1, 0, 0, 0, 0}, kNow);
  EXPECT_EQ(joystick.velocity(kNow).v_W, Vector3d(0, 0, -4));
}

TEST(JoystickTest, RestsBeforeTheFirstMessageAndWhenMessagesStop) {
  Joystick joystick(plain());
  EXPECT_EQ(joystick.velocity(kNow).v_W, Vector3d::Zero());
  joystick.setAxes({1, 0, 0, 0, 0, 0}, kNow);
  EXPECT_EQ(joystick.velocity(kNow + milliseconds(250)).v_W, Vector3d(1, 0, 0));
  EXPECT_EQ(joystick.velocity(kNow + milliseconds(251)).v_W, Vector3d::Zero());
}

TEST(JoystickTest, RestsWhenReleasedUntilAMessageComesAfterwards) {
  Joystick joystick(plain());
  joystick.setAxes({1, 0, 0, 0, 0, 0}, kNow);
  joystick.ignoreUntil(kNow + milliseconds(100));
  EXPECT_EQ(joystick.velocity(kNow).v_W, Vector3d::Zero());
  joystick.setAxes({1, 0, 0, 0, 0, 0}, kNow + milliseconds(99));
  EXPECT_EQ(joystick.velocity(kNow + milliseconds(99)).v_W, Vector3d::Zero());
  joystick.setAxes({1, 0, 0, 0, 0, 0}, kNow + milliseconds(100));
  EXPECT_EQ(joystick.velocity(kNow + milliseconds(100)).v_W, Vector3d(1, 0, 0));
}

TEST(JoystickTest, RefusesADeviceOfFewerAxesAndNumbersThatAreNone) {
  Joystick joystick(plain());
  EXPECT_THROW(joystick.setAxes({1, 1}, kNow), sweep_guard_core::InvalidInput);
  EXPECT_THROW(joystick.setAxes({1, 1, 1, 1, 1, NAN}, kNow), sweep_guard_core::InvalidInput);
  EXPECT_EQ(joystick.velocity(kNow).v_W, Vector3d::Zero());
}

TEST(JoystickTest, RefusesOptionsOutOfRange) {
  Joystick::Options options;
  options.dead_zone = 1.0;
  EXPECT_THROW(Joystick{options}, sweep_guard_core::InvalidInput);
  options.dead_zone = 0.0;
  options.timeout = milliseconds(0);
  EXPECT_THROW(Joystick{options}, sweep_guard_core::InvalidInput);
}

}  // namespace
}  // namespace sweep_guard_simulation
