#include "rviz/heat_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sweep_guard_rviz {
namespace {

using Triangles = std::vector<std::uint32_t>;

sweep_guard::ObjectTouches touched() {
  sweep_guard::ObjectTouches touches;
  touches.triangles = {2, 3, 5, 7};
  touches.sweeps = {1, 10, 1000, 999};
  touches.depths = {0.0F, 0.004F, 0.001F, std::nanf("")};
  return touches;
}

TEST(HeatMapTest, ColorsByTheLogarithmOfTheSweeps) {
  const HeatMap map = heatMapOf(touched(), ColorBy::kTouches, 10);
  EXPECT_EQ(map.triangles[0], Triangles{2});
  EXPECT_EQ(map.triangles[1], Triangles{});
  EXPECT_EQ(map.triangles[2], Triangles{3});
  EXPECT_EQ(map.triangles[5], (Triangles{5, 7}));
  EXPECT_EQ(legendOf(map, ColorBy::kTouches), "1 (pale) to 1000 sweeps (dark)");
}

TEST(HeatMapTest, ColorsByTheDepthWhereItIsKnown) {
  const HeatMap map = heatMapOf(touched(), ColorBy::kDepth, 10);
  EXPECT_EQ(map.triangles[0], Triangles{2});
  EXPECT_EQ(map.triangles[1], Triangles{5});
  EXPECT_EQ(map.triangles[5], Triangles{3});
  size_t colored = 0;
  for (const Triangles& triangles : map.triangles) colored += triangles.size();
  EXPECT_EQ(colored, 3U);
  EXPECT_EQ(legendOf(map, ColorBy::kDepth), "0 (pale) to 4.0 mm (dark)");
}

TEST(HeatMapTest, DropsTrianglesThatTheWorkpieceDoesNotHave) {
  EXPECT_EQ(heatMapOf(touched(), ColorBy::kTouches, 6).triangles[5], Triangles{5});
}

TEST(HeatMapTest, WhereAllIsTheSameAllIsPale) {
  sweep_guard::ObjectTouches touches = touched();
  touches.sweeps.assign(4, 1);
  touches.depths.assign(4, 0.0F);
  EXPECT_EQ(heatMapOf(touches, ColorBy::kTouches, 10).triangles[0].size(), 4U);
  EXPECT_EQ(heatMapOf(touches, ColorBy::kDepth, 10).triangles[0].size(), 4U);
}

TEST(HeatMapTest, ByNothingNothingIsColored) {
  const HeatMap map = heatMapOf(touched(), ColorBy::kNothing, 10);
  EXPECT_EQ(map, HeatMap());
  EXPECT_EQ(legendOf(map, ColorBy::kNothing), "");
}

TEST(HeatMapTest, AListThatIsTooShortIsCut) {
  sweep_guard::ObjectTouches touches = touched();
  touches.depths.resize(1);
  EXPECT_EQ(heatMapOf(touches, ColorBy::kTouches, 10).triangles[0], Triangles{2});
}

}  // namespace
}  // namespace sweep_guard_rviz
