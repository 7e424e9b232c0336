#include "simulation/demo_statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "refusal.h"

namespace sweep_guard_simulation {
namespace {

using std::chrono::milliseconds;
using sweep_guard_core::Time;

Time at(int ms) { return Time(milliseconds(ms)); }

TEST(DemoStatisticsTest, HasNoFaultWhenEveryPoseWasAnswered) {
  DemoStatistics statistics;
  statistics.addMeshUpdate();
  statistics.addPose(at(10), 1);
  statistics.addPose(at(20), 2);
  statistics.addContacts(at(10), at(10), at(11), {});
  statistics.addContacts(at(20), at(20), at(21), {});
  EXPECT_EQ(statistics.posesNotSwept(), 0U);
  EXPECT_FALSE(statistics.fault());
}

TEST(DemoStatisticsTest, MatchesAnAnswerThatArrivesBeforeItsPose) {
  DemoStatistics statistics;
  statistics.addContacts(at(10), at(10), at(11), {});
  EXPECT_EQ(statistics.posesNotSwept(), 0U);
  statistics.addPose(at(10), 1);
  EXPECT_EQ(statistics.posesNotSwept(), 0U);
}

TEST(DemoStatisticsTest, APoseThatWaitedIsSweptWithTheNextInEitherOrder) {
  DemoStatistics statistics;
  statistics.addMeshUpdate();
  statistics.addPose(at(10), 1);
  statistics.addContacts(at(10), at(10), at(11), {});
  statistics.addPose(at(20), 2);
  statistics.addPose(at(30), 3);
  EXPECT_EQ(statistics.posesNotSwept(), 2U);
  statistics.addContacts(at(10), at(30), at(31), {});
  EXPECT_EQ(statistics.posesNotSwept(), 0U);
  statistics.addContacts(at(30), at(50), at(51), {});
  statistics.addPose(at(40), 4);
  statistics.addPose(at(50), 5);
  EXPECT_FALSE(statistics.fault());
}

TEST(DemoStatisticsTest, APoseIsNotSweptByTheIntervalThatBeginsAtIt) {
  DemoStatistics statistics;
  statistics.addPose(at(10), 1);
  statistics.addContacts(at(10), at(20), at(21), {});
  EXPECT_EQ(statistics.posesNotSwept(), 1U);
}

TEST(DemoStatisticsTest, ExpectsAnAnswerUntilItArrives) {
  DemoStatistics statistics;
  statistics.addPose(at(10), 1);
  EXPECT_TRUE(statistics.expects(at(10), at(10)));
  EXPECT_TRUE(statistics.expects(at(0), at(20)));
  EXPECT_FALSE(statistics.expects(at(10), at(20)));
  statistics.addContacts(at(10), at(10), at(11), {});
  EXPECT_FALSE(statistics.expects(at(10), at(10)));
}

// An answer to another pose does not count.
TEST(DemoStatisticsTest, CountsALostPoseDespiteAnAnswerToAnotherPose) {
  DemoStatistics statistics;
  statistics.addContacts(at(5), at(5), at(6), {});
  statistics.addPose(at(10), 1);
  EXPECT_EQ(statistics.posesNotSwept(), 1U);
}

TEST(DemoStatisticsTest, CountsGapsInTheSequence) {
  DemoStatistics statistics;
  statistics.addMeshUpdate();
  for (const std::uint32_t sequence : {7U, 8U, 11U, 12U}) {
    statistics.addPose(at(static_cast<int>(sequence)), sequence);
    statistics.addContacts(at(static_cast<int>(sequence)), at(static_cast<int>(sequence)), at(20), {});
  }
  EXPECT_EQ(statistics.posesNeverReceived(), 2U);
  EXPECT_EQ(statistics.fault(), "2 poses were lost before the monitor");
}

TEST(DemoStatisticsTest, CountsContactsAndDistinctTriangles) {
  DemoStatistics statistics;
  statistics.addContacts(at(10), at(10), at(11), {{"a", {1, 2}}, {"b", {1}}});
  statistics.addContacts(at(20), at(20), at(21), {{"a", {2, 3}}});
  statistics.addContacts(at(30), at(30), at(31), {{"a", {}}});  // inside
  statistics.addContacts(at(40), at(40), at(41), {});
  EXPECT_EQ(statistics.sweeps(), 4U);
  EXPECT_EQ(statistics.contacts(), 3U);
  EXPECT_EQ(statistics.trianglesInContact(), 4U);
  EXPECT_EQ(statistics.latencies().front().triangles, 3U);
}

TEST(DemoStatisticsTest, InterpolatesQuantilesOfTheLatencies) {
  DemoStatistics statistics;
  EXPECT_TRUE(std::isnan(statistics.latency(0.5)));
  for (const int delay : {4, 1, 3, 2}) statistics.addContacts(at(0), at(0), at(delay), {});
  EXPECT_DOUBLE_EQ(statistics.latency(0.0), 1.0);
  EXPECT_DOUBLE_EQ(statistics.latency(0.5), 2.5);
  EXPECT_DOUBLE_EQ(statistics.latency(1.0), 4.0);
}

TEST(DemoStatisticsTest, MissesACycleAboveAFifteenthOfASecond) {
  DemoStatistics statistics;
  statistics.addContacts(at(0), at(0), at(66), {});
  statistics.addContacts(at(0), at(0), at(67), {});
  EXPECT_EQ(statistics.missedCycles(), 1U);
}

TEST(DemoStatisticsTest, NamesTheInputThatIsMissing) {
  DemoStatistics statistics;
  EXPECT_EQ(statistics.fault(), "no tool pose arrived: the operator did not move");
  statistics.addPose(at(10), 1);
  EXPECT_EQ(statistics.fault(), "no mesh update arrived: the workpiece did not deform");
  statistics.addMeshUpdate();
  EXPECT_EQ(statistics.fault(), "1 poses were not swept by the guard");
}

TEST(DemoStatisticsTest, ReportsTheLeadsOfTheWarnings) {
  DemoStatistics statistics;
  EXPECT_TRUE(has(statistics.summary(), "warned ahead of       0 of 0 contacts\n"));
  statistics.addWarning(at(100), sweep_guard_core::WarningLevel::kConsidered);
  statistics.addWarning(at(900), sweep_guard_core::WarningLevel::kReflex);
  statistics.addWarning(at(1000), sweep_guard_core::WarningLevel::kContact);
  statistics.addWarning(at(2000), sweep_guard_core::WarningLevel::kClear);
  statistics.addWarning(at(3000), sweep_guard_core::WarningLevel::kContact);
  statistics.addWarning(at(4000), sweep_guard_core::WarningLevel::kConsidered);
  statistics.addWarning(at(4400), sweep_guard_core::WarningLevel::kReflex);
  statistics.addWarning(at(4600), sweep_guard_core::WarningLevel::kContact);
  EXPECT_TRUE(
      has(statistics.summary(), "warned ahead of       2 of 3 contacts, by 0.60 s (reflex 0.10 s) in the median\n"));
}

TEST(DemoStatisticsTest, WritesTheLiveLine) {
  DemoStatistics statistics;
  statistics.addPose(at(10), 1);
  statistics.addContacts(at(10), at(10), Time(std::chrono::microseconds(10400)), {{"a", {1}}});
  EXPECT_EQ(statistics.liveLine(milliseconds(12500), "CONTACT"),
            "12.5 s  poses 1  contacts 1  level CONTACT  latency p50 0.4 ms");
}

}  // namespace
}  // namespace sweep_guard_simulation
