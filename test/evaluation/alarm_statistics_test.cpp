#include "evaluation/alarm_statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "timeline.h"

namespace sweep_guard_evaluation {
namespace {

using namespace sweep_guard_core::timeline;
using std::chrono::milliseconds;
using sweep_guard_core::WarningLevel;

const AlarmRule& kReflexRule = alarmRules()[0];
const AlarmRule& kConsideredRule = alarmRules()[1];

struct Episode {
  ObstaclePlacement placement;
  sweep_guard_recording::LevelTrace levels;
};

/// From 0 to 8 s, or to a contact, with these levels from these times [ms] on, recorded every 100 ms and once after.
Episode episode(const std::vector<std::pair<int, WarningLevel>>& levels, std::optional<int> contact = std::nullopt) {
  Episode episode;
  episode.placement.begin = at(0);
  episode.placement.end = at(contact.value_or(8000));
  if (contact) episode.placement.contact = at(*contact);
  WarningLevel level = kClear;
  int ms = 0;
  for (; at(ms - 100) < episode.placement.end; ms += 100) {
    for (const auto& [from, to] : levels) level = from == ms ? to : level;
    episode.levels.add(at(ms), level);
  }
  return episode;
}

std::optional<sweep_guard_core::Duration> leadOf(const Episode& episode, const AlarmRule& rule) {
  return leadOf(episode.placement.contact.value(), episode.levels, rule);
}

size_t countFalseAlarms(const Episode& episode, const AlarmRule& rule) {
  return countFalseAlarms(episode.placement, episode.levels, rule);
}

AlarmStatistics alarmStatistics(const std::vector<Episode>& episodes, const AlarmRule& rule) {
  std::vector<ObstaclePlacement> placements;
  std::vector<sweep_guard_recording::LevelTrace> levels;
  for (const Episode& episode : episodes) {
    placements.push_back(episode.placement);
    levels.push_back(episode.levels);
  }
  return alarmStatistics(placements, levels, rule);
}

TEST(AlarmStatisticsTest, LeadIsCountedFromTheAlarmThatLastsUntilContact) {
  const Episode twice = episode({{1000, kConsidered}, {1500, kClear}, {3000, kConsidered}, {3900, kReflex}}, 4050);
  EXPECT_EQ(leadOf(twice, kConsideredRule), milliseconds(1050));
  EXPECT_EQ(leadOf(twice, kReflexRule), milliseconds(150));
}

TEST(AlarmStatisticsTest, AnAlarmThatIsOverDoesNotWarn) {
  const Episode over = episode({{1000, kReflex}, {3000, kClear}}, 4050);
  EXPECT_EQ(leadOf(over, kConsideredRule), std::nullopt);
  EXPECT_EQ(leadOf(over, kReflexRule), std::nullopt);
}

TEST(AlarmStatisticsTest, TheReflexAlarmMayComeWithTheContactAndTheConsideredOneMayNot) {
  const Episode late = episode({{4100, kContact}}, 4050);
  EXPECT_EQ(leadOf(late, kReflexRule), milliseconds(-50));
  EXPECT_EQ(leadOf(late, kConsideredRule), std::nullopt);
}

TEST(AlarmStatisticsTest, AnAlarmIsJustifiedBeforeAContactOnly) {
  EXPECT_EQ(countFalseAlarms(episode({{2100, kConsidered}}, 4050), kConsideredRule), 0U);
  EXPECT_EQ(countFalseAlarms(episode({{2000, kConsidered}}, 4050), kConsideredRule), 1U);
  EXPECT_EQ(countFalseAlarms(episode({{3600, kReflex}}, 4050), kReflexRule), 0U);
  EXPECT_EQ(countFalseAlarms(episode({{3500, kReflex}}, 4050), kReflexRule), 1U);
  EXPECT_EQ(countFalseAlarms(episode({{3500, kConsidered}, {3600, kReflex}}, 4050), kReflexRule), 0U);
}

TEST(AlarmStatisticsTest, EveryIntervalCountsOnce) {
  const Episode blinking = episode(
      {{1000, kConsidered}, {1500, kClear}, {2000, kReflex}, {2400, kUnknown}, {5000, kConsidered}, {6900, kClear}});
  EXPECT_EQ(countFalseAlarms(blinking, kConsideredRule), 3U);
  EXPECT_EQ(countFalseAlarms(blinking, kReflexRule), 1U);
}

// 8 s without contact: once, and once more for each further 2 s or 0.5 s.
TEST(AlarmStatisticsTest, AnAlarmThatIsAlwaysOnCountsOnAndOn) {
  const Episode always = episode({{0, kReflex}});
  EXPECT_EQ(countFalseAlarms(always, kConsideredRule), 1U + 4U);
  EXPECT_EQ(countFalseAlarms(always, kReflexRule), 1U + 16U);
}

TEST(AlarmStatisticsTest, AnAlarmThatBeginsAfterTheEpisodeIsNoneOfIt) {
  EXPECT_EQ(countFalseAlarms(episode({{8000, kReflex}}), kReflexRule), 0U);
}

TEST(AlarmStatisticsTest, SumUpEpisodes) {
  const AlarmStatistics all =
      alarmStatistics({episode({{3000, kConsidered}}, 4000), episode({{3800, kConsidered}}, 4000), episode({}, 4000),
                       episode({{1000, kConsidered}, {2000, kClear}})},
                      kConsideredRule);
  EXPECT_EQ(all.contacts, 3U);
  ASSERT_EQ(all.leads.size(), 2U);
  EXPECT_NEAR(all.leads[0], 0.2, 1e-12);
  EXPECT_NEAR(all.leads[1], 1.0, 1e-12);
  EXPECT_NEAR(all.warnedAhead(0.2), 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(all.warnedAhead(0.5), 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(all.falseAlarmsPerMinute(), 1.0 / (20.0 / 60.0), 1e-12);
}

TEST(AlarmStatisticsTest, AreUnknownOfNothing) {
  const AlarmStatistics none = alarmStatistics({}, {}, kReflexRule);
  EXPECT_TRUE(std::isnan(none.falseAlarmsPerMinute()));
  EXPECT_TRUE(std::isnan(none.warnedAhead(0.1)));
}

}  // namespace
}  // namespace sweep_guard_evaluation
