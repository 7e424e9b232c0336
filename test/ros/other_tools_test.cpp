// Plays the guard of another tool to a running guard.
#include <gtest/gtest.h>
#include <sweep_guard/ToolBodies.h>
#include <sweep_guard/ToolSurface.h>

#include "node_fixture.h"
#include "sweep_guard/geometry/link_surface.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Warning;

// The guard of a cube.
class Peer {
 public:
  // From now on, in a run of its own.
  void start(const std::string& run_id, double half_side) {
    begin(run_id);
    publishSurface(half_side);
  }
  void begin(const std::string& run_id) {
    run_id_ = run_id;
    sequence_ = 0;
  }
  void publishSurface(double half_side) {
    const auto box = sweep_guard_core::ConvexShape::box(Eigen::Vector3d::Constant(half_side));
    const sweep_guard_core::LinkSurface surface = sweep_guard_core::linkSurfaces(sweep_guard_core::Tool(box))[0];
    sweep_guard::ToolSurface msg;
    msg.run_id = run_id_;
    msg.revision = 1;
    auto& link = msg.links.emplace_back();
    link.link = "hand";
    for (const Eigen::Vector3d& p : surface.vertices_B)
      link.mesh.vertices.push_back(vectorMsg<geometry_msgs::Point>(p));
    for (const auto& [a, b, c] : surface.triangles) link.mesh.triangles.emplace_back().vertex_indices = {a, b, c};
    surface_publisher_.publish(msg);
  }
  void publishAt(const Eigen::Vector3d& place, ros::Time stamp) {
    sweep_guard::ToolBodies msg;
    msg.header.stamp = stamp;
    msg.header.frame_id = "world";
    msg.run_id = run_id_;
    msg.revision = 1;
    msg.sequence = ++sequence_;
    msg.predicted_from = stamp;
    auto& body = msg.bodies.emplace_back();
    body.pose = sweep_guard_ros::toMsg(Eigen::Isometry3d(Eigen::Translation3d(place)));
    for (int i = 0; i <= 24; ++i) {
      auto& pose = body.predicted.emplace_back();
      pose.from_now = ros::Duration(0.1 * i);
      pose.pose = body.pose;
      body.predicted_deviation_bounds.push_back(i == 0 ? 0.0 : predicted_deviation_bound_);
    }
    bodies_publisher_.publish(msg);
  }
  void lose() { ++sequence_; }
  void leavePredictedPathBy(double bound) { predicted_deviation_bound_ = bound; }

 private:
  ros::NodeHandle node_{"/peer"};
  ros::Publisher surface_publisher_ = node_.advertise<sweep_guard::ToolSurface>("surface", 1, /*latch=*/true);
  ros::Publisher bodies_publisher_ = node_.advertise<sweep_guard::ToolBodies>("bodies", 10);
  std::string run_id_;
  std::uint32_t sequence_ = 0;
  double predicted_deviation_bound_ = 0.0;
};

const Eigen::Vector3d kFar(1.0, 0.0, 0.0);
const Eigen::Vector3d kInFront(0.0, 0.0, -0.05);  // in front of the tip

bool saysOfThePeer(const Warning& warning, const std::string& text) {
  return hasReason(Warning::NOT_COVERED)(warning) && warning.text.find(text) != std::string::npos &&
         warning.text.find("'/peer'") != std::string::npos;
}

class OtherToolsTest : public testing::Test {
 protected:
  // Both tools rest, as the guard sees them, until a warning fits; without a place, the peer is silent.
  Warning restUntil(const std::optional<Eigen::Vector3d>& peer_at, const std::function<bool(const Warning&)>& fits) {
    Warning warning;
    for (int i = 0; i < 1000; ++i) {
      probe().tick(0.01);
      if (peer_at) peer().publishAt(*peer_at, probe().time());
      probe().publish(poseAt({0.0, 0.0, 0.0}, probe().time()));
      probe().skipWarnings();
      warning = probe().awaitWarning([](const Warning&) { return true; });
      if (fits(warning)) return warning;
    }
    ADD_FAILURE() << "no such warning; the last: " << warning.text;
    return {};
  }

