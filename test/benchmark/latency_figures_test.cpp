#include "latency/figures.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "latency/histogram.h"

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

TEST(HistogramTest, IsReadAsItWasWritten) {
  const std::string path = testing::TempDir() + "/latency_histogram.tsv";
  std::remove(path.c_str());
  appendHistogram(path, {"select, tcpros", 1600, "pose to warning"}, {0.51, 0.52, 0.64, 0.0});
  appendHistogram(path, {"select, nodelet", 1600, "pose to warning"}, {1.0});
  const std::vector<Histogram> read = readHistograms(path);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].title.method, "select, tcpros");
  EXPECT_EQ(read[0].title.work, "pose to warning");
  EXPECT_EQ(read[0].title.triangles, 1600);
  ASSERT_GT(read[0].shares.size(), 4U);
  EXPECT_EQ(read[0].shares.front(), 0.25);
  EXPECT_EQ(read[0].shares[1], 0.0);
  EXPECT_EQ((std::vector<double>{read[0].shares.end()[-3], read[0].shares.end()[-2], read[0].shares.back()}),
            (std::vector<double>{0.5, 0.0, 0.25}));
  EXPECT_NEAR(read[0].ms.end()[-3], 0.53, 0.03);
  EXPECT_EQ(read[1].shares, (std::vector<double>{1.0}));
}

}  // namespace
}  // namespace sweep_guard_benchmark
