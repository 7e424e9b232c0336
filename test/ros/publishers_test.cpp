// Two nodes publish one tf frame: the test, and a relay of what the test sends it.
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>

#include "connected_publisher.h"
#include "node_fixture.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Warning;

ros::Publisher& otherRobot() {
  static ConnectedPublisher<tf2_msgs::TFMessage> publisher("/other_robot/tf");
  return *publisher;
}

Eigen::Isometry3d raisedBy(double z) { return Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, z)); }

bool hasSeveral(const Warning& warning) { return (warning.reasons & Warning::MULTI_PUBLISHER) != 0; }

class PublishersTest : public NodeTest {
 protected:
  // The other robot publishes every third time.
  void step(const std::string& frame, double z, double other_z) {
    probe().tick(0.01);
    probe().placeFrame(frame, raisedBy(z));
    if (++steps_ % 3 != 0) return;
    tf2_msgs::TFMessage message;
    message.transforms.push_back(tf2::eigenToTransform(raisedBy(other_z)));
    message.transforms[0].header.frame_id = "world";
    message.transforms[0].header.stamp = probe().time();
    message.transforms[0].child_frame_id = frame;
    otherRobot().publish(message);
  }

  // Tool at rest, its pose in a frame, until a warning fits.
  Warning stepUntil(const std::string& frame, double other_z, const std::string& of_pose,
                    const std::function<bool(const Warning&)>& fits) {
    for (int i = 0; i < 2000; ++i) {
      step(frame, 0.0, other_z);
      auto pose = poseAt(kAway, probe().time());
      pose.header.frame_id = of_pose;
      probe().publish(pose);
      Warning warning = probe().awaitWarning([](const Warning&) { return true; });
      if (fits(warning)) return warning;
    }
    ADD_FAILURE() << "no such warning; the last: " << probe().warnings().back().text;
    return {};
  }

  void expectNeverClear(const std::string& frame, const std::string& of_pose) {
    const Warning first = stepUntil(frame, 0.02, of_pose, hasSeveral);
    EXPECT_NE(first.text.find("frame '" + frame + "'"), std::string::npos) << first.text;
    EXPECT_NE(first.text.find("'/other_robot'"), std::string::npos) << first.text;
    const size_t begin = probe().warnings().size();
    int steps = 0;
    stepUntil(frame, 0.02, of_pose, [&](const Warning&) { return ++steps == 100; });
    const auto warnings = probe().warnings();
    EXPECT_TRUE(std::none_of(warnings.begin() + static_cast<std::ptrdiff_t>(begin), warnings.end(), isClear));
    stepUntil(frame, 0.0, of_pose, isClear);
  }

  int steps_ = 0;
};

TEST_F(PublishersTest, AFrameOfTheToolThatTwoNodesPublishIsNeverClear) {
  placeSquare("square", kSquare);
  stepUntil("base", 0.0, "base", isClear);
  expectNeverClear("base", "base");
}

TEST_F(PublishersTest, AFrameOfAWorkpieceThatTwoNodesPublishIsNeverClear) {
  step("tray", 0.0, 0.0);
  placeSquare("square", kSquare, "tray");
  expectNeverClear("tray", "world");
}

TEST_F(PublishersTest, WhatNobodyUsesOrBothAgreeUponIsClear) {
  placeSquare("square", kSquare);
  stepUntil("camera", 0.02, "world", isClear);
  const size_t begin = probe().warnings().size();
  int steps = 0;
  stepUntil("camera", 0.02, "world", [&](const Warning&) { return ++steps == 100; });
  stepUntil("arm", 0.0, "arm", isClear);
  steps = 0;
  stepUntil("arm", 0.0, "arm", [&](const Warning&) { return ++steps == 100; });
  const auto warnings = probe().warnings();
  EXPECT_TRUE(std::none_of(warnings.begin() + static_cast<std::ptrdiff_t>(begin), warnings.end(), hasSeveral));
}

}  // namespace
}  // namespace sweep_guard_ros
