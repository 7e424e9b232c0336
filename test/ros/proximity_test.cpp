// Reads the separating planes of a running guard.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "node_fixture.h"
#include "proximity_listener.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Proximity;
using sweep_guard::ToolBalls;

class ProximityTest : public NodeTest {
 protected:
  // Poses that are swept before the guard knows its subscriber have no planes.
  Proximity planesAt(const Eigen::Vector3d& tip) {
    while (true) {
      moveTo(tip);
      const ros::Time stamp = probe().time();
      if (planes_.all().empty()) continue;
      return planes_.awaitNewest([&](const Proximity& proximity) { return proximity.header.stamp >= stamp; });
    }
  }
  static bool changePadding(double padding) {
    dynamic_reconfigure::Config config;
    config.doubles.emplace_back();
    config.doubles.back().name = "tool/padding";
    config.doubles.back().value = padding;
    return probe().configure(config);
  }

  TopicListener<Proximity> planes_{"proximity"};
};

TEST_F(ProximityTest, APlaneLiesBetweenTheToolAndASquare) {
  placeSquare("square", {0.0, 0.0, 0.0});
  const Proximity proximity = planesAt({0.01, 0.02, 0.05});
  EXPECT_EQ(proximity.header.frame_id, "world");
  EXPECT_TRUE(proximity.valid);
  EXPECT_EQ(proximity.valid_until, proximity.header.stamp + ros::Duration(1.0));
  EXPECT_EQ(proximity.uncovered_distance, std::numeric_limits<double>::infinity());
  ASSERT_EQ(proximity.planes.size(), 1U);
  const auto& plane = proximity.planes[0];
  EXPECT_EQ(plane.mesh_id, "square");
  EXPECT_EQ(plane.tool_link, "");
  EXPECT_LT(plane.triangle, 2U);
  EXPECT_NEAR(plane.normal.z, 1.0, 1e-9);
  EXPECT_NEAR(plane.gap, 0.95 * 0.05, 1e-6);
  EXPECT_NEAR(plane.point.z, 0.05 * 0.05, 1e-6);
  EXPECT_EQ(plane.speed, 0.0);
}

TEST_F(ProximityTest, NoPlaneStandsForWhatIsBeyondTheReach) {
  placeSquare("square", {0.0, 0.0, 0.0});
  const Proximity proximity = planesAt({0.0, 0.0, 0.2});
  EXPECT_TRUE(proximity.valid);
  EXPECT_TRUE(proximity.planes.empty());
  EXPECT_GE(proximity.uncovered_distance, 0.1);
  EXPECT_LE(proximity.uncovered_distance, 0.2);
}

TEST_F(ProximityTest, PlanesFollowTheDeformedVerticesWithTheirSpeed) {
  placeSquare("square", {0.0, 0.0, 0.0});
  const ros::Time stamp = probe().time();
  probe().place(squareMovedTo("square", {0.0, 0.0, 0.002}, stamp));
  EXPECT_NEAR(planesAt({0.0, 0.0, 0.05}).planes.at(0).gap, 0.95 * 0.048, 1e-6);
  while (probe().time() < stamp + ros::Duration(0.1)) moveTo({0.0, 0.0, 0.05});
  probe().place(squareMovedTo("square", {0.0, 0.0, 0.01}, stamp + ros::Duration(0.1)));
  const Proximity proximity = planesAt({0.0, 0.0, 0.05});
  ASSERT_EQ(proximity.planes.size(), 1U);
  const double since =
      (proximity.header.stamp - stamp).toSec() - 0.1;  // the deformation, at the speed from the one before
  EXPECT_NEAR(proximity.planes[0].gap, 0.95 * 0.04 - 0.08 * since, 1e-6);
  EXPECT_NEAR(proximity.planes[0].speed, 0.08, 1e-5);
}

