// The forearm of arm.urdf with its two fingers: its pose is on `tool_pose`, the jaw is on `joint_states`.
#include <gtest/gtest.h>
#include <sensor_msgs/JointState.h>
#include <sweep_guard/Attach.h>
#include <sweep_guard/Interaction.h>

#include <cmath>
#include <limits>
#include <map>

#include "cube.h"
#include "guard_probe.h"
#include "node_fixture.h"
#include "proximity_listener.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Contacts;
using sweep_guard::Proximity;
using sweep_guard::ToolBalls;
using sweep_guard::Warning;

class GripperTest : public testing::Test {
 protected:
  void SetUp() override {
    probe().place(squareAt("square", {0.22, 0.02, 0.0}, probe().time(), 0.003));
    step(0.5, 0.04);
    restAtFullWidth();
  }

  // The forearm along x at this height, level with the fingers that it carries.
  static void publishPose(double z) {
    geometry_msgs::PoseStamped pose = poseAt({0.0, 0.0, z}, probe().time());
    pose.pose.orientation = geometry_msgs::Quaternion();
    pose.pose.orientation.w = 1.0;
    probe().publish(pose);
  }

  static void publishJaw(double jaw) {
    static ros::Publisher publisher = ros::NodeHandle().advertise<sensor_msgs::JointState>("joint_states", 1000);
    sensor_msgs::JointState message;
    message.header.stamp = probe().time();
    message.name = {"jaw"};
    message.position = {jaw};
    publisher.publish(message);
  }

  static Warning step(double z, double jaw) {
    probe().tick(0.01);
    publishPose(z);
    publishJaw(jaw);
    return probe().awaitWarning([](const Warning&) { return true; });
  }

  // Poses that are swept before the guard knows a subscriber have no message.
  template <typename Message>
  static Message messageAt(const TopicListener<Message>& listener, double jaw) {
    step(0.0, jaw);
    while (listener.all().empty()) step(0.0, jaw);
    const ros::Time stamp = probe().time();
    return listener.awaitNewest([&](const auto& message) { return message.header.stamp >= stamp; });
  }

  // A cube below the left finger, and a plate beside the cube.
  static void placePayload() {
    probe().place(cubeAt("payload", {0.22, 0.045, -0.025}, probe().time(), 0.005));
    probe().place(squareAt("plate", {0.22, 0.02, -0.025}, probe().time(), 0.003));
    restAtFullWidth();
  }
  static void restAtFullWidth() {
    while (!isClear(step(0.0, 0.04))) {
    }
  }
  static void attachPayload(bool attach) {
    sweep_guard::Attach attached;
    attached.request.mesh_id = "payload";
    attached.request.link = attach ? "left" : "";
    attached.request.attach = attach;
    step(0.0, 0.04);
    ASSERT_TRUE(ros::service::call("/sweep_guard/attach", attached));
    ASSERT_TRUE(attached.response.success) << attached.response.message;
  }
  static void removePayload() {
    attachPayload(false);
    for (const char* const id : {"payload", "plate"}) probe().remove(id);
  }
};

TEST_F(GripperTest, TheFingerThatClosesIsNamedWhileTheForearmRests) {
  probe().forgetContacts();
  for (int i = 0; i <= 20; ++i) step(0.0, 0.04 - 0.002 * i);
  std::set<std::string> links;
  for (const Contacts& sweep : probe().awaitContactsUpTo(probe().time())) {
    for (const auto& object : sweep.objects) {
      for (const auto& impact : object.impacts) links.insert(impact.tool_link);
    }
  }
  EXPECT_EQ(links, std::set<std::string>{"left"});
}

// The square faces up: what it presses on is the lower half of the finger.
TEST_F(GripperTest, TheForceOnAFingerIsAtTheToolFrame) {
  const TopicListener<sweep_guard::Interaction> forces("interaction");
  EXPECT_TRUE(messageAt(forces, 0.04).objects.empty());
  const sweep_guard::Interaction force = messageAt(forces, 0.015);
  EXPECT_TRUE(force.valid);
  ASSERT_EQ(force.objects.size(), 1U);
  EXPECT_EQ(force.objects[0].mesh_id, "square");
  EXPECT_NEAR(force.objects[0].volume, 0.006 * 0.006 * 0.01, 1e-12);
  EXPECT_NEAR(force.objects[0].centroid.x, 0.22, 1e-6);
  EXPECT_NEAR(force.objects[0].centroid.y, 0.02, 1e-6);
  EXPECT_NEAR(force.objects[0].centroid.z, -0.005, 1e-6);
  EXPECT_NEAR(force.wrench.force.z, 0.36, 1e-6);
  EXPECT_NEAR(force.wrench.torque.x, 0.02 * 0.36, 1e-6);
  EXPECT_NEAR(force.wrench.torque.y, -0.22 * 0.36, 1e-6);
}

