#include <gtest/gtest.h>

#include <cmath>

#include "rviz/tool_visual.h"

namespace sweep_guard_rviz {
namespace {

const std::vector<BodySize> kOneBody = {{0.1, 1.0}};

std::vector<BodyPoses> straight(size_t count, double step) {
  std::vector<BodyPoses> path(count, BodyPoses(1));
  for (size_t i = 0; i < count; ++i) {
    path[i][0].position.x = step * static_cast<double>(i);
    path[i][0].orientation.w = 1.0;
  }
  return path;
}

TEST(GhostsTest, AreSpreadEvenlyUpToTheEnd) {
  EXPECT_EQ(pickGhosts(straight(20, 1.0), 4, kOneBody), (std::vector<size_t>{4, 9, 14, 19}));
}

TEST(GhostsTest, AToolAtRestHasOne) { EXPECT_EQ(pickGhosts(straight(20, 0.0), 10, kOneBody).size(), 1U); }

TEST(GhostsTest, AToolThatOnlyTurnsHasThem) {
  std::vector<BodyPoses> path = straight(2, 0.0);
  path[1][0].orientation.w = path[1][0].orientation.z = std::sqrt(0.5);
  EXPECT_EQ(pickGhosts(path, 2, {{0.1, 0.1}}).size(), 2U);
}

TEST(GhostsTest, AnEmptyPathHasNone) { EXPECT_TRUE(pickGhosts({}, 10, kOneBody).empty()); }

TEST(GhostsTest, ThereAreNoMoreThanPoses) { EXPECT_EQ(pickGhosts(straight(3, 1.0), 10, kOneBody).size(), 3U); }

TEST(GhostsTest, AToolOfWhichOneBodyMovesHasThem) {
  std::vector<BodyPoses> path = straight(20, 1.0);
  for (BodyPoses& bodies : path) bodies.insert(bodies.begin(), path[0][0]);
  EXPECT_EQ(pickGhosts(path, 4, {{0.1, 1.0}, {0.1, 1.0}}).size(), 4U);
}

}  // namespace
}  // namespace sweep_guard_rviz