TEST_F(ProximityTest, WithoutAWorkpieceThePlanesAreNotValid) {
  while (planes_.all().empty()) {  // without a workpiece there are no contacts to wait for
    probe().tick(0.001);
    probe().publish(poseAt({0.0, 0.0, 0.05}, probe().time()));
  }
  const Proximity proximity = planes_.all().back();
  EXPECT_FALSE(proximity.valid);
  EXPECT_TRUE(proximity.planes.empty());
}

TEST_F(ProximityTest, AWorkpieceWithoutTransformMakesThePlanesInvalid) {
  placeSquare("square", {0.0, 0.0, 0.0});
  EXPECT_TRUE(planesAt({0.0, 0.0, 0.05}).valid);
  auto lost = squareAt("lost", {0.0, 0.0, 0.0}, probe().time());
  lost.header.frame_id = "nowhere";
  probe().publish(lost);
  placed_.insert("lost");
  for (int tries_left = 200; planesAt({0.0, 0.0, 0.05}).valid; --tries_left) ASSERT_GT(tries_left, 0);
}

TEST_F(ProximityTest, InContactTheGapIsNegativeAndTheNormalLeadsOut) {
  placeSquare("square", {0.0, 0.0, 0.0});
  planesAt({0.0, 0.0, 0.05});
  const Proximity proximity = planesAt({0.0, 0.0, -0.002});
  ASSERT_FALSE(proximity.planes.empty());
  EXPECT_LT(proximity.planes[0].gap, 0.0);
  EXPECT_GT(proximity.planes[0].normal.z, 0.9);
}

TEST_F(ProximityTest, PosesThatAreSweptTogetherShareOneMessage) {
  placeSquare("square", {0.0, 0.0, 0.0});
  planesAt({0.0, 0.0, 0.05});
  const size_t before = planes_.all().size();
  probe().forgetContacts();
  ros::Time stamp;
  for (int i = 0; i < 50; ++i) {
    stamp = probe().time() + ros::Duration(0.0005 * (i + 1));
    probe().publish(poseAt({0.0, 0.0, 0.05 + 0.0001 * i}, stamp));
  }
  const auto contacts = probe().awaitContactsUpTo(stamp);
  planes_.awaitNewest([&](const Proximity& proximity) { return proximity.header.stamp == stamp; });
  EXPECT_EQ(planes_.all().size() - before, contacts.size());
}

TEST_F(ProximityTest, TheToolIsLatchedAndHasANewRevisionWhenItChanges) {
  placeSquare("square", {0.0, 0.0, 0.0});
  const TopicListener<ToolBalls> tool("tool_balls");
  const ToolBalls first = tool.awaitNewest([](const ToolBalls&) { return true; });
  EXPECT_EQ(first.header.frame_id, "tool");
  ASSERT_EQ(first.pieces.size(), 1U);
  EXPECT_EQ(first.pieces[0].balls.size(), 32U);
  EXPECT_EQ(planesAt({0.0, 0.0, 0.5}).tool_revision, first.revision);
  ASSERT_TRUE(changePadding(0.004));
  const ToolBalls next = tool.awaitNewest([&](const ToolBalls& balls) { return balls.revision == first.revision + 1; });
  EXPECT_NEAR(next.pieces.at(0).balls.at(0).radius, first.pieces[0].balls[0].radius + 0.004, 1e-9);
  EXPECT_EQ(planesAt({0.0, 0.0, 0.5}).tool_revision, next.revision);
  EXPECT_TRUE(changePadding(0.0));
}

TEST(ProximityWithoutSubscriberTest, IsNotComputed) {
  const auto idle = [](const auto& status) { return valueOf(status, "proximity [%]") == "0.000"; };
  EXPECT_NO_THROW(probe().awaitStatus("stages", idle));
  probe().publish(poseAt({0.0, 0.0, 0.05}, probe().time()));
  EXPECT_NO_THROW(probe().awaitStatus("stages", idle));
}

}  // namespace
}  // namespace sweep_guard_ros
