#include "rviz/tool_visual.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sweep_guard_rviz {
namespace {

using sweep_guard::MotionStatus;
using sweep_guard::ToolShape;

geometry_msgs::Pose poseAt(double x, double y, double z) {
  geometry_msgs::Pose pose;
  pose.position.x = x;
  pose.position.y = y;
  pose.position.z = z;
  pose.orientation.w = 1.0;
  return pose;
}

/// A tool of two bodies: piece 0 of body 0 is a point, piece 1 of body 1 a box of 0.2 m about its origin.
ToolShape pointAndBox() {
  ToolShape shape;
  shape.parts.resize(2);
  shape.bodies = {0, 1};
  shape.parts[0].vertices.resize(1);
  for (const double x : {-0.1, 0.1}) {
    for (const double y : {-0.1, 0.1}) {
      for (const double z : {-0.1, 0.1}) shape.parts[1].vertices.push_back(poseAt(x, y, z).position);
    }
  }
  return shape;
}

MotionStatus heldByFloor(std::uint32_t piece) {
  MotionStatus status;
  status.code = MotionStatus::HALT_FOR_COLLISION;
  status.piece = piece;
  status.normal.z = 1.0;
  return status;
}

const BodyPoses kBodies = {poseAt(5.0, 0.0, 0.0), poseAt(0.0, 2.0, 1.0)};

void expectAt(const std::optional<Ogre::Vector3>& point, float x, float y, float z) {
  ASSERT_TRUE(point.has_value());
  EXPECT_LT((*point - Ogre::Vector3(x, y, z)).length(), 1e-5F) << *point;
}

TEST(HeldPointTest, IsTheMiddleOfTheFaceBeforeTheSurface) {
  expectAt(heldPoint(heldByFloor(1), pointAndBox(), kBodies), 0.0F, 2.0F, 0.9F);
  expectAt(heldPoint(heldByFloor(0), pointAndBox(), kBodies), 5.0F, 0.0F, 0.0F);
}

TEST(HeldPointTest, IsTheCornerOfATurnedBodyThatIsNearest) {
  BodyPoses bodies = kBodies;
  bodies[1].orientation.x = bodies[1].orientation.y = std::sin(0.25) * std::sqrt(0.5);
  bodies[1].orientation.w = std::cos(0.25);
  const auto point = heldPoint(heldByFloor(1), pointAndBox(), bodies);
  ASSERT_TRUE(point.has_value());
  EXPECT_LT(point->z, 0.9F - 0.03F);
}

TEST(HeldPointTest, IsNoneWithoutAHoldANormalOrAKnownPiece) {
  MotionStatus passed_on = heldByFloor(1);
  passed_on.code = MotionStatus::NO_WARNING;
  EXPECT_FALSE(heldPoint(passed_on, pointAndBox(), kBodies));
  MotionStatus no_plane = heldByFloor(1);
  no_plane.normal.z = 0.0;
  EXPECT_FALSE(heldPoint(no_plane, pointAndBox(), kBodies));
  EXPECT_FALSE(heldPoint(heldByFloor(2), pointAndBox(), kBodies));
  EXPECT_FALSE(heldPoint(heldByFloor(1), pointAndBox(), {kBodies[0]}));
  EXPECT_FALSE(heldPoint(heldByFloor(0), {}, kBodies));
}

}  // namespace
}  // namespace sweep_guard_rviz
