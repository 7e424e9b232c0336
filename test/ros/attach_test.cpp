// A forearm with two open fingers that points down; a cube hangs 10 mm below the left one.
#include <gtest/gtest.h>
#include <sweep_guard/Attach.h>
#include <sweep_guard/Intended.h>
#include <sweep_guard/SetIntent.h>
#include <sweep_guard/ToolShape.h>

#include "cube.h"
#include "node_fixture.h"
#include "proximity_listener.h"
#include "refusal.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Warning;

constexpr double kHalf = 0.005;                                            // of the cube [m]
const Eigen::Vector3d kLeft(0.22, -0.045, 0.0);                            // of the finger, from the tool [m]
const Eigen::Vector3d kBelow = kLeft + Eigen::Vector3d(0.0, 0.0, -0.025);  // of the cube

class AttachTest : public NodeTest {
 protected:
  void TearDown() override {
    detachAt({0.0, 0.0, 1.0});
    NodeTest::TearDown();
  }

  static sweep_guard::Attach::Response call(const std::string& id, const std::string& link, bool attach) {
    sweep_guard::Attach attached;
    attached.request.mesh_id = id;
    attached.request.link = link;
    attached.request.attach = attach;
    EXPECT_TRUE(ros::service::call("/sweep_guard/attach", attached));
    return attached.response;
  }

  // On a busy machine, the newest pose may be stale by now.
  sweep_guard::Attach::Response detachAt(const Eigen::Vector3d& tip) {
    auto answer = call("payload", "", false);
    for (; has(answer.message, "tool pose"); answer = call("payload", "", false)) moveTo(tip);
    return answer;
  }

  void placeCube(const std::string& id, const Eigen::Vector3d& center) {
    cube_ = cubeAt(id, center, probe().time(), kHalf);
    placed_.insert(id);
    probe().place(cube_);
  }

  // The tool rests at a point with the cube attached, above a table that is no part of it.
  void attachAt(const Eigen::Vector3d& tip) {
    placeSquare("table", {0.0, 0.0, 0.0}, "world", /*half_side=*/0.5);
    placeCube("payload", tip + kBelow);
    restAt(tip);
    const auto answer = call("payload", "left", true);
    ASSERT_TRUE(answer.success) << answer.message;
    restAt(tip);
  }

  std::set<std::string> linksTouching(const sweep_guard::Contacts& contacts, const std::string& id) {
    std::set<std::string> links;
    for (const auto& object : contacts.objects) {
      for (const auto& impact : object.impacts) {
        if (object.mesh_id == id) links.insert(impact.tool_link);
      }
    }
    return links;
  }

  sweep_guard::DeformableMesh cube_;
};

// The cube meets the table, and the finger does not.
TEST_F(AttachTest, ThePayloadIsALinkOfItsOwn) {
  attachAt({0.0, 0.0, 0.1});
  const sweep_guard::Contacts contacts = moveTo({0.0, 0.0, 0.028});
  EXPECT_EQ(linksTouching(contacts, "table"), std::set<std::string>{"payload"});
  const Warning warning = probe().awaitWarning([](const Warning& next) { return next.contact; });
  EXPECT_EQ(warning.tool_link, "payload");
}

TEST_F(AttachTest, ThePayloadIsNoWorkpieceAnyLonger) {
  attachAt({0.0, 0.0, 0.1});
  auto request = requestAlong({{0.0, 0.0, 0.1}, {0.0, 0.0, 0.05}});
  request.mesh_ids = {"payload"};
  EXPECT_TRUE(has(probe().check(request).message, "no workpiece 'payload'"));
  probe().awaitStatus("workpieces",
                      [](const auto& status) { return valueOf(status, "'payload'") == "attached to the tool"; });
}

TEST_F(AttachTest, CheckedPathsHaveThePayload) {
  attachAt({0.0, 0.0, 0.1});
  auto request = requestAlong({{0.0, 0.0, 0.1}, {0.0, 0.0, 0.028}});
  request.fine = true;
  const auto answer = probe().check(request);
  EXPECT_TRUE(answer.collision) << answer.message;
  ASSERT_EQ(answer.objects.size(), 1U);
  EXPECT_EQ(answer.objects[0].impacts.at(0).tool_link, "payload");
}

TEST_F(AttachTest, TheShapeOfTheToolIsPublishedAnew) {
  const TopicListener<sweep_guard::ToolShape> shapes("tool");
  attachAt({0.0, 0.0, 0.1});
  const auto has_payload = [](const sweep_guard::ToolShape& shape) {
    return std::count(shape.links.begin(), shape.links.end(), "payload") > 0;
  };
  shapes.awaitNewest(has_payload);
  detachAt({0.0, 0.0, 0.1});
  shapes.awaitNewest([&](const auto& shape) { return !has_payload(shape); });
}

// The finger touches the cube where it was carried to.
TEST_F(AttachTest, DetachingGivesItBackWhereTheToolHasCarriedIt) {
  attachAt({0.0, 0.0, 0.1});
  restAt({0.2, 0.0, 0.2});
  const auto answer = detachAt({0.2, 0.0, 0.2});
  ASSERT_TRUE(answer.success) << answer.message;
  restAt({0.2, 0.0, 0.2});
  const sweep_guard::Contacts contacts = moveTo({0.2, 0.0, 0.185});
  EXPECT_EQ(linksTouching(contacts, "payload"), std::set<std::string>{"left"});
}

