#include "common/stage_clock.h"

#include <gtest/gtest.h>

#include <numeric>

namespace sweep_guard_core {
namespace {

using namespace std::chrono_literals;

SteadyTime now() { return std::chrono::steady_clock::now(); }

// Returns how long it worked.
Duration work() {
  const SteadyTime begin = now();
  while (now() - begin < 1ms) continue;
  return now() - begin;
}

Duration timeIn(const StageClock& clock, Stage stage) { return clock.read()[static_cast<size_t>(stage)]; }

Duration sum(const StageTimes& times) { return std::accumulate(times.begin(), times.end(), Duration::zero()); }

TEST(StageClockTest, OfAStageWithinAnotherOnlyTheInnerOneCounts) {
  StageClock clock;
  const SteadyTime begin = now();
  clock.begin(Stage::kSweep);
  const Duration before = work();
  Duration within{};
  {
    const InStage stage(Stage::kNarrowPhase);
    within = work();
  }
  const Duration after = work();
  clock.end();
  const Duration all = now() - begin;
  EXPECT_GE(timeIn(clock, Stage::kSweep), before + after);
  EXPECT_GE(timeIn(clock, Stage::kNarrowPhase), within);
  EXPECT_EQ(timeIn(clock, Stage::kSweep) + timeIn(clock, Stage::kNarrowPhase), sum(clock.read()));
  EXPECT_LE(sum(clock.read()), all);
}

TEST(StageClockTest, AStageThatIsEnteredAgainAddsUp) {
  StageClock clock;
  Duration worked{};
  for (int i = 0; i < 3; ++i) {
    clock.begin(Stage::kReceive);
    worked += work();
    clock.end();
  }
  EXPECT_GE(timeIn(clock, Stage::kReceive), worked);
}

TEST(StageClockTest, WhatIsNoStageHasNoneWithinIt) {
  StageClock clock;
  clock.begin(Stage::kOther);
  {
    const InStage stage(Stage::kNarrowPhase);
    work();
  }
  clock.end();
  EXPECT_EQ(sum(clock.read()), Duration::zero());
}

TEST(StageClockTest, StandsStillBetweenTwoPiecesOfWork) {
  StageClock clock;
  clock.begin(Stage::kReceive);
  clock.end();
  const StageTimes at_end = clock.read();
  {
    const InStage stage(Stage::kPublish);
    work();
  }
  EXPECT_EQ(clock.read(), at_end);
}

}  // namespace
}  // namespace sweep_guard_core
