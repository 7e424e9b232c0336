// A forearm with two open fingers that points down: the left one may touch the payload, and the other's is misspelled.
#include <gtest/gtest.h>
#include <sweep_guard/CheckTrajectory.h>
#include <sweep_guard/View.h>

#include <limits>

#include "node_fixture.h"
#include "proximity_listener.h"
#include "refusal.h"

namespace sweep_guard_ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using sweep_guard::Warning;

constexpr double kSide = 0.003;                       // half of a square's [m]
const Eigen::Vector3d kUnderLeft(0.22, -0.045, 0.0);  // where the finger is once the tool is at the origin [m]
const Eigen::Vector3d kUnderRight(0.22, 0.045, 0.0);
const std::string kLeftOut = "tool/allowed leaves out contact of link 'left' with 'payload'";

class AllowedContactTest : public NodeTest {
 protected:
  void place(const std::string& id, const Eigen::Vector3d& center) { placeSquare(id, center, "world", kSide); }

  // Returns the contacts at the end.
  sweep_guard::Contacts descend() {
    for (int mm = 60; mm > 0; --mm) {  // every 10 ms
      moveTo({0.0, 0.0, 0.001 * mm});
      probe().awaitPrediction(probe().time());
    }
    return moveTo({0.0, 0.0, 0.0});
  }
};

TEST_F(AllowedContactTest, IsNoWarningAndIsListed) {
  place("payload", kUnderLeft);
  restAt({0.0, 0.0, 0.07});
  const size_t before = probe().warnings().size();
  const sweep_guard::Contacts contacts = descend();
  EXPECT_TRUE(contacts.objects.empty());
  ASSERT_EQ(contacts.allowed.size(), 1U);
  EXPECT_EQ(contacts.allowed[0].mesh_id, "payload");
  EXPECT_TRUE(contacts.allowed[0].fine);
  ASSERT_FALSE(contacts.allowed[0].impacts.empty());
  EXPECT_EQ(contacts.allowed[0].impacts[0].tool_link, "left");
  restAt({0.0, 0.0, 0.0});
  const std::vector<Warning> warnings = probe().warnings();
  for (size_t i = before; i < warnings.size(); ++i) EXPECT_LE(warnings[i].level, Warning::CLEAR) << warnings[i].text;
  EXPECT_FALSE(warnings.back().reflex || warnings.back().considered || warnings.back().intended);
  const sweep_guard::Prediction prediction = probe().awaitPrediction(probe().time());
  EXPECT_TRUE(prediction.valid);
  EXPECT_FALSE(prediction.collision);
  EXPECT_TRUE(prediction.objects.empty());
  EXPECT_EQ(probe().timesToCollision().back(), std::numeric_limits<double>::infinity());
}

TEST_F(AllowedContactTest, OfAnotherLinkWarns) {
  place("payload", kUnderRight);
  restAt({0.0, 0.0, 0.07});
  const sweep_guard::Contacts contacts = descend();
  EXPECT_TRUE(contacts.allowed.empty());
  EXPECT_EQ(contacts.objects.size(), 1U);
  const Warning warning = probe().awaitWarning([](const Warning& next) { return next.contact; });
  EXPECT_EQ(warning.tool_link, "right");
}

TEST_F(AllowedContactTest, WithAnotherWorkpieceWarns) {
  place("payload", kUnderLeft);
  place("table", kUnderLeft);
  restAt({0.0, 0.0, 0.07});
  descend();
  const Warning warning = probe().awaitWarning([](const Warning& next) { return next.contact; });
  EXPECT_EQ(warning.tool_link, "left");
  EXPECT_EQ(warning.mesh_id, "table");
}

TEST_F(AllowedContactTest, IsLeftOutOfCheckedPaths) {
  place("payload", kUnderLeft);
  auto request = requestAlong({{0.0, 0.0, 0.1}, {0.0, 0.0, 0.0}});
  request.fine = true;
  const auto answer = probe().check(request);
  ASSERT_TRUE(answer.success) << answer.message;
  EXPECT_FALSE(answer.collision);
  EXPECT_TRUE(answer.clear) << answer.message;
  EXPECT_TRUE(answer.objects.empty());
  ASSERT_EQ(answer.allowed.size(), 1U);
  EXPECT_EQ(answer.allowed[0].impacts.at(0).tool_link, "left");
  EXPECT_EQ(answer.message, kLeftOut);

  place("table", kUnderLeft);
  request.mesh_ids = {"table"};
  const auto other = probe().check(request);
  EXPECT_TRUE(other.collision);
  EXPECT_TRUE(other.allowed.empty());
  EXPECT_EQ(other.message, "");
}

