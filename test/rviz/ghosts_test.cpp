#include <gtest/gtest.h>

#include <cmath>

#include "rviz/tool_visual.h"

namespace sweep_guard_rviz {
namespace {

std::vector<geometry_msgs::Pose> straight(size_t count, double step) {
  std::vector<geometry_msgs::Pose> path(count);
  for (size_t i = 0; i < count; ++i) {
    path[i].position.x = step * static_cast<double>(i);
    path[i].orientation.w = 1.0;
  }
  return path;
}

TEST(GhostsTest, AreSpreadEvenlyUpToTheEnd) {
  EXPECT_EQ(pickGhosts(straight(20, 1.0), 4, 0.1, 0.5), (std::vector<size_t>{4, 9, 14, 19}));
}

TEST(GhostsTest, AToolAtRestHasOne) { EXPECT_EQ(pickGhosts(straight(20, 0.0), 10, 0.1, 0.5).size(), 1U); }

TEST(GhostsTest, AToolThatOnlyTurnsHasThem) {
  std::vector<geometry_msgs::Pose> path = straight(2, 0.0);
  path[1].orientation.w = path[1].orientation.z = std::sqrt(0.5);
  EXPECT_EQ(pickGhosts(path, 2, 0.1, 0.05).size(), 2U);
}

TEST(GhostsTest, AnEmptyPathHasNone) { EXPECT_TRUE(pickGhosts({}, 10, 0.1, 0.5).empty()); }

TEST(GhostsTest, ThereAreNoMoreThanPoses) { EXPECT_EQ(pickGhosts(straight(3, 1.0), 10, 0.1, 0.5).size(), 3U); }

}  // namespace
}  // namespace sweep_guard_rviz
