#include "simulation/demo_statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "refusal.h"
#include "timeline.h"

namespace sweep_guard_simulation {
namespace {

using namespace sweep_guard_core::timeline;
using std::chrono::milliseconds;

using sweep_guard::ObjectContacts;

// Of a sweep without a narrow phase.
ObjectContacts contact(const std::string& id, const std::vector<std::uint32_t>& triangles,
                       const std::vector<std::string>& links = {}) {
  ObjectContacts object;
  object.mesh_id = id;
  object.triangles = triangles;
  for (const std::string& link : links) object.impacts.emplace_back().tool_link = link;
  return object;
}

class DemoStatisticsTest : public testing::Test {
 protected:
  void addPose(int ms, std::uint32_t sequence) { statistics_.addPose(at(ms), sequence); }
  void addSweep(int start, int stamp, int received, const std::vector<ObjectContacts>& contacts = {}) {
    statistics_.addContacts(at(start), at(stamp), at(received), contacts);
  }

  DemoStatistics statistics_;
};

TEST_F(DemoStatisticsTest, HasNoFaultWhenEveryPoseWasAnswered) {
  statistics_.addMeshUpdate(at(0));
  addPose(10, 1);
  addPose(20, 2);
  addSweep(10, 10, 11);
  addSweep(20, 20, 21);
  EXPECT_EQ(statistics_.posesNotSwept(), 0U);
  EXPECT_FALSE(statistics_.fault());
}

TEST_F(DemoStatisticsTest, WithACameraImagesCountInPlaceOfMeshUpdates) {
  statistics_.addImages(0);
  addPose(10, 1);
  addSweep(10, 10, 11);
  EXPECT_TRUE(has(statistics_.fault().value_or(""), "no depth image arrived"));
  statistics_.addImages(1);
  EXPECT_FALSE(statistics_.fault());
  EXPECT_TRUE(has(statistics_.summary(), "depth images          1\n")) << statistics_.summary();
}

TEST_F(DemoStatisticsTest, MatchesAnAnswerThatArrivesBeforeItsPose) {
  addSweep(10, 10, 11);
  EXPECT_EQ(statistics_.posesNotSwept(), 0U);
  addPose(10, 1);
  EXPECT_EQ(statistics_.posesNotSwept(), 0U);
}

TEST_F(DemoStatisticsTest, APoseThatWaitedIsSweptWithTheNextInEitherOrder) {
  statistics_.addMeshUpdate(at(0));
  addPose(10, 1);
  addSweep(10, 10, 11);
  addPose(20, 2);
  addPose(30, 3);
  EXPECT_EQ(statistics_.posesNotSwept(), 2U);
  addSweep(10, 30, 31);
  EXPECT_EQ(statistics_.posesNotSwept(), 0U);
  addSweep(30, 50, 51);
  addPose(40, 4);
  addPose(50, 5);
  EXPECT_FALSE(statistics_.fault());
}

TEST_F(DemoStatisticsTest, APoseIsNotSweptByTheIntervalThatBeginsAtIt) {
  addPose(10, 1);
  addSweep(10, 20, 21);
  EXPECT_EQ(statistics_.posesNotSwept(), 1U);
}

TEST_F(DemoStatisticsTest, ExpectsAnAnswerUntilItArrives) {
  addPose(10, 1);
  EXPECT_TRUE(statistics_.expects(at(10), at(10)));
  EXPECT_TRUE(statistics_.expects(at(0), at(20)));
  EXPECT_FALSE(statistics_.expects(at(10), at(20)));
  addSweep(10, 10, 11);
  EXPECT_FALSE(statistics_.expects(at(10), at(10)));
}

// An answer to another pose does not count.
TEST_F(DemoStatisticsTest, CountsALostPoseDespiteAnAnswerToAnotherPose) {
  addSweep(5, 5, 6);
  addPose(10, 1);
  EXPECT_EQ(statistics_.posesNotSwept(), 1U);
}

TEST_F(DemoStatisticsTest, CountsGapsInTheSequence) {
  statistics_.addMeshUpdate(at(0));
  for (const std::uint32_t sequence : {7U, 8U, 11U, 12U}) {
    const int ms = static_cast<int>(sequence);
    addPose(ms, sequence);
    addSweep(ms, ms, 20);
  }
  EXPECT_EQ(statistics_.posesNeverReceived(), 2U);
  EXPECT_EQ(statistics_.fault(), "2 poses were lost before the monitor");
}

TEST_F(DemoStatisticsTest, CountsContactsAndDistinctTriangles) {
  addSweep(10, 10, 11, {contact("a", {1, 2}), contact("b", {1})});
  addSweep(20, 20, 21, {contact("a", {2, 3})});
  addSweep(30, 30, 31, {contact("a", {})});  // inside
  addSweep(40, 40, 41);
  EXPECT_EQ(statistics_.sweeps(), 4U);
  EXPECT_EQ(statistics_.contacts(), 3U);
  EXPECT_EQ(statistics_.trianglesInContact(), 4U);
  EXPECT_EQ(statistics_.latencies().front().triangles, 3U);
}

TEST_F(DemoStatisticsTest, CountsTheContactsOfEachLink) {
  EXPECT_FALSE(has(statistics_.summary(), "  of "));
  addSweep(10, 10, 11, {contact("a", {1}, {"elbow", "wrist"}), contact("b", {1}, {"wrist"})});
  addSweep(20, 20, 21, {contact("a", {1}, {"wrist"})});
  EXPECT_TRUE(has(statistics_.summary(),
                  "contacts              2\n  of elbow             1\n  of wrist             2\ntriangles touched"));
}

TEST_F(DemoStatisticsTest, InterpolatesQuantilesOfTheLatencies) {
  EXPECT_TRUE(std::isnan(statistics_.latency(0.5)));
  for (const int delay : {4, 1, 3, 2}) addSweep(0, 0, delay);
  EXPECT_DOUBLE_EQ(statistics_.latency(0.0), 1.0);
  EXPECT_DOUBLE_EQ(statistics_.latency(0.5), 2.5);
  EXPECT_DOUBLE_EQ(statistics_.latency(1.0), 4.0);
}

TEST_F(DemoStatisticsTest, MissesACycleAboveAFifteenthOfASecond) {
  addSweep(0, 0, 66);
  addSweep(0, 0, 67);
  EXPECT_EQ(statistics_.missedCycles(), 1U);
}

TEST_F(DemoStatisticsTest, NamesTheInputThatIsMissing) {
  EXPECT_EQ(statistics_.fault(), "no tool pose arrived: the operator did not move");
  addPose(10, 1);
  EXPECT_EQ(statistics_.fault(), "no mesh update arrived: the workpiece did not deform");
  statistics_.addMeshUpdate(at(0));
  EXPECT_EQ(statistics_.fault(), "1 poses were not swept by the guard");
}

TEST_F(DemoStatisticsTest, ReportsTheLeadsOfTheWarnings) {
  EXPECT_TRUE(has(statistics_.summary(), "warned ahead of       0 of 0 contacts\n"));
  for (const auto& [ms, level] :
       {std::pair(100, kConsidered), std::pair(900, kReflex), std::pair(1000, kContact), std::pair(2000, kClear),
        std::pair(3000, kContact), std::pair(4000, kConsidered), std::pair(4400, kReflex), std::pair(4600, kContact)}) {
    statistics_.addWarning(at(ms), level);
  }
  EXPECT_TRUE(
      has(statistics_.summary(), "warned ahead of       2 of 3 contacts, by 0.60 s (reflex 0.10 s) in the median\n"));
}

TEST_F(DemoStatisticsTest, WritesTheLiveLine) {
  addPose(10, 1);
  statistics_.addContacts(at(10), at(10), sweep_guard_core::Time(std::chrono::microseconds(10400)),
                          {contact("a", {1})});
  EXPECT_EQ(statistics_.liveLine(milliseconds(12500), "CONTACT"),
            "12.5 s  poses 1  contacts 1  level CONTACT  latency p50 0.4 ms");
}

TEST_F(DemoStatisticsTest, TellsRateDentAndForceOfAnElasticWorkpiece) {
  addPose(10, 1);
  addSweep(10, 10, 11);
  for (int i = 0; i <= 60; ++i) statistics_.addMeshUpdate(at(20 * i));
  EXPECT_FALSE(has(statistics_.summary(), "dent"));
  for (const double dent : {0.001, 0.0104, 0.002}) statistics_.addDent(dent);
  for (const double force : {0.0, 1.236, 0.5}) statistics_.addForce(force);
  EXPECT_TRUE(has(statistics_.summary(), "mesh updates [Hz]     50.0\n"));
  EXPECT_TRUE(has(statistics_.summary(), "largest dent [mm]     10.4\n"));
  EXPECT_TRUE(has(statistics_.summary(), "largest force [N]     1.24\n"));
}

TEST_F(DemoStatisticsTest, AContactThatMakesNoDentOrNoForceIsAFault) {
  addPose(10, 1);
  statistics_.addMeshUpdate(at(0));
  statistics_.addDent(0.0);
  addSweep(10, 10, 11);
  EXPECT_FALSE(statistics_.fault());
  addSweep(10, 10, 11, {contact("workpiece", {3})});
  EXPECT_TRUE(has(statistics_.fault().value(), "did not give way"));
  statistics_.addDent(0.01);
  EXPECT_TRUE(has(statistics_.fault().value(), "no force"));
  statistics_.addForce(1.0);
  EXPECT_FALSE(statistics_.fault());
}

}  // namespace
}  // namespace sweep_guard_simulation
