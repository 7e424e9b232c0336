// On the wall clock, with the default timeouts of 0.1 s for a pose and 0.5 s for a mesh: how soon silence is noticed.
#include <gtest/gtest.h>

#include "guard_probe.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Warning;

// When the warning was sent: it is valid for 0.2 s.
ros::Time sent(const Warning& warning) { return warning.valid_until - ros::Duration(0.2); }

TEST(StalenessTest, SilenceIsUnknownInTime) {
  GuardProbe probe(/*drives_clock=*/false);
  probe.place(sheetAt("sheet", {0.0, 0.0, -1.0}, ros::Time::now()));
  const auto vertices = sheetMovedTo("sheet", {0.0, 0.0, -1.0}, ros::Time::now());
  probe.place(vertices);
  const auto pose = poseAt({0.0, 0.0, 0.5}, ros::Time::now());
  probe.publish(poseAt({0.0, 0.0, 0.5}, pose.header.stamp - ros::Duration(0.01)));  // two poses are a motion
  probe.publish(pose);
  probe.awaitWarning([](const Warning& warning) { return warning.clear; });

  const Warning no_poses = probe.awaitWarning([](const Warning& warning) { return !warning.clear; });
  EXPECT_EQ(no_poses.level, Warning::UNKNOWN);
  EXPECT_EQ(no_poses.reasons, Warning::POSE_STALE) << no_poses.text;
  EXPECT_LE((sent(no_poses) - pose.header.stamp).toSec(), 0.15);

  const Warning no_mesh =
      probe.awaitWarning([](const Warning& warning) { return (warning.reasons & Warning::MESH_STALE) != 0; });
  EXPECT_LE((sent(no_mesh) - vertices.header.stamp).toSec(), 0.55);
}

}  // namespace
}  // namespace sweep_guard_ros

int main(int argc, char** argv) {
  ros::init(argc, argv, "staleness_test");
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
