#include "latency/latencies.h"

#include <gtest/gtest.h>

namespace sweep_guard_benchmark {
namespace {

constexpr Nanoseconds kMs = 1'000'000;

TEST(LatencyFiguresTest, APoseIsAnsweredByTheFirstMessageThatCoversIt) {
  const std::vector<ReceivedMessage> messages = {{0, 1 * kMs, 4 * kMs}, {1 * kMs, 3 * kMs, 9 * kMs}};
  EXPECT_EQ(latencies({1 * kMs, 2 * kMs, 3 * kMs}, messages), (std::vector<double>{3.0, 7.0, 6.0}));
}

TEST(LatencyFiguresTest, APoseThatNoMessageCoversIsLeftOut) {
  const std::vector<ReceivedMessage> messages = {{1 * kMs, 2 * kMs, 3 * kMs}, {5 * kMs, 6 * kMs, 8 * kMs}};
  EXPECT_EQ(latencies({1 * kMs, 2 * kMs, 4 * kMs, 6 * kMs, 7 * kMs}, messages), (std::vector<double>{1.0, 2.0}));
}

// The first message after the start is of one pose: it begins where it ends.
TEST(LatencyFiguresTest, AMessageOfNoMotionCoversItsPose) {
  EXPECT_EQ(latencies({2 * kMs}, {{2 * kMs, 2 * kMs, 3 * kMs}}), (std::vector<double>{1.0}));
}

TEST(LatencyFiguresTest, AMessageThatRepeatsAnotherIsNotOlder) {
  const std::vector<ReceivedMessage> messages = {
      {0, 1 * kMs, 2 * kMs}, {0, 1 * kMs, 50 * kMs}, {0, 52 * kMs, 54 * kMs}};
  EXPECT_EQ(ages(messages), (std::vector<double>{1.0, 2.0}));
}

TEST(LatencyFiguresTest, AHoleIsWhereAMessageBeginsAfterTheEndOfTheOneBefore) {
  EXPECT_EQ(holes({}), 0U);
  EXPECT_EQ(holes({{5, 6, 9}, {6, 8, 9}, {7, 9, 9}, {9, 9, 9}}), 0U);
  EXPECT_EQ(holes({{5, 6, 9}, {7, 8, 9}, {8, 9, 9}, {10, 11, 12}}), 2U);
}

TEST(LatencyFiguresTest, WhatIsWithinGoesByItsStamp) {
  const std::vector<ReceivedMessage> inside = within({{0, 1, 9}, {1, 2, 9}, {2, 3, 9}}, 2, 3);
  ASSERT_EQ(inside.size(), 1U);
  EXPECT_EQ(inside.front().stamp, 2);
}

TEST(HistogramTest, HasTwentyClassesPerDecadeAndNoGap) {
  const std::vector<HistogramClass> classes = histogram({0.51, 0.52, 0.64, 0.79});
  ASSERT_EQ(classes.size(), 4U);
  EXPECT_NEAR(classes[0].middle_ms, 0.531, 0.001);  // 10^(-5.5 / 20)
  EXPECT_NEAR(classes[3].middle_ms, 0.750, 0.001);  // 10^(-2.5 / 20)
  EXPECT_EQ(classes[0].share, 0.5);
  EXPECT_EQ(classes[1].share, 0.0);
  EXPECT_EQ(classes[2].share, 0.25);
  EXPECT_EQ(classes[3].share, 0.25);
}

TEST(HistogramTest, CountsWhatIsBelowAMicrosecondAsOne) {
  const std::vector<HistogramClass> classes = histogram({0.0, -1.0});
  ASSERT_EQ(classes.size(), 1U);
  EXPECT_NEAR(classes[0].middle_ms, 0.00106, 0.00001);  // 10^(-59.5 / 20)
  EXPECT_EQ(classes[0].share, 1.0);
  EXPECT_TRUE(histogram({}).empty());
}

}  // namespace
}  // namespace sweep_guard_benchmark
