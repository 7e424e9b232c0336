#include "black_box/recording_trigger.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <utility>

namespace sweep_guard_core {
namespace {

using namespace std::chrono_literals;

Instant at(Duration stamp, Duration steady) { return {Time(7s + stamp), SteadyTime(100s + steady)}; }
Instant at(Duration time) { return at(time, time); }

RecordingTrigger trigger(bool on_contact, bool on_reflex) { return RecordingTrigger({5s, on_contact, on_reflex}); }

void warn(RecordingTrigger& trigger, std::initializer_list<std::pair<WarningLevel, Duration>> levels) {
  for (const auto& [level, time] : levels) trigger.warned(level, at(time));
}

TEST(RecordingTriggerTest, AContactIsDueSomeTimeAfterItsBeginAndOnce) {
  RecordingTrigger contact = trigger(true, false);
  warn(contact, {{WarningLevel::kClear, 0s}, {WarningLevel::kReflex, 1s}});
  EXPECT_FALSE(contact.waiting());
  warn(contact, {{WarningLevel::kContact, 2s}, {WarningLevel::kContact, 3s}});
  EXPECT_FALSE(contact.due(at(6999ms)));
  EXPECT_TRUE(contact.due(at(7s)));
  EXPECT_EQ(contact.take()->cause, RecordingCause::kContact);
  contact.warned(WarningLevel::kContact, at(8s));
  EXPECT_FALSE(contact.waiting());
}

TEST(RecordingTriggerTest, AnEventIsDueInASimulationThatIsFastOrStandsStillOrBeginsAnew) {
  RecordingTrigger contact = trigger(true, false);
  contact.warned(WarningLevel::kContact, at(0s));
  EXPECT_FALSE(contact.due(at(4999ms, 1s)));
  EXPECT_TRUE(contact.due(at(5s, 1s)));
  EXPECT_TRUE(contact.due(at(0s, 5s)));
  EXPECT_FALSE(contact.due(at(-7s, 4s)));
  EXPECT_TRUE(contact.due(at(-7s, 5s)));
}

// ~save may be called before any message came.
TEST(RecordingTriggerTest, AnEventWithoutAStampIsDueByTheSteadyClockAlone) {
  RecordingTrigger save = trigger(true, false);
  save.requested({Time(), at(0s).steady});
  EXPECT_FALSE(save.due(at(1000s, 4s)));
  EXPECT_TRUE(save.due(at(1000s, 5s)));
}

TEST(RecordingTriggerTest, TheNextContactIsAnotherEvent) {
  RecordingTrigger contact = trigger(true, false);
  contact.warned(WarningLevel::kContact, at(0s));
  contact.take();
  warn(contact, {{WarningLevel::kClear, 6s}, {WarningLevel::kContact, 7s}});
  EXPECT_EQ(contact.waiting()->begin.steady, at(7s).steady);
}

TEST(RecordingTriggerTest, AGuardThatBeginsInContactIsAnEvent) {
  RecordingTrigger contact = trigger(true, false);
  contact.warned(WarningLevel::kContact, at(0s));
  EXPECT_TRUE(contact.waiting());
}

TEST(RecordingTriggerTest, ReflexIsAnEventByChoiceAndNotAfterAContact) {
  RecordingTrigger reflex = trigger(false, true);
  warn(reflex, {{WarningLevel::kContact, 0s}, {WarningLevel::kReflex, 1s}});
  EXPECT_FALSE(reflex.waiting());
  warn(reflex, {{WarningLevel::kClear, 2s}, {WarningLevel::kReflex, 3s}});
  EXPECT_EQ(reflex.waiting()->cause, RecordingCause::kReflex);
}

TEST(RecordingTriggerTest, AMoreImportantEventGivesTheRecordingItsTimeAndALessImportantOneJoins) {
  RecordingTrigger both = trigger(true, true);
  warn(both, {{WarningLevel::kReflex, 0s}, {WarningLevel::kContact, 4s}});
  both.requested(at(6s));
  warn(both, {{WarningLevel::kClear, 6s}, {WarningLevel::kContact, 7s}});
  EXPECT_FALSE(both.due(at(8s)));
  EXPECT_TRUE(both.due(at(9s)));
  EXPECT_EQ(both.take()->cause, RecordingCause::kContact);
  EXPECT_FALSE(both.take());
}

}  // namespace
}  // namespace sweep_guard_core
