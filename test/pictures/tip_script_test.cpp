#include "pictures/tip_script.h"

#include <gtest/gtest.h>

#include "sweep_guard/common/error.h"

namespace sweep_guard_simulation {
namespace {

TipScript script() { return TipScript({"1 0 0 0.5 0 0 0", "2 0.1 0 0.4 0 0.2 0", "4 0.2 0.1 0.1 0 0 0"}); }

TEST(TipScriptTest, PassesThroughEveryPoseAtItsTime) {
  EXPECT_TRUE(script().pose(1.0).translation().isApprox(Eigen::Vector3d(0.0, 0.0, 0.5), 1e-12));
  EXPECT_TRUE(script().pose(2.0).translation().isApprox(Eigen::Vector3d(0.1, 0.0, 0.4), 1e-12));
  EXPECT_TRUE(script().pose(4.0).translation().isApprox(Eigen::Vector3d(0.2, 0.1, 0.1), 1e-12));
}

TEST(TipScriptTest, StaysBeforeTheFirstAndAfterTheLast) {
  EXPECT_TRUE(script().pose(0.0).isApprox(script().pose(1.0), 1e-12));
  EXPECT_TRUE(script().pose(9.0).isApprox(script().pose(4.0), 1e-12));
}

TEST(TipScriptTest, PointsDownAndTurnsAboutTheAxesOfTheWorld) {
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  EXPECT_TRUE((script().pose(1.0).linear() * z).isApprox(-z, 1e-12));
  const Eigen::AngleAxisd turn(0.2, Eigen::Vector3d::UnitY());
  EXPECT_TRUE((script().pose(2.0).linear() * z).isApprox(turn * -z, 1e-12));
}

// A jump of the rate would be three tenths of a meter per second.
TEST(TipScriptTest, HasOneVelocityOnBothSidesOfAPose) {
  const double h = 1e-6;
  const Eigen::Vector3d at = script().pose(2.0).translation();
  const Eigen::Vector3d before = (at - script().pose(2.0 - h).translation()) / h;
  const Eigen::Vector3d after = (script().pose(2.0 + h).translation() - at) / h;
  EXPECT_LT((after - before).norm(), 1e-5);
}

TEST(TipScriptTest, RefusesWhatIsNoMotion) {
  EXPECT_THROW(TipScript({"0 0 0 0 0 0 0"}), sweep_guard_core::InvalidInput);
  EXPECT_THROW(TipScript({"0 0 0 0 0 0 0", "0 1 0 0 0 0 0"}), sweep_guard_core::InvalidInput);
  EXPECT_THROW(TipScript({"0 0 0 0 0 0", "1 0 0 0 0 0 0"}), sweep_guard_core::InvalidInput);
  EXPECT_THROW(TipScript({"0 0 0 0 0 0 0", "1 0 0 0 0 0 0 7"}), sweep_guard_core::InvalidInput);
  EXPECT_THROW(TipScript({"0 0 0 0 0 0 0", "1 0 0 nan 0 0 0"}), sweep_guard_core::InvalidInput);
}

}  // namespace
}  // namespace sweep_guard_simulation
