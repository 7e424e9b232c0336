#include "session/session_log.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sweep_guard_session {
namespace {

using std::chrono::milliseconds;
using sweep_guard_core::Time;
using sweep_guard_core::WarningLevel;

Time at(int ms) { return Time(milliseconds(ms)); }

void addWarning(SessionLog& log, int ms, WarningLevel level, const std::string& text = "") {
  log.add({at(ms), level, text});
}

SweepContact contactAt(int first, int received, std::uint32_t triangle, double depth) {
  const int stamp = first + 4;
  return {at(received), at(first), at(stamp), "liver", "tip", {triangle}, depth};
}

TEST(SessionLogTest, RepeatedLevelsAreOneSegmentAndTheLastEndsWithTheSession) {
  SessionLog log;
  addWarning(log, 0, WarningLevel::kUnknown);
  addWarning(log, 100, WarningLevel::kClear);
  addWarning(log, 150, WarningLevel::kClear);
  addWarning(log, 300, WarningLevel::kConsidered);
  log.end(at(450));
  const std::vector<Segment> segments = log.segments();
  ASSERT_EQ(segments.size(), 3U);
  EXPECT_EQ(segments[1].begin, at(100));
  EXPECT_EQ(segments[1].end, at(300));
  EXPECT_EQ(segments[2].end, at(450));
  EXPECT_EQ(log.duration(WarningLevel::kClear), milliseconds(200));
  EXPECT_EQ(log.duration(WarningLevel::kReflex), milliseconds(0));
}

TEST(SessionLogTest, ASegmentHasTheTextThatLastedLongest) {
  SessionLog log;
  addWarning(log, 0, WarningLevel::kUnknown, "no pose");
  addWarning(log, 10, WarningLevel::kUnknown, "no mesh");
  addWarning(log, 40, WarningLevel::kUnknown, "stale");
  log.end(at(50));
  ASSERT_EQ(log.segments().size(), 1U);
  EXPECT_EQ(log.segments()[0].text, "no mesh");
}

TEST(SessionLogTest, LeadsEndAtTheFirstContactOfASweep) {
  SessionLog log;
  addWarning(log, 0, WarningLevel::kClear);
  addWarning(log, 1000, WarningLevel::kConsidered);
  addWarning(log, 1700, WarningLevel::kReflex);
  addWarning(log, 1910, WarningLevel::kContact);
  log.add(contactAt(1900, 1909, 7, 0.001));
  log.add(contactAt(1910, 1919, 8, 0.003));
  addWarning(log, 2600, WarningLevel::kClear);
  const std::vector<Contact> contacts = log.contacts();
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].begin, at(1900));
  EXPECT_EQ(contacts[0].end, at(2600));
  EXPECT_EQ(contacts[0].considered_lead, milliseconds(900));
  EXPECT_EQ(contacts[0].reflex_lead, milliseconds(200));
  EXPECT_EQ(contacts[0].mesh_id, "liver");
  EXPECT_EQ(contacts[0].tool_link, "tip");
  EXPECT_EQ(contacts[0].triangles, (std::set<std::uint32_t>{7, 8}));
  EXPECT_EQ(contacts[0].depth, 0.003);
}

TEST(SessionLogTest, AnInterruptedWarningCountsFromItsReturn) {
  SessionLog log;
  addWarning(log, 0, WarningLevel::kConsidered);
  addWarning(log, 500, WarningLevel::kUnknown);
  addWarning(log, 600, WarningLevel::kConsidered);
  addWarning(log, 1000, WarningLevel::kContact);
  log.add(contactAt(1000, 1000, 1, 0.0));
  log.end(at(1100));
  EXPECT_EQ(log.contacts()[0].considered_lead, milliseconds(400));
  EXPECT_EQ(log.contacts()[0].reflex_lead, milliseconds(0));
}

TEST(SessionLogTest, TheRestOfAWarningAfterAContactCountsAnew) {
  SessionLog log;
  addWarning(log, 0, WarningLevel::kReflex);
  addWarning(log, 100, WarningLevel::kContact);
  log.add(contactAt(90, 100, 1, 0.0));
  addWarning(log, 700, WarningLevel::kReflex);
  addWarning(log, 900, WarningLevel::kContact);
  log.add(contactAt(890, 900, 2, 0.0));
  log.end(at(1000));
  const std::vector<Contact> contacts = log.contacts();
  ASSERT_EQ(contacts.size(), 2U);
  EXPECT_EQ(contacts[1].reflex_lead, milliseconds(190));
  EXPECT_EQ(contacts[1].triangles, std::set<std::uint32_t>{2});
}

TEST(SessionLogTest, AWarningAfterTheFirstContactHasNoLead) {
  SessionLog log;
  addWarning(log, 0, WarningLevel::kClear);
  addWarning(log, 95, WarningLevel::kReflex);
  addWarning(log, 100, WarningLevel::kContact);
  log.add(contactAt(90, 100, 1, NAN));
  log.end(at(200));
  EXPECT_EQ(log.contacts()[0].reflex_lead, milliseconds(0));
  EXPECT_TRUE(std::isnan(log.contacts()[0].depth));
}

// Without a hold time, the last contact of a sweep arrives after the level has fallen.
TEST(SessionLogTest, ASweepReceivedAfterItsContactBelongsToIt) {
  SessionLog log;
  addWarning(log, 0, WarningLevel::kContact);
  log.add(contactAt(0, 0, 1, 0.001));
  addWarning(log, 100, WarningLevel::kReflex);
  log.add(contactAt(95, 101, 2, 0.002));
  addWarning(log, 500, WarningLevel::kContact);
  log.add(contactAt(490, 500, 3, 0.003));
  log.end(at(600));
  const std::vector<Contact> contacts = log.contacts();
  ASSERT_EQ(contacts.size(), 2U);
  EXPECT_EQ(contacts[0].triangles, (std::set<std::uint32_t>{1, 2}));
  EXPECT_EQ(contacts[0].depth, 0.002);
  EXPECT_EQ(contacts[1].begin, at(490));
  EXPECT_EQ(contacts[1].reflex_lead, milliseconds(390));
  EXPECT_EQ(contacts[1].triangles, std::set<std::uint32_t>{3});
}

TEST(SessionLogTest, ASweepInWhichAContactEndedBelongsToTheNextOne) {
  SessionLog log;
  addWarning(log, 0, WarningLevel::kContact);
  log.add(contactAt(0, 4, 1, 0.001));
  addWarning(log, 100, WarningLevel::kClear);
  addWarning(log, 105, WarningLevel::kContact);
  log.add(contactAt(98, 105, 2, 0.002));
  log.end(at(200));
  const std::vector<Contact> contacts = log.contacts();
  ASSERT_EQ(contacts.size(), 2U);
  EXPECT_EQ(contacts[0].triangles, std::set<std::uint32_t>{1});
  EXPECT_EQ(contacts[1].begin, at(98));
  EXPECT_EQ(contacts[1].mesh_id, "liver");
}

TEST(SessionLogTest, ASweepReceivedAfterTheLastContactBelongsToIt) {
  SessionLog log;
  addWarning(log, 0, WarningLevel::kContact);
  addWarning(log, 100, WarningLevel::kClear);
  log.add(contactAt(95, 101, 1, 0.001));
  log.end(at(200));
  EXPECT_EQ(log.contacts()[0].triangles, std::set<std::uint32_t>{1});
}

TEST(SessionLogTest, IsEmptyWithoutMessages) {
  const SessionLog log;
  EXPECT_TRUE(log.segments().empty());
  EXPECT_TRUE(log.contacts().empty());
}

}  // namespace
}  // namespace sweep_guard_session
