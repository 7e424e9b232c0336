// With the tool pose from tf, every received transform is swept like a pose on the topic.
#include <gtest/gtest.h>
#include <tf2_msgs/TFMessage.h>

#include "connected_publisher.h"
#include "guard_probe.h"
#include "transform_message.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Contacts;
using sweep_guard::Warning;

Eigen::Isometry3d pointingDownAt(double z) {
  return Eigen::Translation3d(0.0, 0.0, z) * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX());
}

GuardProbe& tfProbe() {
  static GuardProbe probe(/*drives_clock=*/true, ProbeSource::kTf);
  return probe;
}

// The base rests, and the drill on it. Then a driver moves the base.
TEST(TfSourceTest, AToolThatNothingMovesIsAtRestUntilSomethingDoes) {
  GuardProbe& probe = tfProbe();
  ConnectedPublisher<tf2_msgs::TFMessage> mount("/tf_static", /*latch=*/true);
  tf2_msgs::TFMessage at_rest;
  at_rest.transforms = {transformMsg("world", "base", Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 0.2))),
                        transformMsg("base", "drill", pointingDownAt(0.3))};
  (*mount).publish(at_rest);
  probe.place(squareAt("square", {0.0, 0.0, 0.0}, probe.time()));
  Warning warning;
  for (int i = 0; i < 400 && !warning.clear; ++i) {
    probe.tick(0.001);
    warning = probe.awaitWarning([](const Warning&) { return true; });
  }
  EXPECT_TRUE(warning.clear) << warning.text;

  ConnectedPublisher<tf2_msgs::TFMessage> driver("/tf");
  probe.forgetContacts();
  for (int i = 1; i <= 20; ++i) {
    probe.tick(0.01);
    tf2_msgs::TFMessage moved;
    const Eigen::Isometry3d X(Eigen::Translation3d(0.0, 0.0, 0.2 - 0.03 * i));
    moved.transforms = {transformMsg("world", "base", X, probe.time())};
    (*driver).publish(moved);
  }
  const std::vector<Contacts> contacts = probe.awaitContactsUpTo(probe.time());
  EXPECT_TRUE(endToEnd(contacts));
  probe.awaitWarning([](const Warning& next) { return next.contact; });
}

TEST(TfSourceTest, SweepsFromTransformToTransform) {
  GuardProbe& probe = tfProbe();
  probe.reset();
  probe.forgetContacts();
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
