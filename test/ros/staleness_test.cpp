// How soon silence is noticed, on the wall clock, with the default timeouts: 0.1 s for a pose, 0.5 s for a mesh.
#include <gtest/gtest.h>

#include <vector>

#include "guard_probe.h"
#include "sweep_guard/common/quantile.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Warning;
using sweep_guard_core::quantile;

// Returns when the warning was sent: it is valid for 0.2 s.
ros::Time sent(const Warning& warning) { return warning.valid_until - ros::Duration(0.2); }

// Sends a pose and the square until the guard is clear, and returns their newest stamps.
std::pair<ros::Time, ros::Time> stampsOfAClearScene(GuardProbe& probe) {
  while (true) {
    const auto vertices = squareMovedTo("square", {0.0, 0.0, -1.0}, ros::Time::now());
    probe.place(vertices);
    probe.skipWarnings();
    const auto pose = poseAt({0.0, 0.0, 0.5}, ros::Time::now());
    probe.publish(pose);
    const Warning next = probe.awaitWarning([&](const Warning& warning) {
      return warning.clear || sent(warning) > pose.header.stamp + ros::Duration(0.1);
    });
    if (next.clear) return {pose.header.stamp, vertices.header.stamp};
  }
}

// Load delays a few. The rounds begin at different times between two polls of the guard.
TEST(StalenessTest, SilenceIsUnknownInTime) {
  GuardProbe probe(/*drives_clock=*/false);
  probe.place(squareAt("square", {0.0, 0.0, -1.0}, ros::Time::now()));
  probe.publish(poseAt({0.0, 0.0, 0.5}, ros::Time::now()));  // two poses are a motion
  std::vector<double> poses_noticed;                         // [s]
  std::vector<double> mesh_noticed;                          // [s]
  for (int i = 0; i < 10; ++i) {
    ros::WallDuration(0.01 * i).sleep();
    const auto [pose, mesh] = stampsOfAClearScene(probe);
    const Warning no_poses = probe.awaitWarning([](const Warning& warning) { return !warning.clear; });
    EXPECT_EQ(no_poses.level, Warning::UNKNOWN);
    EXPECT_EQ(no_poses.reasons & ~std::uint32_t{Warning::MESH_STALE}, Warning::POSE_STALE) << no_poses.text;
    poses_noticed.push_back((sent(no_poses) - pose).toSec());
    const Warning no_mesh =
        probe.awaitWarning([](const Warning& warning) { return (warning.reasons & Warning::MESH_STALE) != 0; });
    mesh_noticed.push_back((sent(no_mesh) - mesh).toSec());
  }
  EXPECT_LE(quantile(poses_noticed, 0.5), 0.12) << ::testing::PrintToString(poses_noticed);
  EXPECT_LE(quantile(mesh_noticed, 0.5), 0.52) << ::testing::PrintToString(mesh_noticed);
}

}  // namespace
}  // namespace sweep_guard_ros
