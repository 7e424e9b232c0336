// Loads and unloads the guard in a nodelet manager under a stream of poses and meshes: the manager must survive.
#include <gtest/gtest.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>

#include "guard_probe.h"

namespace sweep_guard_ros {
namespace {

class NodeletReloadTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(ros::service::waitForService("/manager/load_nodelet", ros::Duration(20.0)));
    ASSERT_TRUE(ros::service::waitForService("/manager/unload_nodelet", ros::Duration(20.0)));
  }

  static bool load(const std::string& name) {
    nodelet::NodeletLoad call;
    call.request.name = name;
    call.request.type = "sweep_guard/SweepGuardNodelet";
    return ros::service::call("/manager/load_nodelet", call) && call.response.success;
  }

  static bool unload(const std::string& name) {
    nodelet::NodeletUnload call;
    call.request.name = name;
    return ros::service::call("/manager/unload_nodelet", call) && call.response.success;
  }
};

TEST_F(NodeletReloadTest, TheManagerOutlivesGuardsUnloadedUnderLoad) {
  for (int cycle = 0; cycle < 5; ++cycle) {
    ASSERT_TRUE(load("/sweep_guard")) << "cycle " << cycle;
    GuardProbe probe(/*drives_clock=*/false);
    probe.place(squareAt("square", {0.0, 0.0, 0.0}, ros::Time::now()));
    for (int i = 0; i < 1000; ++i) probe.publish(poseAt({0.0, 0.0, 0.0}, ros::Time::now()));
    ASSERT_TRUE(unload("/sweep_guard")) << "cycle " << cycle;
  }
}

TEST_F(NodeletReloadTest, ASecondGuardLeavesTheFirstAlone) {
  ASSERT_TRUE(load("/sweep_guard"));
  GuardProbe probe(/*drives_clock=*/false);
  probe.place(squareAt("square", {0.0, 0.0, 0.0}, ros::Time::now()));
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(load("/second"));
    EXPECT_EQ(probe.move(poseAt({0.0, 0.0, 0.0}, ros::Time::now())).objects.size(), 1U);
    ASSERT_TRUE(unload("/second"));
    EXPECT_EQ(probe.move(poseAt({0.0, 0.0, 0.0}, ros::Time::now())).objects.size(), 1U);
  }
  ASSERT_TRUE(unload("/sweep_guard"));
}

}  // namespace
}  // namespace sweep_guard_ros
