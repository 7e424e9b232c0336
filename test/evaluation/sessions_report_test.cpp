#include "evaluation/sessions_report.h"

#include <gtest/gtest.h>

#include "refusal.h"

namespace sweep_guard_evaluation {
namespace {

SessionCount counted(size_t contacts, size_t alarms, size_t unjustified) {
  SessionCount count;
  count.contacts = contacts;
  count.warned = {contacts, contacts, contacts / 2, 0};
  count.alarms = alarms;
  count.unjustified = unjustified;
  count.unjustified_time = std::chrono::seconds(6 * unjustified);
  count.near_misses = {0, unjustified / 2, unjustified};
  return count;
}

/// Two sessions of 2 min beside two objects each.
RecordingSessions hand() {
  return {"hand, left", 2.0, {{counted(2, 5, 4), counted(0, 0, 0)}, {counted(2, 4, 2), counted(0, 1, 0)}}};
}

TEST(SessionsReportTest, RatesAreThoseBesideOneObject) {
  EXPECT_EQ(sessionsCsv({hand()}),
            "recording,minutes,contacts,warned_0.1,warned_0.3,warned_0.5,warned_1.0,unjustified_per_min,precision,"
            "precision_10mm,precision_20mm,precision_50mm,false_on_share\n"
            "\"hand, left\",8,4,1,1,0.5,0,0.75,0.4,0.4,0.7,1,0.075\n"
            "all,8,4,1,1,0.5,0,0.75,0.4,0.4,0.7,1,0.075\n");
}

TEST(SessionsReportTest, AllRecordingsCountByTheirLengths) {
  const SessionCount all = sumOf({hand(), {"arm", 1.0, {{counted(1, 6, 6)}}}});
  EXPECT_EQ(all.minutes, 9.0);
  EXPECT_NEAR(all.unjustifiedPerMinute(), 12.0 / 9.0, 1e-12);
  EXPECT_NEAR(all.precision(), 4.0 / 16.0, 1e-12);
}

TEST(SessionsReportTest, TheTableNamesContactsThatReflexMissed) {
  RecordingSessions missed = hand();
  missed.objects[0][0].late = 1;
  EXPECT_TRUE(has(sessionsTable({missed}), "4 contacts, 1 without REFLEX"));
}

TEST(SessionsReportTest, IntervalsHoldTheFigureAndAreAPointForEqualObjects) {
  const auto rate = [](const RecordingSessions& sessions) {
    return bootstrap(
        [&](size_t draw) { return std::vector<double>{sumOf(resampled({sessions}, draw)).unjustifiedPerMinute()}; })[0];
  };
  const Interval different = rate(hand());
  EXPECT_LT(different.lower, 0.75);
  EXPECT_GT(different.upper, 0.75);
  const Interval equal = rate({"arm", 2.0, {{counted(1, 4, 3), counted(1, 4, 3)}}});
  EXPECT_EQ(equal.lower, 1.5);
  EXPECT_EQ(equal.upper, 1.5);
}

// Halved for every object, the ratio is a half in each draw: of pairs, not of two independent draws.
TEST(SessionsReportTest, TwoRunsAreComparedInPairs) {
  RecordingSessions half = hand();
  for (auto& session : half.objects) {
    for (SessionCount& object : session) object.unjustified /= 2;
  }
  const auto before = readSessionObjects(sessionObjectsCsv({hand()}));
  EXPECT_EQ(sessionsCsv(before).substr(0, 180), sessionsCsv({hand()}).substr(0, 180));
  EXPECT_TRUE(has(sessionsComparison({half}, before), "ratio    0.500  [0.500, 0.500]"));
}

TEST(SessionsReportTest, RefusesRunsThatDiffer) {
  RecordingSessions other = hand();
  other.objects[0].pop_back();
  EXPECT_TRUE(has(::refusal([&] { sessionsComparison({hand()}, {other}); }), "differ"));
  EXPECT_TRUE(has(::refusal([&] { readSessionObjects("nothing\n"); }), "line 1"));
  const std::string csv = sessionObjectsCsv({hand()});
  EXPECT_TRUE(has(::refusal([&] { readSessionObjects(csv + "a,b\n"); }), "line 6"));
  EXPECT_TRUE(has(::refusal([&] { readSessionObjects(csv + "a,0,0,x,1,1,1,1,1,1,1,1,1,1,1\n"); }), "'x'"));
}

}  // namespace
}  // namespace sweep_guard_evaluation