  static Peer& peer() {
    static Peer peer;
    return peer;
  }
};

TEST_F(OtherToolsTest, ASilentToolIsUnknown) {
  restUntil({}, [](const Warning& warning) { return saysOfThePeer(warning, "has not been heard of"); });
  peer().begin("first");
  restUntil(kFar, [](const Warning& warning) { return saysOfThePeer(warning, "its surface has not come"); });
  peer().publishSurface(0.01);
  restUntil(kFar, isClear);
  restUntil({}, [](const Warning& warning) { return saysOfThePeer(warning, "newest pose of the tool of"); });
  probe().awaitStatus("other tools", [](const auto& status) {
    return status.message == "'/peer' does not count" && valueOf(status, "'/peer'").find(" s old") != std::string::npos;
  });
  restUntil(kFar, isClear);
}

TEST_F(OtherToolsTest, AContactNamesBothLinks) {
  peer().start("touching", 0.02);
  restUntil(kFar, isClear);
  const Warning warning =
      restUntil(Eigen::Vector3d(0.0, 0.0, -0.01), [](const Warning& one) { return one.level == Warning::CONTACT; });
  EXPECT_EQ(warning.mesh_id, "/peer/hand");
  EXPECT_EQ(warning.tool_link, "needle");
  restUntil(kFar, isClear);
}

TEST_F(OtherToolsTest, ARestartedToolIsUnknownUntilItsSurfaceComesAndThenHasThatSurface) {
  peer().start("small", 0.01);
  restUntil(kInFront, [](const Warning& warning) { return warning.reasons == 0 && warning.level != Warning::CONTACT; });
  peer().begin("large");
  restUntil(kInFront, [](const Warning& warning) { return saysOfThePeer(warning, "its surface has not come"); });
  peer().publishSurface(0.1);
  const Warning warning = restUntil(kInFront, [](const Warning& one) { return one.level == Warning::CONTACT; });
  EXPECT_EQ(warning.mesh_id, "/peer/hand");
  peer().start("small again", 0.01);
  restUntil(kFar, isClear);
}

// As that of an arm whose joints move.
TEST_F(OtherToolsTest, WhatMayLieBesideThePredictedPathIsForeseen) {
  peer().start("bending", 0.01);
  restUntil(kFar, isClear);
  peer().leavePredictedPathBy(1.5);
  const Warning warning = restUntil(kFar, [](const Warning& one) { return one.level == Warning::REFLEX; });
  EXPECT_EQ(warning.mesh_id, "/peer/hand");
  peer().leavePredictedPathBy(-1.0);
  restUntil(kFar, [](const Warning& one) { return saysOfThePeer(one, "deviation bound"); });
  peer().leavePredictedPathBy(0.0);
  restUntil(kFar, isClear);
}

TEST_F(OtherToolsTest, PosesThatWereLostAreUnknown) {
  peer().start("losing", 0.01);
  restUntil(kFar, isClear);
  peer().lose();
  probe().skipWarnings();
  probe().tick(0.01);
  peer().publishAt(kFar, probe().time());
  probe().awaitWarning(hasReason(Warning::POSES_UNSWEPT));
  restUntil(kFar, isClear);
}

// Whoever publishes meshes cannot replace the other tool.
TEST_F(OtherToolsTest, AMeshIsNoLinkOfAnotherTool) {
  peer().start("kept", 0.02);
  restUntil(kFar, isClear);
  probe().skipWarnings();
  probe().publish(squareAt("/peer/hand", {5.0, 5.0, 5.0}, probe().time()));
  probe().awaitWarning(hasReason(Warning::MESH_INVALID));
  restUntil(Eigen::Vector3d(0.0, 0.0, -0.01), [](const Warning& one) { return one.level == Warning::CONTACT; });
  restUntil(kFar, [](const Warning& warning) { return warning.level != Warning::CONTACT; });
}

}  // namespace
}  // namespace sweep_guard_ros
