#include "evaluation/alarm_statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sweep_guard_evaluation {
namespace {

using std::chrono::milliseconds;
using sweep_guard_core::Time;
using sweep_guard_core::WarningLevel;

Time at(int ms) { return Time(milliseconds(ms)); }

const AlarmRule& kReflex = alarmRules()[0];
const AlarmRule& kConsidered = alarmRules()[1];

/// From 0 to 8 s, or to a contact, with these levels from these times [ms] on, recorded every 100 ms and once after.
Episode episode(const std::vector<std::pair<int, WarningLevel>>& levels, std::optional<int> contact = std::nullopt) {
  Episode episode;
  episode.placement.begin = at(0);
  episode.placement.end = at(contact.value_or(8000));
  if (contact) episode.placement.contact = at(*contact);
  WarningLevel level = WarningLevel::kClear;
  int ms = 0;
  for (; at(ms - 100) < episode.placement.end; ms += 100) {
    for (const auto& [from, to] : levels) level = from == ms ? to : level;
    episode.levels.add(at(ms), level);
  }
  return episode;
}

TEST(AlarmStatisticsTest, LeadIsCountedFromTheAlarmThatLastsUntilContact) {
  const Episode twice = episode({{1000, WarningLevel::kConsidered},
                                 {1500, WarningLevel::kClear},
                                 {3000, WarningLevel::kConsidered},
                                 {3900, WarningLevel::kReflex}},
                                4050);
  EXPECT_EQ(leadOf(twice, kConsidered), milliseconds(1050));
  EXPECT_EQ(leadOf(twice, kReflex), milliseconds(150));
}

TEST(AlarmStatisticsTest, AnAlarmThatIsOverDoesNotWarn) {
  EXPECT_EQ(leadOf(episode({{1000, WarningLevel::kReflex}, {3000, WarningLevel::kClear}}, 4050), kConsidered),
            std::nullopt);
  EXPECT_EQ(leadOf(episode({{1000, WarningLevel::kReflex}, {3000, WarningLevel::kClear}}, 4050), kReflex),
            std::nullopt);
}

TEST(AlarmStatisticsTest, TheReflexAlarmMayComeWithTheContactAndTheConsideredOneMayNot) {
  const Episode late = episode({{4100, WarningLevel::kContact}}, 4050);
  EXPECT_EQ(leadOf(late, kReflex), milliseconds(-50));
  EXPECT_EQ(leadOf(late, kConsidered), std::nullopt);
}

TEST(AlarmStatisticsTest, AnAlarmIsJustifiedBeforeAContactOnly) {
  EXPECT_EQ(countFalseAlarms(episode({{2100, WarningLevel::kConsidered}}, 4050), kConsidered), 0U);
  EXPECT_EQ(countFalseAlarms(episode({{2000, WarningLevel::kConsidered}}, 4050), kConsidered), 1U);
  EXPECT_EQ(countFalseAlarms(episode({{3600, WarningLevel::kReflex}}, 4050), kReflex), 0U);
  EXPECT_EQ(countFalseAlarms(episode({{3500, WarningLevel::kReflex}}, 4050), kReflex), 1U);
  EXPECT_EQ(
      countFalseAlarms(episode({{3500, WarningLevel::kConsidered}, {3600, WarningLevel::kReflex}}, 4050), kReflex), 0U);
}

TEST(AlarmStatisticsTest, EveryIntervalCountsOnce) {
  const Episode blinking = episode({{1000, WarningLevel::kConsidered},
                                    {1500, WarningLevel::kClear},
                                    {2000, WarningLevel::kReflex},
                                    {2400, WarningLevel::kUnknown},
                                    {5000, WarningLevel::kConsidered},
                                    {6900, WarningLevel::kClear}});
  EXPECT_EQ(countFalseAlarms(blinking, kConsidered), 3U);
  EXPECT_EQ(countFalseAlarms(blinking, kReflex), 1U);
}

// 8 s without contact: once, and once more for each further 2 s or 0.5 s.
TEST(AlarmStatisticsTest, AnAlarmThatIsAlwaysOnCountsOnAndOn) {
  const Episode always = episode({{0, WarningLevel::kReflex}});
  EXPECT_EQ(countFalseAlarms(always, kConsidered), 1U + 4U);
  EXPECT_EQ(countFalseAlarms(always, kReflex), 1U + 16U);
}

TEST(AlarmStatisticsTest, AnAlarmThatBeginsAfterTheEpisodeIsNoneOfIt) {
  EXPECT_EQ(countFalseAlarms(episode({{8000, WarningLevel::kReflex}}), kReflex), 0U);
}

TEST(AlarmStatisticsTest, SumUpEpisodes) {
  const AlarmStatistics all = alarmStatistics(
      {episode({{3000, WarningLevel::kConsidered}}, 4000), episode({{3800, WarningLevel::kConsidered}}, 4000),
       episode({}, 4000), episode({{1000, WarningLevel::kConsidered}, {2000, WarningLevel::kClear}})},
      kConsidered);
  EXPECT_EQ(all.contacts, 3U);
  ASSERT_EQ(all.leads.size(), 2U);
  EXPECT_NEAR(all.leads[0], 0.2, 1e-12);
  EXPECT_NEAR(all.leads[1], 1.0, 1e-12);
  EXPECT_NEAR(all.warnedAhead(0.2), 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(all.warnedAhead(0.5), 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(all.falseAlarmsPerMinute(), 1.0 / (20.0 / 60.0), 1e-12);
}

TEST(AlarmStatisticsTest, AreUnknownOfNothing) {
  const AlarmStatistics none = alarmStatistics({}, kReflex);
  EXPECT_TRUE(std::isnan(none.falseAlarmsPerMinute()));
  EXPECT_TRUE(std::isnan(none.warnedAhead(0.1)));
}

}  // namespace
}  // namespace sweep_guard_evaluation
