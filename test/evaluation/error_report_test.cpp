#include "evaluation/error_report.h"

#include <gtest/gtest.h>

#include "refusal.h"

namespace sweep_guard_evaluation {
namespace {

using std::chrono::milliseconds;

ErrorReport errorReport(const std::string& recording) {
  return {recording,
          {"hold", "constant_velocity", "direct"},
          {milliseconds(100), milliseconds(500)},
          {{{0.02, 0.04, 0.1, 0.2, 7}, {0.2, 0.4, 1.0, 2.0, 7}},
           {{0.01, 0.05, 0.1, 0.2, 7}, {0.2, 0.4, 1.0, 2.0, 7}},
           {{0.005, 0.02, 0.1, 0.2, 7}, {0.2, 0.4, 1.0, 2.0, 7}}}};
}

TEST(ErrorReportTest, WritesALineForEachPredictorAndHorizon) {
  const std::string csv = errorCsv({errorReport("hand")});
  EXPECT_EQ(csv.substr(0, csv.find("hand,constant")),
            "recording,predictor,horizon_s,position_median_m,position_p95_m,rotation_median_rad,rotation_p95_rad,"
            "samples\n"
            "hand,hold,0.1,0.02,0.04,0.1,0.2,7\n"
            "hand,hold,0.5,0.2,0.4,1,2,7\n");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 3 * 2);
}

TEST(ErrorReportTest, QuotesARecordingWithACommaInItsName) {
  EXPECT_TRUE(has(errorCsv({errorReport("left, \"2\"")}), "\n\"left, \"\"2\"\"\",direct,0.1,"));
}

TEST(ErrorReportTest, ComparesWithTheBetterOfHoldAndConstantVelocity) {
  EXPECT_TRUE(has(errorTable(errorReport("hand")), "5/20 (0.50/0.50)"));
}

}  // namespace
}  // namespace sweep_guard_evaluation
