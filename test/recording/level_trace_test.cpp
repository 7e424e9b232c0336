#include "recording/level_trace.h"

#include <gtest/gtest.h>

namespace sweep_guard_recording {
namespace {

using namespace std::chrono_literals;
using sweep_guard_core::Duration;
using sweep_guard_core::Time;
using sweep_guard_core::WarningLevel;

LevelTrace traceOf(std::initializer_list<std::pair<Duration, WarningLevel>> levels) {
  LevelTrace trace;
  for (const auto& [at, level] : levels) trace.add(Time(at), level);
  return trace;
}

void expectAlarm(const Alarm& alarm, Duration begin, Duration end) {
  EXPECT_EQ(alarm.begin, Time(begin));
  EXPECT_EQ(alarm.end, Time(end));
}

void expectLeads(const WarnedContact& contact, Duration considered, Duration reflex) {
  EXPECT_EQ(contact.contact.begin - contact.considered_since, considered);
  EXPECT_EQ(contact.contact.begin - contact.reflex_since, reflex);
}

TEST(LevelTraceTest, JoinsLevelsThatWarnWithoutABreak) {
  const LevelTrace trace = traceOf({{0ms, WarningLevel::kClear},
                                    {10ms, WarningLevel::kConsidered},
                                    {20ms, WarningLevel::kReflex},
                                    {30ms, WarningLevel::kConsidered},
                                    {40ms, WarningLevel::kUnknown},
                                    {50ms, WarningLevel::kContact},
                                    {60ms, WarningLevel::kContact}});
  const auto considered = trace.alarms(WarningLevel::kConsidered);
  ASSERT_EQ(considered.size(), 2U);
  expectAlarm(considered[0], 10ms, 40ms);
  expectAlarm(considered[1], 50ms, 60ms);
  const auto reflex = trace.alarms(WarningLevel::kReflex);
  ASSERT_EQ(reflex.size(), 2U);
  expectAlarm(reflex[0], 20ms, 30ms);
}

TEST(LevelTraceTest, HasNoAlarmWhereNothingWarns) {
  EXPECT_TRUE(LevelTrace().alarms(WarningLevel::kConsidered).empty());
  const LevelTrace trace = traceOf({{0ms, WarningLevel::kUnknown}, {10ms, WarningLevel::kClear}});
  EXPECT_TRUE(trace.alarms(WarningLevel::kConsidered).empty());
  EXPECT_TRUE(trace.contacts().empty());
}

TEST(LevelTraceTest, LeadsCountFromWhenTheWarningRose) {
  const auto contacts = traceOf({{1s, WarningLevel::kClear},
                                 {2s, WarningLevel::kConsidered},
                                 {2100ms, WarningLevel::kConsidered},
                                 {2900ms, WarningLevel::kReflex},
                                 {3s, WarningLevel::kContact},
                                 {3100ms, WarningLevel::kContact}})
                            .contacts();
  ASSERT_EQ(contacts.size(), 1U);
  expectAlarm(contacts[0].contact, 3s, 3100ms);
  expectLeads(contacts[0], 1s, 100ms);
}

TEST(LevelTraceTest, LeadsAreZeroWhereNothingWarned) {
  expectLeads(traceOf({{1s, WarningLevel::kConsidered}, {2s, WarningLevel::kUnknown}, {3s, WarningLevel::kContact}})
                  .contacts()
                  .at(0),
              0s, 0s);
}

TEST(LevelTraceTest, AWarningThatWasWithdrawnDoesNotCount) {
  expectLeads(traceOf({{1s, WarningLevel::kReflex}, {2s, WarningLevel::kConsidered}, {3s, WarningLevel::kContact}})
                  .contacts()
                  .at(0),
              2s, 0s);
}

TEST(LevelTraceTest, WhatIsLeftOfAWarningDoesNotCountForTheNextContact) {
  const auto contacts =
      traceOf({{1s, WarningLevel::kContact}, {2s, WarningLevel::kReflex}, {3s, WarningLevel::kContact}}).contacts();
  ASSERT_EQ(contacts.size(), 2U);
  expectLeads(contacts[1], 1s, 1s);
}

}  // namespace
}  // namespace sweep_guard_recording