// A plate below the fingers is in the way of the cube alone.
TEST_F(GripperTest, WhatAFingerHoldsMovesWithIt) {
  placePayload();
  attachPayload(true);
  restAtFullWidth();
  probe().forgetContacts();
  for (int i = 0; i <= 10; ++i) step(0.0, 0.04 - 0.002 * i);
  std::set<std::string> links;
  for (const Contacts& sweep : probe().awaitContactsUpTo(probe().time())) {
    for (const auto& object : sweep.objects) {
      for (const auto& impact : object.impacts) {
        if (object.mesh_id == "plate") links.insert(impact.tool_link);
      }
    }
  }
  EXPECT_EQ(links, std::set<std::string>{"payload"});
  removePayload();
}

std::map<std::string, std::string> framesOf(const ToolBalls& balls) {
  std::map<std::string, std::string> frames;
  for (const auto& piece : balls.pieces) frames[piece.link] = piece.frame;
  return frames;
}

// The square is 7 mm beside the left finger.
TEST_F(GripperTest, EachLinkHasPlanesAtThePositionOfTheJaw) {
  const TopicListener<ToolBalls> tool("tool_balls");
  const TopicListener<Proximity> planes("proximity");
  const Proximity found = messageAt(planes, 0.03);
  const ToolBalls balls = tool.awaitNewest([&](const auto& each) { return each.revision == found.tool_revision; });
  EXPECT_TRUE(found.valid);
  EXPECT_EQ(found.joints, std::vector<std::string>{"jaw"});
  EXPECT_EQ(found.positions, std::vector<double>{0.03});
  EXPECT_EQ(framesOf(balls), (std::map<std::string, std::string>{{"fore", ""}, {"left", "left"}, {"right", "right"}}));
  std::map<std::string, double> gaps;
  for (const auto& plane : found.planes) {
    EXPECT_EQ(plane.tool_link, balls.pieces.at(plane.piece).link);
    gaps.emplace(plane.tool_link, plane.gap);  // the nearest is the first
  }
  EXPECT_NEAR(gaps.at("left"), 0.95 * 0.007, 1e-5);
  EXPECT_NEAR(gaps.at("right"), 0.95 * 0.047, 1e-5);
  EXPECT_NEAR(gaps.at("fore"), 0.95 * std::hypot(0.017, 0.007), 1e-5);
}

TEST_F(GripperTest, WhatAFingerHoldsHasBallsAndPlanes) {
  placePayload();
  const TopicListener<ToolBalls> tool("tool_balls");
  const TopicListener<Proximity> planes("proximity");
  const std::uint32_t before = messageAt(planes, 0.04).tool_revision;
  attachPayload(true);
  const ToolBalls balls = tool.awaitNewest([](const ToolBalls& each) { return framesOf(each).count("payload") > 0; });
  EXPECT_EQ(balls.revision, before + 1);
  EXPECT_EQ(framesOf(balls).at("payload"), "left");
  restAtFullWidth();
  const Proximity found = messageAt(planes, 0.03);
  EXPECT_EQ(found.tool_revision, balls.revision);
  double gap = std::numeric_limits<double>::infinity();
  for (const auto& plane : found.planes) {
    if (plane.tool_link == "payload" && plane.mesh_id == "plate") gap = std::min(gap, plane.gap);
  }
  EXPECT_NEAR(gap, 0.95 * 0.006, 1e-4);  // grown by 1 mm
  removePayload();
  tool.awaitNewest([](const ToolBalls& each) { return framesOf(each).count("payload") == 0; });
}

TEST_F(GripperTest, ASilentPoseIsNamed) {
  Warning warning;
  for (int i = 0; i < 200 && warning.text.find("the tool pose has been silent") == std::string::npos; ++i) {
    probe().advance(0.01);
    publishJaw(0.04);
    warning = probe().awaitWarning([](const Warning&) { return true; });
  }
  EXPECT_TRUE(hasReason(Warning::POSE_STALE)(warning)) << warning.text;
  EXPECT_NE(warning.text.find("the tool pose has been silent"), std::string::npos) << warning.text;
}

}  // namespace
}  // namespace sweep_guard_ros
