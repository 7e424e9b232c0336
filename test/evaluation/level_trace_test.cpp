#include "evaluation/level_trace.h"

#include <gtest/gtest.h>

namespace sweep_guard_evaluation {
namespace {

using std::chrono::milliseconds;
using sweep_guard_core::Time;
using sweep_guard_core::WarningLevel;

Time at(int ms) { return Time(milliseconds(ms)); }

TEST(LevelTraceTest, JoinsWhatIsShownWithoutABreak) {
  LevelTrace trace;
  trace.show(at(0), WarningLevel::kClear);
  trace.show(at(10), WarningLevel::kConsidered);
  trace.show(at(20), WarningLevel::kReflex);
  trace.show(at(30), WarningLevel::kConsidered);
  trace.show(at(40), WarningLevel::kUnknown);
  trace.show(at(50), WarningLevel::kContact);
  trace.show(at(60), WarningLevel::kContact);

  const auto considered = trace.alarms(WarningLevel::kConsidered);
  ASSERT_EQ(considered.size(), 2U);
  EXPECT_EQ(considered[0].begin, at(10));
  EXPECT_EQ(considered[0].end, at(40));
  EXPECT_EQ(considered[1].begin, at(50));
  EXPECT_EQ(considered[1].end, at(60));

  const auto reflex = trace.alarms(WarningLevel::kReflex);
  ASSERT_EQ(reflex.size(), 2U);
  EXPECT_EQ(reflex[0].begin, at(20));
  EXPECT_EQ(reflex[0].end, at(30));
}

TEST(LevelTraceTest, HasNoAlarmWhereNothingWarns) {
  LevelTrace trace;
  EXPECT_TRUE(trace.alarms(WarningLevel::kConsidered).empty());
  trace.show(at(0), WarningLevel::kUnknown);
  trace.show(at(10), WarningLevel::kClear);
  EXPECT_TRUE(trace.alarms(WarningLevel::kConsidered).empty());
}

}  // namespace
}  // namespace sweep_guard_evaluation
