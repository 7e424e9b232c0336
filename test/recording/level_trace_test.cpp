#include "recording/level_trace.h"

#include <gtest/gtest.h>

#include "timeline.h"

namespace sweep_guard_recording {
namespace {

using namespace std::chrono_literals;
using namespace sweep_guard_core::timeline;
using sweep_guard_core::Duration;
using sweep_guard_core::Time;
using sweep_guard_core::WarningLevel;

LevelTrace traceOf(std::initializer_list<std::pair<Duration, WarningLevel>> levels) {
  LevelTrace trace;
  for (const auto& [at, level] : levels) trace.add(Time(at), level);
  return trace;
}

void expectAlarm(const TimeInterval& alarm, Duration begin, Duration end) {
  EXPECT_EQ(alarm.begin, Time(begin));
  EXPECT_EQ(alarm.end, Time(end));
}

void expectLeads(const WarnedContact& contact, Duration considered, Duration reflex) {
  EXPECT_EQ(contact.contact.begin - contact.considered_since, considered);
  EXPECT_EQ(contact.contact.begin - contact.reflex_since, reflex);
}

TEST(LevelTraceTest, JoinsLevelsThatWarnWithoutABreak) {
  const LevelTrace trace = traceOf({{0ms, kClear},
                                    {10ms, kConsidered},
                                    {20ms, kReflex},
                                    {30ms, kConsidered},
                                    {40ms, kUnknown},
                                    {50ms, kContact},
                                    {60ms, kContact}});
  const auto considered = trace.alarms(kConsidered);
  ASSERT_EQ(considered.size(), 2U);
  expectAlarm(considered[0], 10ms, 40ms);
  expectAlarm(considered[1], 50ms, 60ms);
  const auto reflex = trace.alarms(kReflex);
  ASSERT_EQ(reflex.size(), 2U);
  expectAlarm(reflex[0], 20ms, 30ms);
}

TEST(LevelTraceTest, HasNoAlarmWhereNothingWarns) {
  EXPECT_TRUE(LevelTrace().alarms(kConsidered).empty());
  const LevelTrace trace = traceOf({{0ms, kUnknown}, {10ms, kClear}});
  EXPECT_TRUE(trace.alarms(kConsidered).empty());
  EXPECT_TRUE(trace.contacts().empty());
}

TEST(LevelTraceTest, LeadsCountFromWhenTheWarningRose) {
  const auto contacts = traceOf({{1s, kClear},
                                 {2s, kConsidered},
                                 {2100ms, kConsidered},
                                 {2900ms, kReflex},
                                 {3s, kContact},
                                 {3100ms, kContact}})
                            .contacts();
  ASSERT_EQ(contacts.size(), 1U);
  expectAlarm(contacts[0].contact, 3s, 3100ms);
  expectLeads(contacts[0], 1s, 100ms);
}

TEST(LevelTraceTest, LeadsAreZeroWhereNothingWarned) {
  expectLeads(traceOf({{1s, kConsidered}, {2s, kUnknown}, {3s, kContact}}).contacts().at(0), 0s, 0s);
}

TEST(LevelTraceTest, AWarningThatWasWithdrawnDoesNotCount) {
  expectLeads(traceOf({{1s, kReflex}, {2s, kConsidered}, {3s, kContact}}).contacts().at(0), 2s, 0s);
}

TEST(LevelTraceTest, WhatIsLeftOfAWarningDoesNotCountForTheNextContact) {
  const auto contacts = traceOf({{1s, kContact}, {2s, kReflex}, {3s, kContact}}).contacts();
  ASSERT_EQ(contacts.size(), 2U);
  expectLeads(contacts[1], 1s, 1s);
}

}  // namespace
}  // namespace sweep_guard_recording
