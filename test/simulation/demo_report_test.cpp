#include "simulation/demo_report.h"

#include <gtest/gtest.h>

#include "refusal.h"

namespace sweep_guard_simulation {
namespace {

using std::chrono::milliseconds;
using sweep_guard_core::Time;

Time at(int ms) { return Time(milliseconds(ms)); }

TEST(DemoReportTest, IsContentWhenEveryPoseWasAnswered) {
  DemoReport report;
  report.addMeshUpdate();
  report.addPose(at(10), 1);
  report.addPose(at(20), 2);
  report.addContacts(at(10), at(10), at(11), {});
  report.addContacts(at(20), at(20), at(21), {});
  EXPECT_EQ(report.posesNotSwept(), 0U);
  EXPECT_FALSE(report.fault());
}

TEST(DemoReportTest, MatchesAnAnswerThatOvertakesItsPose) {
  DemoReport report;
  report.addContacts(at(10), at(10), at(11), {});
  EXPECT_EQ(report.posesNotSwept(), 0U);
  report.addPose(at(10), 1);
  EXPECT_EQ(report.posesNotSwept(), 0U);
}

TEST(DemoReportTest, APoseThatHadToWaitIsSweptWithTheNextWhicheverComesFirst) {
  DemoReport report;
  report.addMeshUpdate();
  report.addPose(at(10), 1);
  report.addContacts(at(10), at(10), at(11), {});
  report.addPose(at(20), 2);
  report.addPose(at(30), 3);
  EXPECT_EQ(report.posesNotSwept(), 2U);
  report.addContacts(at(10), at(30), at(31), {});
  EXPECT_EQ(report.posesNotSwept(), 0U);
  report.addContacts(at(30), at(50), at(51), {});
  report.addPose(at(40), 4);
  report.addPose(at(50), 5);
  EXPECT_FALSE(report.fault());
}

TEST(DemoReportTest, APoseIsNotSweptByTheIntervalThatBeginsAtIt) {
  DemoReport report;
  report.addPose(at(10), 1);
  report.addContacts(at(10), at(20), at(21), {});
  EXPECT_EQ(report.posesNotSwept(), 1U);
}

TEST(DemoReportTest, AwaitsAnAnswerUntilItCame) {
  DemoReport report;
  report.addPose(at(10), 1);
  EXPECT_TRUE(report.awaits(at(10), at(10)));
  EXPECT_TRUE(report.awaits(at(0), at(20)));
  EXPECT_FALSE(report.awaits(at(10), at(20)));
  report.addContacts(at(10), at(10), at(11), {});
  EXPECT_FALSE(report.awaits(at(10), at(10)));
}

// The answer to one pose must not make up for the missing answer to another.
TEST(DemoReportTest, DoesNotOffsetALostPoseByAForeignAnswer) {
  DemoReport report;
  report.addContacts(at(5), at(5), at(6), {});
  report.addPose(at(10), 1);
  EXPECT_EQ(report.posesNotSwept(), 1U);
}

TEST(DemoReportTest, CountsGapsInTheSequence) {
  DemoReport report;
  report.addMeshUpdate();
  for (const std::uint32_t sequence : {7U, 8U, 11U, 12U}) {
    report.addPose(at(static_cast<int>(sequence)), sequence);
    report.addContacts(at(static_cast<int>(sequence)), at(static_cast<int>(sequence)), at(20), {});
  }
  EXPECT_EQ(report.posesNeverReceived(), 2U);
  EXPECT_EQ(report.fault(), "2 poses were lost before the monitor got them");
}

TEST(DemoReportTest, CountsContactsAndDistinctTriangles) {
  DemoReport report;
  report.addContacts(at(10), at(10), at(11), {{"a", {1, 2}}, {"b", {1}}});
  report.addContacts(at(20), at(20), at(21), {{"a", {2, 3}}});
  report.addContacts(at(30), at(30), at(31), {{"a", {}}});  // inside of it
  report.addContacts(at(40), at(40), at(41), {});
  EXPECT_EQ(report.sweeps(), 4U);
  EXPECT_EQ(report.contacts(), 3U);
  EXPECT_EQ(report.trianglesTouched(), 4U);
  EXPECT_EQ(report.latencies().front().triangles, 3U);
}

TEST(DemoReportTest, TakesLatenciesByNearestRank) {
  DemoReport report;
  EXPECT_FALSE(report.latency(0.5));
  for (const int delay : {4, 1, 3, 2}) report.addContacts(at(0), at(0), at(delay), {});
  EXPECT_EQ(report.latency(0.0), milliseconds(1));
  EXPECT_EQ(report.latency(0.5), milliseconds(2));
  EXPECT_EQ(report.latency(0.99), milliseconds(4));
  EXPECT_EQ(report.latency(1.0), milliseconds(4));
}

TEST(DemoReportTest, MissesACycleAboveAFifteenthOfASecond) {
  DemoReport report;
  report.addContacts(at(0), at(0), at(66), {});
  report.addContacts(at(0), at(0), at(67), {});
  EXPECT_EQ(report.missedCycles(), 1U);
}

TEST(DemoReportTest, SaysWhatDidNotFlow) {
  DemoReport report;
  EXPECT_EQ(report.fault(), "no tool pose arrived: the operator did not move");
  report.addPose(at(10), 1);
  EXPECT_EQ(report.fault(), "no mesh update arrived: the workpiece did not deform");
  report.addMeshUpdate();
  EXPECT_EQ(report.fault(), "1 poses were not swept by the guard");
}

TEST(DemoReportTest, TellsHowLongAheadItWasWarned) {
  DemoReport report;
  EXPECT_TRUE(has(report.summary(), "warned ahead of       0 of 0 contacts\n"));
  report.addWarning(at(100), sweep_guard_core::WarningLevel::kConsidered);
  report.addWarning(at(900), sweep_guard_core::WarningLevel::kReflex);
  report.addWarning(at(1000), sweep_guard_core::WarningLevel::kContact);
  report.addWarning(at(2000), sweep_guard_core::WarningLevel::kClear);
  report.addWarning(at(3000), sweep_guard_core::WarningLevel::kContact);
  report.addWarning(at(4000), sweep_guard_core::WarningLevel::kConsidered);
  report.addWarning(at(4400), sweep_guard_core::WarningLevel::kReflex);
  report.addWarning(at(4600), sweep_guard_core::WarningLevel::kContact);
  EXPECT_TRUE(
      has(report.summary(), "warned ahead of       2 of 3 contacts, by 0.60 s (reflex 0.10 s) in the median\n"));
}

TEST(DemoReportTest, WritesTheLiveLine) {
  DemoReport report;
  report.addPose(at(10), 1);
  report.addContacts(at(10), at(10), Time(std::chrono::microseconds(10400)), {{"a", {1}}});
  EXPECT_EQ(report.liveLine(milliseconds(12500), "CONTACT"),
            "12.5 s  poses 1  contacts 1  level CONTACT  latency p50 0.4 ms");
}

}  // namespace
}  // namespace sweep_guard_simulation
