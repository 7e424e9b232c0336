#include "guard/time_budget.h"

#include <gtest/gtest.h>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

using namespace std::chrono_literals;

constexpr size_t kReflex = 10;
constexpr size_t kConsidered = 10;  // one volume each
constexpr auto kCycle = 66ms;

// What a cycle takes if every predicted sweep costs this, once the budget has settled.
Duration settled(TimeBudget& budget, Duration measured, Duration per_sweep) {
  Duration total{};
  for (int i = 0; i < 500; ++i) {
    const size_t sweeps = kReflex + budget.consideredSweeps(kReflex, kConsidered);
    const Duration predicted = static_cast<int>(sweeps) * per_sweep;
    total = measured + predicted;
    budget.spentOnMeasured(measured);
    budget.spentOnPredicted(predicted, sweeps);
  }
  return total;
}

TEST(TimeBudgetTest, TakesAllStepsWhereTheyAreCheap) {
  TimeBudget budget({}, kCycle);
  budget.spentOnMeasured(500us);
  EXPECT_EQ(budget.consideredSweeps(kReflex, kConsidered), consideredSweeps({}));
  budget.spentOnPredicted(20 * 100us, 20);
  EXPECT_EQ(budget.consideredSweeps(kReflex, kConsidered), consideredSweeps({}));
}

TEST(TimeBudgetTest, BeginsCoarselyAfterASlowMeasuredSweep) {
  TimeBudget budget({}, kCycle);
  budget.spentOnMeasured(10ms);
  EXPECT_EQ(budget.consideredSweeps(kReflex, kConsidered), 1U);
  budget.spentOnPredicted(11 * 100us, 11);
  EXPECT_EQ(budget.consideredSweeps(kReflex, kConsidered), consideredSweeps({}));
}

TEST(TimeBudgetTest, TheDearerASweepTheFewerThereAre) {
  size_t before = consideredSweeps({});
  for (const Duration per_sweep : {1ms, 2ms, 3ms, 4ms, 5ms, 8ms, 100ms}) {
    TimeBudget budget({}, kCycle);
    settled(budget, 1ms, per_sweep);
    const size_t sweeps = budget.consideredSweeps(kReflex, kConsidered);
    EXPECT_LE(sweeps, before);
    EXPECT_GE(sweeps, 1U);
    before = sweeps;
  }
  EXPECT_EQ(before, 1U);
}

TEST(TimeBudgetTest, KeepsTheCycleAsLongAsTheReflexIntervalAndOneSweepFit) {
  for (Duration per_sweep = 100us; per_sweep * (kReflex + 1) + 5ms <= kCycle; per_sweep += 100us) {
    TimeBudget budget({}, kCycle);
    EXPECT_LE(settled(budget, 5ms, per_sweep), kCycle) << per_sweep.count() << " ns";
  }
}

TEST(TimeBudgetTest, RisesAtOnceAndFallsSlowly) {
  TimeBudget budget({}, kCycle);
  settled(budget, 1ms, 1ms);
  const size_t cheap = budget.consideredSweeps(kReflex, kConsidered);
  budget.spentOnPredicted(20 * 4ms, 20);
  const size_t dear = budget.consideredSweeps(kReflex, kConsidered);
  EXPECT_LT(dear, cheap);
  budget.spentOnPredicted(11 * 1ms, 11);
  EXPECT_LE(budget.consideredSweeps(kReflex, kConsidered), dear + 1);
  settled(budget, 1ms, 1ms);
  EXPECT_EQ(budget.consideredSweeps(kReflex, kConsidered), cheap);
}

TEST(TimeBudgetTest, ASlowMeasuredSweepLeavesLessToPredictionToo) {
  TimeBudget budget({}, kCycle);
  settled(budget, 0ms, 2ms);
  const size_t before = budget.consideredSweeps(kReflex, kConsidered);
  budget.spentOnMeasured(20ms);
  EXPECT_LT(budget.consideredSweeps(kReflex, kConsidered), before);
}

TEST(TimeBudgetTest, ACycleWithoutAPredictionDoesNotChangeItsCost) {
  TimeBudget budget({}, kCycle);
  budget.spentOnMeasured(10ms);
  budget.spentOnPredicted(0ms, 0);
  EXPECT_EQ(budget.consideredSweeps(kReflex, kConsidered), 1U);
}

// A tool that turns takes several volumes a step; a sweep that joins steps takes one.
TEST(TimeBudgetTest, CountsVolumesNotSweeps) {
  TimeBudget budget({}, kCycle);
  budget.spentOnMeasured(1ms);
  budget.spentOnPredicted(20 * 1ms, 20);
  EXPECT_EQ(budget.consideredSweeps(kReflex, 30), consideredSweeps({}));
  EXPECT_EQ(budget.consideredSweeps(42, 30), 6U);
  EXPECT_EQ(budget.consideredSweeps(100, 30), 1U);
}

TEST(TimeBudgetTest, LeavesToPredictionWhatTheMeasuredSweepDoesNotTake) {
  TimeBudget budget({}, kCycle);
  const Duration before = budget.forPrediction();
  EXPECT_GT(before, kCycle / 2);
  budget.spentOnMeasured(10ms);
  EXPECT_NEAR(toSeconds(before - budget.forPrediction()), 0.01, 1e-6);
  budget.spentOnMeasured(1s);
  EXPECT_EQ(budget.forPrediction(), Duration::zero());
}

TEST(TimeBudgetTest, RefusesACycleWithoutTime) {
  EXPECT_THROW(TimeBudget({}, 0ms), InvalidInput);
  HorizonOptions backwards;
  backwards.considered = 50ms;
  EXPECT_THROW(TimeBudget(backwards, kCycle), InvalidInput);
}

}  // namespace
}  // namespace sweep_guard_core
