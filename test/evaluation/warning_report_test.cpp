#include "evaluation/warning_report.h"

#include <gtest/gtest.h>

#include <cmath>

#include "refusal.h"

namespace sweep_guard_evaluation {
namespace {

/// Two thresholds: 4 of 10 contacts warned of at 2 false alarms per minute, 8 of 10 at 6; the second is chosen.
WarningReport report() {
  const AlarmStatistics few{10, {0.2, 0.6, 1.0, 1.4}, 4, 2.0};
  const AlarmStatistics many{10, {0.2, 0.3, 0.4, 0.6, 0.7, 0.8, 1.1, 1.2}, 12, 2.0};
  const AlarmStatistics reflex{10, {-0.01, 0.1, 0.2}, 1, 2.0};
  return {"hand", 20, {"direct"}, {0.1, 1.0}, 0, {{{reflex, many}, {reflex, few}}}};
}

TEST(WarningReportTest, WritesALineForEachPredictorAndInterval) {
  EXPECT_EQ(warningCsv({report()}),
            "recording,predictor,interval,contacts,warned,lead_median_s,lead_p5_s,false_alarms_per_min\n"
            "hand,direct,reflex,10,3,0.1,0.001,0.5\n"
            "hand,direct,considered,10,8,0.65,0.235,6\n");
}

TEST(WarningReportTest, ShowsTheSharesThatAreWarnedOfAhead) {
  const std::string table = warningTable(report());
  EXPECT_TRUE(has(table, "hand, 20 placements"));
  EXPECT_TRUE(has(table, "80.0 %   50.0 %   20.0 %"));
}

TEST(TradeoffReportTest, WritesALineForEachThreshold) {
  EXPECT_EQ(tradeoffCsv({report()}),
            "recording,predictor,min_probability,false_alarms_per_min,warned_0.1,warned_0.5,warned_1.0,chosen\n"
            "hand,direct,0.1,6,0.8,0.5,0.2,1\n"
            "hand,direct,1,2,0.4,0.3,0.2,0\n");
}

// 0 up to 2 per minute, 0.4 up to 6, 0.8 up to 10.
TEST(TradeoffReportTest, AveragesTheBestShareThatFewEnoughFalseAlarmsGive) {
  EXPECT_NEAR(meanShareWarned(report(), 0, 0.1, 10.0), (4.0 * 0.4 + 4.0 * 0.8) / 10.0, 1e-12);
  EXPECT_NEAR(meanShareWarned(report(), 0, 0.1, 4.0), 2.0 * 0.4 / 4.0, 1e-12);
  EXPECT_NEAR(meanShareWarned(report(), 0, 0.1, 1.0), 0.0, 1e-12);
  EXPECT_NEAR(meanShareWarned(report(), 0, 0.5, 10.0), (4.0 * 0.3 + 4.0 * 0.5) / 10.0, 1e-12);
}

// More false alarms for fewer contacts are no progress.
TEST(TradeoffReportTest, DoesNotFallWhereAThresholdIsWorseThanAnother) {
  WarningReport worse = report();
  std::swap(worse.statistics[0][0][1].leads, worse.statistics[0][1][1].leads);
  EXPECT_NEAR(meanShareWarned(worse, 0, 0.1, 10.0), 8.0 * 0.8 / 10.0, 1e-12);
}

TEST(TradeoffReportTest, IsUnknownWithoutContacts) {
  WarningReport none = report();
  none.statistics[0] = {{}, {}};
  EXPECT_TRUE(std::isnan(meanShareWarned(none, 0, 0.1, 10.0)));
}

TEST(TradeoffReportTest, GoesFromTheLeastProbabilityToThePathAlone) {
  const std::vector<double> thresholds = tradeoffThresholds(0.123);
  EXPECT_EQ(thresholds.front(), 0.001);
  EXPECT_EQ(thresholds.back(), 1.0);
  EXPECT_EQ(std::count(thresholds.begin(), thresholds.end(), 0.123), 1);
  EXPECT_TRUE(std::is_sorted(thresholds.begin(), thresholds.end()));
  EXPECT_EQ(tradeoffThresholds(0.1).size() + 1, thresholds.size());
}

}  // namespace
}  // namespace sweep_guard_evaluation
