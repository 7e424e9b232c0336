// With the tool pose from tf, every received transform is swept like a pose on the topic.
#include <gtest/gtest.h>

#include "guard_probe.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Contacts;
using sweep_guard::Warning;

Eigen::Isometry3d pointingDownAt(double z) {
  return Eigen::Translation3d(0.0, 0.0, z) * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX());
}

TEST(TfSourceTest, SweepsFromTransformToTransform) {
  GuardProbe probe(/*drives_clock=*/true, PoseSource::kTf);
  probe.place(squareAt("square", {0.0, 0.0, 0.0}, probe.time()));

  probe.tick(0.01);
  const ros::Time start = probe.time();
  probe.placeFrame("drill", pointingDownAt(0.5));
  EXPECT_TRUE(probe.awaitContacts(1).back().objects.empty());
  for (int i = 0; i < 20; ++i) {
    probe.tick(0.001);
    probe.placeFrame("drill", pointingDownAt(0.5));
  }
  probe.tick(0.01);
  probe.placeFrame("drill", pointingDownAt(-0.5));

  const std::vector<Contacts> contacts = probe.awaitContactsUpTo(probe.time());
  ASSERT_GE(contacts.size(), 2U);
  EXPECT_EQ(contacts.front().header.stamp, start);
  EXPECT_TRUE(endToEnd(contacts));
  EXPECT_EQ(contacts.back().header.stamp, probe.time());
  EXPECT_EQ(contacts.back().objects.size(), 1U);
  const Warning warning = probe.awaitWarning([](const Warning& candidate) { return candidate.contact; });
  EXPECT_EQ(warning.tool, "drill");
}

}  // namespace
}  // namespace sweep_guard_ros
