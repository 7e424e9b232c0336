// Loads and unloads the guard in a nodelet manager under a stream of poses and meshes: the manager must survive.
#include <gtest/gtest.h>

#include "guard_probe.h"
#include "nodelet_manager.h"

namespace sweep_guard_ros {
namespace {

class NodeletReloadTest : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(awaitManager()); }
};

TEST_F(NodeletReloadTest, TheManagerOutlivesGuardsUnloadedUnderLoad) {
  for (int cycle = 0; cycle < 5; ++cycle) {
    ASSERT_TRUE(loadGuard("/sweep_guard")) << "cycle " << cycle;
    GuardProbe probe(/*drives_clock=*/false);
    probe.place(squareAt("square", {0.0, 0.0, 0.0}, ros::Time::now()));
    for (int i = 0; i < 1000; ++i) probe.publish(poseAt({0.0, 0.0, 0.0}, ros::Time::now()));
    ASSERT_TRUE(unloadGuard("/sweep_guard")) << "cycle " << cycle;
  }
}

TEST_F(NodeletReloadTest, ASecondGuardLeavesTheFirstAlone) {
  ASSERT_TRUE(loadGuard("/sweep_guard"));
  GuardProbe probe(/*drives_clock=*/false);
  probe.place(squareAt("square", {0.0, 0.0, 0.0}, ros::Time::now()));
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(loadGuard("/second"));
    EXPECT_EQ(probe.move(poseAt({0.0, 0.0, 0.0}, ros::Time::now())).objects.size(), 1U);
    ASSERT_TRUE(unloadGuard("/second"));
    EXPECT_EQ(probe.move(poseAt({0.0, 0.0, 0.0}, ros::Time::now())).objects.size(), 1U);
  }
  ASSERT_TRUE(unloadGuard("/sweep_guard"));
}

}  // namespace
}  // namespace sweep_guard_ros
