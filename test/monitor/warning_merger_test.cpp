#include "monitor/warning_merger.h"

#include <gtest/gtest.h>

#include <random>

#include "sweep_guard/monitor/reason.h"

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

constexpr auto kUnknown = WarningLevel::kUnknown;
constexpr auto kClear = WarningLevel::kClear;
constexpr auto kConsidered = WarningLevel::kConsidered;
constexpr auto kReflex = WarningLevel::kReflex;
constexpr auto kContact = WarningLevel::kContact;
constexpr size_t kLeft = 0;
constexpr size_t kRight = 1;

Instant instantAt(Duration time) {
  return {Time(std::chrono::seconds(1000) + time), SteadyTime(std::chrono::seconds(5) + time)};
}

// As a guard publishes it, received at once.
HeardWarning said(WarningLevel level, Duration time = {}) {
  HeardWarning warning;
  warning.level = level;
  warning.stamp = instantAt(time).stamp - milliseconds(5);
  warning.covered_until = instantAt(time).stamp + milliseconds(1000);
  warning.valid_until = instantAt(time).stamp + kWarningValid;
  warning.text = styleOf(level).name;
  warning.received = instantAt(time);
  return warning;
}

class WarningMergerTest : public testing::Test {
 protected:
  MergedWarning merged(WarningLevel left, WarningLevel right) {
    merger_.hear(kLeft, said(left));
    merger_.hear(kRight, said(right));
    return merger_.merged(instantAt({}));
  }
  MergedWarning merged(const HeardWarning& left, const HeardWarning& right) {
    merger_.hear(kLeft, left);
    merger_.hear(kRight, right);
    return merger_.merged(instantAt({}));
  }

  WarningMerger merger_{{"/left", "/right"}};
};

TEST_F(WarningMergerTest, IsClearOnlyIfEachGuardIs) {
  const MergedWarning clear = merged(kClear, kClear);
  EXPECT_EQ(clear.level, kClear);
  EXPECT_EQ(clear.text, "CLEAR");
  EXPECT_EQ(clear.reasons, 0U);
  for (const WarningLevel level : {kUnknown, kConsidered, kReflex, kContact}) {
    EXPECT_EQ(merged(kClear, level).level, level);
    EXPECT_EQ(merged(level, kClear).level, level);
  }
}

TEST_F(WarningMergerTest, AContactStaysVisibleBesideAGuardThatKnowsNothing) {
  for (const WarningLevel level : {kConsidered, kReflex, kContact}) {
    HeardWarning unknown = said(kUnknown);
    unknown.reasons = kMeshStale;
    const MergedWarning both = merged(unknown, said(level));
    EXPECT_EQ(both.level, level);
    EXPECT_EQ(both.leader, kRight);
    EXPECT_EQ(both.reasons, kMeshStale);
  }
}

TEST_F(WarningMergerTest, IsUnknownBeforeEachGuardHasSpoken) {
  EXPECT_EQ(merger_.merged(instantAt({})).level, kUnknown);
  merger_.hear(kLeft, said(kClear));
  const MergedWarning one = merger_.merged(instantAt({}));
  EXPECT_EQ(one.level, kUnknown);
  EXPECT_EQ(one.reasons, kNotCovered);
  EXPECT_EQ(one.leader, std::nullopt);
  EXPECT_EQ(one.covered_until, Time());
  EXPECT_EQ(one.text, "UNKNOWN: /right: no warning yet");
}

TEST_F(WarningMergerTest, IsUnknown200MillisecondsAfterAGuardFellSilent) {
  merger_.hear(kLeft, said(kClear));
  HeardWarning later = said(kClear, milliseconds(150));
  later.valid_until += milliseconds(100);
  merger_.hear(kRight, later);
  EXPECT_EQ(merger_.merged(instantAt(milliseconds(200))).level, kClear);
  const MergedWarning silent = merger_.merged(instantAt(milliseconds(201)));
  EXPECT_EQ(silent.level, kUnknown);
  EXPECT_EQ(silent.text, "UNKNOWN: /left: silent for 0.20 s");
}

TEST_F(WarningMergerTest, AWarningThatCameLateCountsOnlyAsLongAsItIsValid) {
  merger_.hear(kLeft, said(kClear));
  HeardWarning delayed = said(kClear);
  delayed.received = instantAt(milliseconds(150));
  merger_.hear(kRight, delayed);
  merger_.hear(kLeft, said(kClear, milliseconds(150)));
  const MergedWarning valid = merger_.merged(instantAt(milliseconds(200)));
  EXPECT_EQ(valid.level, kClear);
  EXPECT_EQ(valid.valid_until, instantAt(milliseconds(200)).stamp);
  const MergedWarning over = merger_.merged(instantAt(milliseconds(210)));
  EXPECT_EQ(over.level, kUnknown);
  EXPECT_EQ(over.text, "UNKNOWN: /right: newest warning came 0.15 s late, or clocks differ");
}

TEST_F(WarningMergerTest, AGuardWhoseClockIsAheadCountsAsSilent) {
  HeardWarning ahead = said(kClear);
  ahead.valid_until += WarningMerger::kMaxLead;
  EXPECT_EQ(merged(said(kClear), ahead).level, kClear);
  ahead.valid_until += milliseconds(20);
  const MergedWarning both = merged(said(kClear), ahead);
  EXPECT_EQ(both.level, kUnknown);
  EXPECT_EQ(both.text, "UNKNOWN: /right: warning is 0.12 s ahead: clocks differ");
}

