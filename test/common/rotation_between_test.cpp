#include "common/rotation_between.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sweep_guard_core {
namespace {

using Eigen::Vector3d;

TEST(RotationBetweenTest, TakesADirectionToAnotherByTheSmallestAngleAlsoToItsOpposite) {
  const Vector3d from(0.0, 0.0, 2.0);
  for (const Vector3d& to : {Vector3d(0.0, 0.0, 0.1), {3.0, 0.0, 0.0}, {0.0, -1e-3, 1.0}, {0.0, 0.0, -5.0}}) {
    const Eigen::Quaterniond turn = rotationBetween(from, to);
    EXPECT_TRUE((turn * from.normalized()).isApprox(to.normalized(), 1e-12)) << to.transpose();
    EXPECT_NEAR(Eigen::AngleAxisd(turn).angle(), std::acos(from.normalized().dot(to.normalized())), 1e-7);
  }
}

}  // namespace
}  // namespace sweep_guard_core
