// How soon silence is noticed, on the wall clock, with the default timeouts: 0.1 s for a pose, 0.5 s for a mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "guard_probe.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Warning;

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

// Load only delays: the shortest of ten times must be in time.
TEST(StalenessTest, SilenceIsUnknownInTime) {
  GuardProbe probe(/*drives_clock=*/false);
  probe.place(squareAt("square", {0.0, 0.0, -1.0}, ros::Time::now()));
  probe.publish(poseAt({0.0, 0.0, 0.5}, ros::Time::now()));  // two poses are a motion
  double poses_noticed = std::numeric_limits<double>::infinity();
  double mesh_noticed = poses_noticed;
  for (int i = 0; i < 10 && (poses_noticed > 0.15 || mesh_noticed > 0.55); ++i) {
    const auto [pose, mesh] = stampsOfAClearScene(probe);
    const Warning no_poses = probe.awaitWarning([](const Warning& warning) { return !warning.clear; });
    EXPECT_EQ(no_poses.level, Warning::UNKNOWN);
    EXPECT_NE(no_poses.reasons & Warning::POSE_STALE, 0U) << no_poses.text;
    poses_noticed = std::min(poses_noticed, (sent(no_poses) - pose).toSec());
    const Warning no_mesh =
        probe.awaitWarning([](const Warning& warning) { return (warning.reasons & Warning::MESH_STALE) != 0; });
    mesh_noticed = std::min(mesh_noticed, (sent(no_mesh) - mesh).toSec());
  }
  EXPECT_LE(poses_noticed, 0.15);
  EXPECT_LE(mesh_noticed, 0.55);
}

}  // namespace
}  // namespace sweep_guard_ros
