#include "sweep_guard/prediction/horizon.h"

#include <gtest/gtest.h>

#include "scenes.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

using namespace std::chrono_literals;

Duration longest(const std::vector<Duration>& ends, size_t first, size_t last) {
  Duration longest = Duration::zero();
  for (size_t i = first; i < last; ++i)
    longest = std::max(longest, ends[i] - (i == 0 ? Duration::zero() : ends[i - 1]));
  return longest;
}

Horizon horizonOf(const HorizonOptions& options, Duration age) {
  Horizon horizon;
  computeHorizon(options, age, horizon);
  return horizon;
}

// [P, Sec. 3.2, Fig. 6] from a pose that has just come: ten steps of 10 ms, then ten of 100 ms.
TEST(HorizonTest, CutsBothIntervalsIntoTheirSteps) {
  const Horizon ahead = horizonOf({}, 0ms);
  EXPECT_EQ(ahead.reflex_sweeps, 10U);
  const std::vector<Duration> expected = {10ms,  20ms,  30ms,  40ms,  50ms,  60ms,  70ms,  80ms,  90ms,   100ms,
                                          200ms, 300ms, 400ms, 500ms, 600ms, 700ms, 800ms, 900ms, 1000ms, 1100ms};
  EXPECT_EQ(ahead.ends, expected);
}

TEST(HorizonTest, EndsAnywhere) {
  EXPECT_EQ(horizonUpTo(4ms, {}, 0ms).ends, (std::vector<Duration>{4ms}));
  EXPECT_EQ(horizonUpTo(4ms, {}, 0ms).reflex_sweeps, 1U);
  EXPECT_EQ(horizonUpTo(30ms, {}, 0ms).ends, (std::vector<Duration>{10ms, 20ms, 30ms}));
  const Horizon far = horizonUpTo(5s, {}, 20ms);
  EXPECT_EQ(far.ends.back(), 5020ms);
  EXPECT_EQ(far.reflex_sweeps, 12U);
  EXPECT_LE(longest(far.ends, 0, far.reflex_sweeps), 10ms);
  EXPECT_LE(longest(far.ends, far.reflex_sweeps, far.ends.size()), 100ms);
  const Horizon between = horizonUpTo(555ms, {}, 20ms);
  EXPECT_EQ(between.ends.back(), 575ms);
  EXPECT_TRUE(std::is_sorted(between.ends.begin(), between.ends.end(), std::less_equal<>()));
}

TEST(HorizonTest, CountsFromNowNotFromThePose) {
  const Horizon ahead = horizonOf({}, 35ms);
  EXPECT_EQ(ahead.ends[ahead.reflex_sweeps - 1], 135ms);
  EXPECT_EQ(ahead.ends.back(), 1135ms);
}

// Random options, steps that do not divide their interval among them.
TEST(HorizonTest, LeavesNothingOutAndTakesNoLongerStepsThanAskedFor) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    HorizonOptions options;
    options.reflex = fromSeconds(random.uniform(0.01, 0.5));
    options.reflex_step = fromSeconds(random.logUniform(0.001, 1.0));
    options.considered = options.reflex + fromSeconds(random.uniform(0.01, 3.0));
    options.considered_step = fromSeconds(random.logUniform(0.01, 5.0));
    options.reserve = fromSeconds(random.uniform(0.0, 0.3));
    const Duration age = fromSeconds(random.uniform(0.0, toSeconds(options.reserve)));
    const Horizon ahead = horizonOf(options, age);
    ASSERT_EQ(ahead.ends.size(), ahead.reflex_sweeps + consideredSweeps(options));
    EXPECT_GT(ahead.ends.front(), Duration::zero());
    EXPECT_TRUE(std::is_sorted(ahead.ends.begin(), ahead.ends.end(), std::less_equal<>()));
    EXPECT_EQ(ahead.ends[ahead.reflex_sweeps - 1], age + options.reflex);
    EXPECT_EQ(ahead.ends.back(), age + options.considered + options.reserve);
    EXPECT_LE(longest(ahead.ends, 0, ahead.reflex_sweeps), options.reflex_step);
    EXPECT_LE(longest(ahead.ends, ahead.reflex_sweeps, ahead.ends.size()), options.considered_step);
  }
}

// Such a pose is stale: the work that it makes is bounded, what it covers is not cut.
TEST(HorizonTest, APoseOlderThanTheReserveTakesNoMoreSweeps) {
  const Horizon ahead = horizonOf({}, std::chrono::hours(1));
  EXPECT_EQ(ahead.reflex_sweeps, reflexSweeps({}, 100ms));
  EXPECT_EQ(ahead.ends[ahead.reflex_sweeps - 1], std::chrono::hours(1) + 100ms);
  EXPECT_EQ(ahead.ends.back(), std::chrono::hours(1) + 1100ms);
}

TEST(HorizonTest, RefusesWhatCannotBeCut) {
  const auto refused = [](const std::function<void(HorizonOptions&)>& spoil) {
    HorizonOptions options;
    spoil(options);
    EXPECT_THROW(check(options), InvalidInput);
  };
  refused([](auto& options) { options.reflex = 0ms; });
  refused([](auto& options) { options.reflex = -1ms; });
  refused([](auto& options) { options.reflex_step = 0ms; });
  refused([](auto& options) { options.considered_step = 0ms; });
  refused([](auto& options) { options.considered = options.reflex; });
  refused([](auto& options) { options.reserve = -1ns; });
  refused([](auto& options) { options.reflex_step = 1us; });
  refused([](auto& options) { options.considered_step = 10us; });
  EXPECT_NO_THROW(check({}));
}

}  // namespace
}  // namespace sweep_guard_core
