#include "camera/free_space.h"

#include <gtest/gtest.h>

#include "camera/depth_surface_fixture.h"

namespace sweep_guard_core {
namespace {

class FreeSpaceTest : public DepthMotionTest {
 protected:
  bool isFree(std::uint32_t column, std::uint32_t row, double depth) const {
    return surface_.freeSpace()->contains(X_FC_ * onRay(column, row, depth));
  }
  // The robot hides the middle, half a meter before a wall.
  void takeBehindRobot(double since) {
    std::vector<float> depths = wall(1.0F);
    for (std::uint32_t row = 15; row < 22; ++row) {
      for (std::uint32_t column = 23; column < 30; ++column) at(depths, column, row) = 0.5F;
    }
    take(depths, since, {boxAt(0.5)});
  }
};

TEST_F(FreeSpaceTest, SpaceIsFreeUpToWhatIsSeenAndNotBehindIt) {
  X_FC_ = Random(7).pose({0.3, -1.2, 2.0});
  take(wall(1.0F), 0.0);
  EXPECT_TRUE(isFree(26, 18, 0.01));
  EXPECT_TRUE(isFree(26, 18, 0.999));
  EXPECT_FALSE(isFree(26, 18, 1.001));
}

TEST_F(FreeSpaceTest, TheMarginIsNotFree) {
  DepthSurface surface(grid_, kCamera, {0.1, 4.0, {0.1, 0.0}});
  surface.take(wall(1.0F), X_FC_);
  EXPECT_TRUE(surface.freeSpace()->contains(onRay(26, 18, 0.89)));
  EXPECT_FALSE(surface.freeSpace()->contains(onRay(26, 18, 0.91)));
}

TEST_F(FreeSpaceTest, WhereNothingIsSeenNothingIsFree) {
  std::vector<float> depths = wall(1.0F);
  at(depths, 26, 18) = kNone;
  take(depths, 0.0);
  EXPECT_FALSE(isFree(26, 18, 0.5));
  EXPECT_FALSE(isFree(27, 19, 0.5)) << "a pixel beside it";
  EXPECT_TRUE(isFree(28, 18, 0.5));
}

TEST_F(FreeSpaceTest, OutOfThePictureAndBehindTheCameraNothingIsFree) {
  take(wall(1.0F), 0.0);
  EXPECT_TRUE(isFree(1, 1, 0.5));
  EXPECT_FALSE(isFree(0, 18, 0.5)) << "nothing is known of the ray beside it";
  EXPECT_FALSE(isFree(kWidth - 1, 18, 0.5));
  EXPECT_FALSE(isFree(26, kHeight - 1, 0.5));
  EXPECT_FALSE(isFree(kWidth + 10, 18, 0.5));
  EXPECT_FALSE(isFree(26, 18, -0.5));
}

TEST_F(FreeSpaceTest, BeyondTheRangeItIsFreeUpToItsEnd) {
  take(wall(7.0F), 0.0);
  EXPECT_TRUE(isFree(26, 18, 3.999));
  EXPECT_FALSE(isFree(26, 18, 4.001));
}

TEST_F(FreeSpaceTest, TheMarginIsNotFreeWhereADepthIsJustBeyondTheRangeEither) {
  DepthSurface surface(grid_, kCamera, {0.1, 4.0, {0.1, 0.0}});
  surface.take(wall(4.01F), X_FC_);
  EXPECT_TRUE(surface.freeSpace()->contains(onRay(26, 18, 3.9)));
  EXPECT_FALSE(surface.freeSpace()->contains(onRay(26, 18, 3.92)));
}

TEST_F(FreeSpaceTest, BehindTheRobotItStaysFreeForAsLongAsIsRemembered) {
  take(wall(1.0F), 0.0);
  takeBehindRobot(1.0);
  EXPECT_TRUE(isFree(26, 18, 0.9));
  takeBehindRobot(0.9);
  EXPECT_TRUE(isFree(26, 18, 0.9));
  takeBehindRobot(0.2);
  EXPECT_FALSE(isFree(26, 18, 0.9));
  EXPECT_TRUE(isFree(26, 18, 0.49)) << "before the robot";
  EXPECT_TRUE(isFree(40, 18, 0.9)) << "beside it";
}

TEST_F(FreeSpaceTest, TheTimeCountsAnewOnceItIsSeenAgain) {
  take(wall(1.0F), 0.0);
  takeBehindRobot(1.9);
  take(wall(1.0F), 0.1);
  takeBehindRobot(1.9);
  EXPECT_TRUE(isFree(26, 18, 0.9));
}

TEST_F(FreeSpaceTest, WhatTheRobotHidesFromTheBeginningIsNotFree) {
  takeBehindRobot(0.0);
  EXPECT_FALSE(isFree(26, 18, 0.9));
}

TEST_F(FreeSpaceTest, ACameraThatMovesForgetsWhatWasFree) {
  take(wall(1.0F), 0.0);
  X_FC_.translation().x() = 1e-3;
  takeBehindRobot(0.03);
  EXPECT_FALSE(isFree(26, 18, 0.9));
  EXPECT_TRUE(isFree(40, 18, 0.9));
}

TEST_F(FreeSpaceTest, AnImageThatIsStillUsedIsNotOverwritten) {
  take(wall(1.0F), 0.0);
  const auto before = surface_.freeSpace();
  take(wall(0.5F), 0.0);
  EXPECT_TRUE(before->contains(onRay(26, 18, 0.9)));
  EXPECT_FALSE(isFree(26, 18, 0.9));
}

}  // namespace
}  // namespace sweep_guard_core