TEST_F(AllowedContactTest, IsLeftOutOfCheckedTrajectories) {
  place("payload", kUnderLeft);
  sweep_guard::CheckTrajectory::Request request;
  request.trajectory.joint_names = {"jaw"};
  for (const double jaw : {0.0, 0.04}) {
    request.trajectory.points.emplace_back();
    request.trajectory.points.back().positions = {jaw};
  }
  request.tool_pose = poseAt({0.0, 0.0, 0.0}, ros::Time());
  request.fine = true;
  sweep_guard::CheckTrajectory::Response answer;
  ASSERT_TRUE(ros::service::call("/sweep_guard/check_trajectory", request, answer));
  ASSERT_TRUE(answer.success) << answer.message;
  EXPECT_FALSE(answer.collision);
  EXPECT_TRUE(answer.clear);
  ASSERT_EQ(answer.allowed.size(), 1U);
  EXPECT_EQ(answer.allowed[0].impacts.at(0).tool_link, "left");
  EXPECT_EQ(answer.message, kLeftOut);
}

TEST_F(AllowedContactTest, IsLeftOutOfPredictions) {
  place("payload", kUnderLeft);
  restAt({0.0, 0.0, 0.07});
  moveTo({0.0, 0.0, 0.06});
  moveTo({0.0, 0.0, 0.05});
  const auto answer = probe().predict(1.0);
  ASSERT_TRUE(answer.success) << answer.message;
  EXPECT_FALSE(answer.prediction.collision);
  EXPECT_EQ(answer.message, kLeftOut);
}

TEST_F(AllowedContactTest, LimitsNoMotion) {
  const TopicListener<sweep_guard::Proximity> planes("proximity");
  // Poses that are swept before the guard knows its subscriber have no planes.
  const auto linksWithPlanes = [&] {
    while (true) {
      moveTo({0.0, 0.0, 0.03});
      const ros::Time stamp = probe().time();
      if (planes.all().empty()) continue;
      std::set<std::string> links;
      for (const auto& plane : planes.awaitNewest([&](const auto& next) { return next.header.stamp >= stamp; }).planes)
        links.insert(plane.tool_link);
      return links;
    }
  };
  place("payload", kUnderLeft);
  EXPECT_EQ(linksWithPlanes(), (std::set<std::string>{"fore", "right"}));
  place("table", kUnderLeft);
  EXPECT_EQ(linksWithPlanes(), (std::set<std::string>{"fore", "left", "right"}));
}

TEST_F(AllowedContactTest, IsDrawnInACalmColor) {
  place("payload", kUnderLeft);
  const TopicListener<sweep_guard::View> views("view");
  restAt({0.0, 0.0, 0.07});
  descend();
  probe().awaitMarkers([](const visualization_msgs::MarkerArray& array) {
    return std::any_of(array.markers.begin(), array.markers.end(), [](const visualization_msgs::Marker& marker) {
      return marker.ns == "allowed_triangles" && !marker.points.empty() && marker.color.r < marker.color.b;
    });
  });
  const sweep_guard::View view = views.awaitNewest(
      [](const auto& message) { return message.header.stamp == probe().time() && !message.objects.empty(); });
  EXPECT_FALSE(view.objects[0].allowed.empty());
  EXPECT_TRUE(view.objects[0].touched.empty());
}

TEST_F(AllowedContactTest, AnIdThatHasNeverComeIsAWarningOfDiagnostics) {
  place("payload", kUnderLeft);
  probe().remove("payload");
  const DiagnosticStatus status = probe().awaitStatus("allowed contact", [](const DiagnosticStatus& next) {
    return valueOf(next, "link 'left' with 'payload'") == "may touch";
  });
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_TRUE(has(status.message, "no workpiece 'pailoud' so far")) << status.message;
  EXPECT_EQ(valueOf(status, "link 'right' with 'pailoud'"), "no such workpiece so far");
}

}  // namespace
}  // namespace sweep_guard_ros