// The guard accepts the shape again wherever it is.
TEST_F(AttachTest, APayloadThatDeformsIsNotCovered) {
  attachAt({0.0, 0.0, 0.1});
  probe().publish(
      verticesOf(cube_, probe().time(), [](const Eigen::Vector3d& p) -> Eigen::Vector3d { return 1.5 * p; }));
  const Warning warning = probe().awaitWarning(hasReason(Warning::MESH_INVALID));
  EXPECT_TRUE(has(warning.text, "workpiece 'payload' refused")) << "a message that cannot be read counts for 1 s only";
  EXPECT_TRUE(has(warning.text, "'payload' is attached to the tool: detach it first")) << warning.text;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()).toRotationMatrix();
  probe().publish(
      verticesOf(cube_, probe().time(), [&](const Eigen::Vector3d& p) -> Eigen::Vector3d { return turn * p; }));
  restAt({0.0, 0.0, 0.1});
}

TEST_F(AttachTest, AnotherMeshOfThePayloadIsRefusedUntilItIsDetachedAndSentAgain) {
  attachAt({0.0, 0.0, 0.1});
  auto renewed = cube_;
  renewed.header.stamp = probe().time();
  renewed.revision += 1;
  renewed.mesh.triangles.pop_back();
  probe().publish(renewed);
  probe().awaitWarning(hasReason(Warning::MESH_INVALID));
  ASSERT_TRUE(detachAt({0.0, 0.0, 0.1}).success);
  moveTo({0.0, 0.0, 0.1});
  probe().skipWarnings();
  EXPECT_TRUE(hasReason(Warning::MESH_INVALID)(probe().awaitWarning([](const Warning&) { return true; })));
  renewed.header.stamp = probe().time();
  probe().publish(renewed);
  restAt({0.0, 0.0, 0.1});
}

TEST_F(AttachTest, ARefusalSaysWhy) {
  placeCube("payload", {0.0, 0.0, 0.3});
  restAt({0.0, 0.0, 1.0});
  EXPECT_TRUE(
      has(call("payload", "thumb", true).message, "the tool has no link 'thumb': it has 'fore', 'left', 'right'"));
  EXPECT_TRUE(has(call("pailoud", "left", true).message, "there is no workpiece 'pailoud'"));
  EXPECT_TRUE(has(call("", "left", true).message, "mesh_id is no name"));
  EXPECT_TRUE(has(call("payload", "", false).message, "'payload' is not attached"));
  placeCube("right", {0.3, 0.3, 0.3});
  EXPECT_TRUE(has(call("right", "left", true).message, "the tool has a link 'right' already"));
  restAt({0.0, 0.0, 1.0});
  ASSERT_TRUE(call("payload", "left", true).success);
  restAt({0.0, 0.0, 1.0});
  EXPECT_TRUE(has(call("payload", "left", true).message, "is attached already"));
}

// The tool may have carried it since.
TEST_F(AttachTest, AStaleMeshIsNotAttached) {
  placeCube("payload", {0.0, 0.0, 0.3});
  restAt({0.0, 0.0, 1.0});
  probe().tick(1001.0);
  moveTo({0.0, 0.0, 1.0});
  EXPECT_TRUE(has(call("payload", "left", true).message, "where the tool holds it is not known"));
}

// As by ~reset: a region meant for the tool would be meant for the payload, too.
TEST_F(AttachTest, WhereContactIsMeantIsForgotten) {
  const TopicListener<sweep_guard::Intended> intended("intended");
  placeSquare("table", {0.0, 0.0, 0.0}, "world", /*half_side=*/0.5);
  placeCube("payload", Eigen::Vector3d(0.0, 0.0, 0.1) + kBelow);
  restAt({0.0, 0.0, 0.1});
  sweep_guard::SetIntent meant;
  meant.request.intends.emplace_back();
  meant.request.intends[0].mesh_id = "table";
  meant.request.intends[0].triangles = {0, 1};
  meant.request.intends[0].depth = 0.01;
  ASSERT_TRUE(ros::service::call("/sweep_guard/intend", meant));
  ASSERT_TRUE(meant.response.success) << meant.response.message;
  intended.awaitNewest([](const auto& now) { return now.intentions.size() == 1; });
  ASSERT_TRUE(call("payload", "left", true).success);
  intended.awaitNewest([](const auto& now) { return now.intentions.empty(); });
}

TEST_F(AttachTest, AResetKeepsIt) {
  attachAt({0.0, 0.0, 0.1});
  ASSERT_TRUE(probe().reset().success);
  restAt({0.0, 0.0, 0.1});
  EXPECT_EQ(linksTouching(moveTo({0.0, 0.0, 0.028}), "table"), std::set<std::string>{"payload"});
}

TEST_F(AttachTest, ThePaddingWaitsUntilItIsDetached) {
  attachAt({0.0, 0.0, 0.1});
  const auto pad = [](double padding) {
    dynamic_reconfigure::Config config;
    config.doubles.emplace_back();
    config.doubles.back().name = "tool/padding";
    config.doubles.back().value = padding;
    return probe().configure(config);
  };
  EXPECT_FALSE(pad(0.001));
  ASSERT_TRUE(detachAt({0.0, 0.0, 0.1}).success);
  EXPECT_TRUE(pad(0.001));
  EXPECT_TRUE(pad(0.0));
}

}  // namespace
}  // namespace sweep_guard_ros
