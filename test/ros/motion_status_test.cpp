// What the status of the motion guard says of what limits a command.
#include "ros/motion/motion_status.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sweep_guard_ros {
namespace {

using sweep_guard::MotionStatus;
using sweep_guard_core::GuardedMotion;
using sweep_guard_core::Permission;
using sweep_guard_core::PermissionCause;

sweep_guard::Proximity twoPlanes() {
  sweep_guard::Proximity planes;
  planes.planes.resize(2);
  planes.planes[0].mesh_id = "floor";
  planes.planes[0].normal.z = 1.0;
  planes.planes[1].mesh_id = "wall";
  planes.planes[1].tool_link = "forearm";
  planes.planes[1].piece = 3;
  planes.planes[1].triangle = 7;
  planes.planes[1].normal.x = -0.6;
  planes.planes[1].normal.y = 0.8;
  return planes;
}

GuardedMotion stoppedBefore(std::optional<size_t> plane, Permission permission = Permission::kLimited) {
  GuardedMotion motion;
  motion.decision = {permission, PermissionCause::kGuarded};
  motion.commanded_speed = 0.5;
  if (plane) motion.limiting = GuardedMotion::Limiting{*plane, Eigen::Vector3d::UnitX(), 0.0012, 0.0};
  return motion;
}

MotionStatus statusBefore(std::optional<size_t> plane, Permission permission = Permission::kLimited) {
  const sweep_guard::Proximity planes = twoPlanes();
  return statusOf(stoppedBefore(plane, permission), &planes, std::nullopt);
}

bool namesTheArrow(const MotionStatus& status) { return status.text.find("back along the arrow") != std::string::npos; }

TEST(MotionStatusTest, HasPieceAndNormalOfThePlaneThatLimitsAndSaysTheWayBack) {
  const MotionStatus status = statusBefore(1);
  EXPECT_EQ(status.code, MotionStatus::HALT_FOR_COLLISION);
  EXPECT_EQ(status.piece, 3U);
  EXPECT_EQ(status.normal, twoPlanes().planes[1].normal);
  EXPECT_EQ(status.text, "stopped before 'wall', triangle 7, 1.2 mm in front of link 'forearm'; back along the arrow");
}

TEST(MotionStatusTest, WithoutAPlaneThereIsNoWayBack) {
  for (const Permission permission : {Permission::kLimited, Permission::kEscape, Permission::kStop}) {
    const MotionStatus status = statusBefore(std::nullopt, permission);
    EXPECT_EQ(status.normal, geometry_msgs::Vector3());
    EXPECT_FALSE(namesTheArrow(status)) << status.text;
  }
}

TEST(MotionStatusTest, ACommandThatDoesNotLeadAwayIsToldTheWayBack) {
  const MotionStatus status = statusBefore(1, Permission::kEscape);
  EXPECT_TRUE(namesTheArrow(status)) << status.text;
  EXPECT_NE(status.text.find("does not lead away from 'wall'"), std::string::npos) << status.text;
}

// A normal follows each pose of the tool; an arrow that turns by less than a degree looks the same.
TEST(MotionStatusTest, OnlyANormalThatTurnsByADegreeIsAChange) {
  MotionStatus before = statusBefore(0);
  const auto turned = [&](double degrees) {
    MotionStatus status = before;
    status.normal.x = std::sin(degrees * M_PI / 180.0);
    status.normal.z = std::cos(degrees * M_PI / 180.0);
    return status;
  };
  EXPECT_FALSE(differ(before, turned(0.0)));
  EXPECT_FALSE(differ(before, turned(0.9)));
  EXPECT_TRUE(differ(before, turned(1.1)));
  EXPECT_TRUE(differ(before, turned(180.0)));
  MotionStatus other_piece = before;
  other_piece.piece = 1;
  EXPECT_TRUE(differ(before, other_piece));
}

TEST(MotionStatusTest, ZeroInPlaceOfZeroHoldsNothingBack) {
  GuardedMotion motion = stoppedBefore(std::nullopt, Permission::kStop);
  EXPECT_EQ(statusOf(motion, nullptr, std::nullopt).scale, 0.0);
  motion.commanded_speed = 0.0;
  EXPECT_EQ(statusOf(motion, nullptr, std::nullopt).scale, 1.0);
}

}  // namespace
}  // namespace sweep_guard_ros