TEST_F(WarningMergerTest, ASilentContactIsNoLongerShown) {
  merger_.hear(kLeft, said(kContact));
  merger_.hear(kRight, said(kClear, milliseconds(250)));
  EXPECT_EQ(merger_.merged(instantAt(milliseconds(250))).level, kUnknown);
}

TEST_F(WarningMergerTest, ShowsTheEarlierOfTwoCollisions) {
  HeardWarning sooner = said(kConsidered);
  HeardWarning later = said(kConsidered);
  sooner.time_to_collision = milliseconds(300);
  later.time_to_collision = milliseconds(400);
  EXPECT_EQ(merged(later, sooner).leader, kRight);
  EXPECT_EQ(merged(sooner, later).leader, kLeft);
  EXPECT_EQ(merged(later, sooner).time_to_collision, milliseconds(300));
  EXPECT_EQ(merged(said(kConsidered), later).leader, kRight) << "one without a time is only probable";
}

TEST_F(WarningMergerTest, ShowsWhatLastsAndIsNotAcknowledgedBeforeTheOther) {
  HeardWarning acknowledged = said(kConsidered);
  acknowledged.acknowledged = true;
  acknowledged.time_to_collision = milliseconds(100);
  EXPECT_EQ(merged(acknowledged, said(kConsidered)).leader, kRight);
  EXPECT_FALSE(merged(acknowledged, said(kConsidered)).acknowledged);
  EXPECT_TRUE(merged(acknowledged, said(kClear)).acknowledged);
  HeardWarning held = said(kContact);
  held.held = true;
  EXPECT_EQ(merged(held, said(kContact)).leader, kRight);
}

TEST_F(WarningMergerTest, SaysWhichGuardSaysWhat) {
  HeardWarning unknown = said(kUnknown);
  unknown.text = "UNKNOWN: no tool pose yet";
  HeardWarning contact = said(kContact);
  contact.text = "CONTACT: tool touches 'liver'";
  EXPECT_EQ(merged(unknown, contact).text,
            "CONTACT: /left: UNKNOWN: no tool pose yet; /right: CONTACT: tool touches 'liver'");
}

TEST_F(WarningMergerTest, SaysTheSmallestShareThatIsSeen) {
  HeardWarning left = said(kClear);
  HeardWarning right = said(kClear);
  EXPECT_EQ(merged(left, right).seen, std::nullopt);
  right.seen = 0.7;
  EXPECT_EQ(merged(left, right).seen, 0.7);
  left.seen = 0.2;
  EXPECT_EQ(merged(left, right).seen, 0.2);
}

TEST_F(WarningMergerTest, PromisesNoMoreThanTheGuardThatPromisesLeast) {
  HeardWarning less = said(kClear);
  less.valid_until -= milliseconds(150);
  less.covered_until -= milliseconds(150);
  less.stamp -= milliseconds(50);
  const MergedWarning both = merged(said(kClear), less);
  EXPECT_EQ(both.valid_until, less.valid_until);
  EXPECT_EQ(both.covered_until, less.covered_until);
  EXPECT_EQ(both.leader, kRight) << "its pose is older";
}

// The rules once more, from all pairs of levels and silences alone.
TEST(WarningMergerModelTest, AgreesOnRandomWarningsOfFiveGuards) {
  constexpr size_t kGuards = 5;
  std::mt19937 random(7);
  const auto below = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
  WarningMerger merger({"a", "b", "c", "d", "e"});
  std::vector<std::optional<HeardWarning>> heard(kGuards);
  int clear = 0;
  for (int step = 0; step < 100000; ++step) {
    const Duration time = milliseconds(10 * step);
    for (size_t guard = 0; guard < kGuards; ++guard) {
      if (below(8) == 0) continue;
      HeardWarning warning = said(below(6) < 5 ? kClear : static_cast<WarningLevel>(below(5)), time);
      warning.valid_until -= milliseconds(below(20) == 0 ? 250 : 0);
      warning.reasons = below(10) == 0 ? 1U << static_cast<unsigned>(below(22)) : 0;
      heard[guard] = warning;
      merger.hear(guard, warning);
    }
    int silent = 0;
    std::array<int, 5> levels{};
    for (const auto& warning : heard) {
      const bool counts = warning && time - (warning->received.steady - instantAt({}).steady) <= milliseconds(200) &&
                          warning->valid_until >= instantAt(time).stamp;
      silent += counts ? 0 : 1;
      if (counts) ++levels[static_cast<size_t>(warning->level)];
    }
    WarningLevel expected = silent + levels[0] > 0 ? kUnknown : kClear;
    for (const WarningLevel level : {kConsidered, kReflex, kContact}) {
      if (levels[static_cast<size_t>(level)] > 0) expected = level;
    }
    const MergedWarning merged = merger.merged(instantAt(time));
    ASSERT_EQ(merged.level, expected) << step;
    ASSERT_EQ(silent > 0, merged.covered_until == Time()) << step;
    ASSERT_LE(merged.valid_until, instantAt(time).stamp + kWarningValid);
    clear += expected == kClear ? 1 : 0;
  }
  EXPECT_GT(clear, 10000);
  EXPECT_LT(clear, 90000);
}

}  // namespace
}  // namespace sweep_guard_core
