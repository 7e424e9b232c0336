#include "guard/closest_approach.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "common/floating_point.h"
#include "scenes.h"

namespace sweep_guard_core {
namespace {

TEST(ClosestApproachTest, IsTheLeastOfAllSweepsThatBeginNoLater) {
  Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    ClosestApproach approach;
    std::vector<std::pair<Duration, double>> sweeps;
    for (int i = 0; i < 40; ++i) {
      sweeps.emplace_back(random.below(20), random.below(30) - 3);
      approach.add(sweeps.back().first, sweeps.back().second);
      for (int time = -1; time <= 20; ++time) {
        double least = kInfinity;
        for (const auto& [from, deviations] : sweeps) {
          if (from <= Duration(time)) least = std::min(least, deviations);
        }
        EXPECT_EQ(approach.upTo(Duration(time)), least);
      }
    }
  }
}

TEST(ClosestApproachTest, BelongsToOneWorkpieceUntilCleared) {
  const Workpiece liver{"liver", 0, Time(), SteadyTime(), "table", wavyHull(4, 6, 0.0)};
  const Workpiece spleen{"spleen", 0, Time(), SteadyTime(), "table", wavyHull(4, 6, 0.0)};
  ClosestApproaches approaches;
  approaches.to(liver).add(Duration(5), 1.0);
  EXPECT_EQ(approaches.to(liver).upTo(Duration(5)), 1.0);
  EXPECT_EQ(approaches.to(spleen).upTo(Duration(5)), kInfinity);
  approaches.clear();
  EXPECT_EQ(approaches.to(liver).upTo(Duration(5)), kInfinity);
}

}  // namespace
}  // namespace sweep_guard_core
