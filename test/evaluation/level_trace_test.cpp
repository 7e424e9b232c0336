#include "evaluation/level_trace.h"

#include <gtest/gtest.h>

namespace sweep_guard_evaluation {
namespace {

using std::chrono::milliseconds;
using sweep_guard::Level;
using sweep_guard::Time;

Time at(int ms) { return Time(milliseconds(ms)); }

TEST(LevelTraceTest, JoinsWhatIsShownWithoutABreak) {
  LevelTrace trace;
  trace.show(at(0), Level::kClear);
  trace.show(at(10), Level::kConsidered);
  trace.show(at(20), Level::kReflex);
  trace.show(at(30), Level::kConsidered);
  trace.show(at(40), Level::kUnknown);
  trace.show(at(50), Level::kContact);
  trace.show(at(60), Level::kContact);

  const auto considered = trace.alarms(Level::kConsidered);
  ASSERT_EQ(considered.size(), 2U);
  EXPECT_EQ(considered[0].begin, at(10));
  EXPECT_EQ(considered[0].end, at(40));
  EXPECT_EQ(considered[1].begin, at(50));
  EXPECT_EQ(considered[1].end, at(60));

  const auto reflex = trace.alarms(Level::kReflex);
  ASSERT_EQ(reflex.size(), 2U);
  EXPECT_EQ(reflex[0].begin, at(20));
  EXPECT_EQ(reflex[0].end, at(30));
}

TEST(LevelTraceTest, HasNoAlarmWhereNothingWarns) {
  LevelTrace trace;
  EXPECT_TRUE(trace.alarms(Level::kConsidered).empty());
  trace.show(at(0), Level::kUnknown);
  trace.show(at(10), Level::kClear);
  EXPECT_TRUE(trace.alarms(Level::kConsidered).empty());
}

}  // namespace
}  // namespace sweep_guard_evaluation
