// The demo led by a recorded motion, test/ros/motion.txt.
#include <gtest/gtest.h>

#include "demo_listener.h"

namespace sweep_guard_ros {
namespace {

TEST(OperateRecordingTest, EveryPoseComesAtTheIntervalItWasRecordedAt) {
  const DemoListener listener;
  const DemoListener::Poses poses = listener.awaitPoses(6);
  const std::vector<double> stamps = {0.00, 0.01, 0.03, 0.03, 0.10, 0.20};           // [s] since the first
  const std::vector<double> distances = {0.000, 0.001, 0.003, 0.004, 0.006, 0.008};  // [m] along x since the first
  ASSERT_EQ(poses.size(), stamps.size());
  for (size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ((poses[i].header.stamp - poses[0].header.stamp).toNSec(), ros::Duration(stamps[i]).toNSec());
    EXPECT_NEAR((positionOf(poses[i]) - positionOf(poses[0])).x(), distances[i], 1e-9);
  }
}

}  // namespace
}  // namespace sweep_guard_ros
