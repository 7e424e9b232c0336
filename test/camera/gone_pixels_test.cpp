#include "camera/gone_pixels.h"

#include <gtest/gtest.h>

#include "camera/depth_surface_fixture.h"

namespace sweep_guard_core {
namespace {

// A hand before a wall, from one column to the next.
std::vector<float> hand(std::uint32_t left, std::uint32_t right, float behind = 1.0F) {
  std::vector<float> depths = wall(behind);
  for (std::uint32_t row = 0; row < kHeight; ++row) {
    for (std::uint32_t column = left; column < right; ++column) at(depths, column, row) = 0.5F;
  }
  return depths;
}

class GonePixelsTest : public DepthMotionTest {
 protected:
  // The robot hides the middle.
  void takeBehindRobot(std::vector<float> depths) {
    for (std::uint32_t row = 15; row < 22; ++row) {
      for (std::uint32_t column = 23; column < 30; ++column) at(depths, column, row) = 0.4F;
    }
    take(depths, 0.0, {boxAt(0.4)});
    EXPECT_GE(surface_.self(), 49U);
  }
  // Two images each, which show that it is no fault.
  void takeTwo(const std::vector<float>& depths) {
    for (int i = 0; i < 2; ++i) take(depths, 0.0);
  }
  void takeTwoBehindRobot(const std::vector<float>& depths) {
    for (int i = 0; i < 2; ++i) takeBehindRobot(depths);
  }
};

TEST_F(GonePixelsTest, WhatTheRobotHidesGoesWithWhatWasJoinedToIt) {
  takeTwo(wall(1.0F));
  takeTwo(hand(15, 40));
  takeTwoBehindRobot(hand(15, 40));
  EXPECT_FLOAT_EQ(static_cast<float>(now(26, 18).z()), 0.5F);
  takeBehindRobot(wall(1.0F));
  for (const std::uint32_t column : {23U, 26U, 29U}) {
    EXPECT_FLOAT_EQ(static_cast<float>(now(column, 18).z()), 1.0F) << column;
    EXPECT_EQ(before(column, 18), now(column, 18)) << column;
  }
  TriangleMesh mesh_F(grid_);
  mesh_F.deform(surface_.places_F(), surface_.before_F(), surface_.existing());
  EXPECT_EQ(trianglesOf(mesh_F).size(), 2U * (kWidth - 1) * (kHeight - 1));
}

TEST_F(GonePixelsTest, OfWhatGoesInPartTheRestStays) {
  takeTwo(wall(1.0F));
  takeTwo(hand(15, 40));
  takeTwoBehindRobot(hand(15, 40));
  takeBehindRobot(hand(25, 40));
  EXPECT_FLOAT_EQ(static_cast<float>(now(23, 18).z()), 1.0F);
  EXPECT_FLOAT_EQ(static_cast<float>(now(29, 18).z()), 0.5F);
  takeBehindRobot(wall(1.0F));
  EXPECT_FLOAT_EQ(static_cast<float>(now(29, 18).z()), 1.0F);
}

TEST_F(GonePixelsTest, WhatGoesBesideTheRobotTakesNothingFartherAwayWithIt) {
  takeTwo(wall(1.0F));
  takeTwoBehindRobot(hand(30, 40));
  takeBehindRobot(wall(1.0F));
  EXPECT_EQ(surface_.seen(), size_t{kWidth} * kHeight);
  EXPECT_FLOAT_EQ(static_cast<float>(now(29, 18).z()), 1.0F);
}

TEST_F(GonePixelsTest, WhereNothingIsKnownBehindWhatHasGoneNoSurfaceIsLeft) {
  takeTwo(hand(0, kWidth));
  takeTwoBehindRobot(hand(0, kWidth));
  takeBehindRobot(wall(1.0F));
  EXPECT_EQ(surface_.seen(), size_t{kWidth} * kHeight - 49);
}

TEST_F(GonePixelsTest, WhatWasBeforeTheDistanceGoesToo) {
  takeTwo(hand(15, 40, 7.0F));
  takeTwoBehindRobot(hand(15, 40, 7.0F));
  takeBehindRobot(wall(7.0F));
  EXPECT_EQ(surface_.seen(), 0U);
}

}  // namespace
}  // namespace sweep_guard_core
