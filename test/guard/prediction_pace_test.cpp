#include "guard/prediction_pace.h"

#include <gtest/gtest.h>

namespace sweep_guard_core {
namespace {

using std::chrono::hours;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;

double millisecondsFrom(SteadyTime from, SteadyTime to) {
  return std::chrono::duration<double, std::milli>(to - from).count();
}

const SteadyTime kBegin = SteadyTime() + hours(1);

// How many predictions of this length begin in a second of poses, if each can only begin with a pose.
int predictionsInASecond(Duration pose_interval, Duration took) {
  PredictionPace pace;
  int predictions = 0;
  for (SteadyTime at = kBegin; at < kBegin + seconds(2); at += pose_interval) {
    pace.received(at);
    if (at < pace.due()) continue;
    pace.predicted(at, took);
    if (at >= kBegin + seconds(1)) ++predictions;
  }
  return predictions;
}

TEST(PredictionPaceTest, EachPoseHasAPredictionThatIsShort) {
  EXPECT_EQ(predictionsInASecond(milliseconds(1), microseconds(440)), 1000);
  EXPECT_EQ(predictionsInASecond(milliseconds(10), microseconds(4400)), 100);
}

TEST(PredictionPaceTest, OthersTakeTheirShareThoughTheyBeginWithPoses) {
  EXPECT_NEAR(predictionsInASecond(milliseconds(1), microseconds(480)), 417, 10);
  EXPECT_NEAR(predictionsInASecond(milliseconds(1), microseconds(1700)), 118, 5);
  EXPECT_NEAR(predictionsInASecond(milliseconds(10), microseconds(6000)), 33, 3);
}

TEST(PredictionPaceTest, ALongOneAmongShortOnesIsFollowedByThemAsBefore) {
  PredictionPace pace;
  SteadyTime at = kBegin;
  for (int i = 0; i < 200; ++i, at += milliseconds(1)) {
    pace.received(at);
    pace.predicted(at, i % 10 == 0 ? microseconds(800) : microseconds(350));
    EXPECT_LE(pace.due(), at + milliseconds(1)) << i;
  }
}

TEST(PredictionPaceTest, OnlyTheNewestTimeIsKept) {
  PredictionPace pace;
  int predictions = 0;
  for (SteadyTime at = kBegin; at >= pace.due(); at += milliseconds(1), ++predictions) {
    pace.predicted(at, milliseconds(1));
  }
  EXPECT_EQ(predictions, 3);  // 4 ms owed for each, 10 ms kept
}

TEST(PredictionPaceTest, WhatWasOwedForLongIsForgotten) {
  PredictionPace pace;
  SteadyTime at = kBegin;
  for (int i = 0; i < 100; ++i, at += milliseconds(50)) pace.predicted(at, milliseconds(40));
  EXPECT_LE(pace.due(), at + milliseconds(170));
}

TEST(PredictionPaceTest, KnowsWhenThePredictionAfterTheNextMayBegin) {
  PredictionPace pace;
  pace.predicted(kBegin, microseconds(2000));
  EXPECT_NEAR(millisecondsFrom(kBegin, pace.due()), 0.0, 1e-3);  // 10 ms were kept
  EXPECT_NEAR(millisecondsFrom(kBegin, pace.dueAfterNext()), 10.0, 1e-3);
}

TEST(PredictionPaceTest, APauseBetweenPosesIsNotTakenForTheirRate) {
  PredictionPace pace;
  SteadyTime at = kBegin;
  for (int i = 0; i < 200; ++i, at += milliseconds(1)) pace.received(at);
  at += seconds(30);
  for (int i = 0; i < 100; ++i, at += milliseconds(1)) pace.received(at);
  for (int i = 0; i < 100; ++i) pace.predicted(at, microseconds(600));
  EXPECT_NEAR(millisecondsFrom(pace.due(), pace.dueAfterNext()), 3.0, 1e-3);
}

TEST(PredictionPaceTest, APoseThatIsTriedAgainCountsOnce) {
  PredictionPace pace;
  SteadyTime at = kBegin;
  for (int i = 0; i < 200; ++i, at += milliseconds(10)) pace.received(at);
  for (int i = 0; i < 200; ++i) pace.received(at);
  pace.predicted(at, milliseconds(4));
  EXPECT_NEAR(millisecondsFrom(pace.due(), pace.dueAfterNext()), 4.0 / 0.45, 1e-3);
}

}  // namespace
}  // namespace sweep_guard_core
