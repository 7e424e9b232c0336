#include "session/session_log.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "timeline.h"

namespace sweep_guard_session {
namespace {

using namespace sweep_guard_core::timeline;
using std::chrono::milliseconds;
using sweep_guard_core::WarningLevel;

using Triangles = std::set<std::uint32_t>;

struct ReceivedLevel {
  int ms;
  WarningLevel level;
  std::string text = {};
};

SweepContact sweepContactAt(int first, std::uint32_t triangle, double depth) {
  const int stamp = first + 4;
  return {at(first), at(stamp), "liver", "tip", {triangle}, depth};
}

SessionLog logOf(const std::vector<ReceivedLevel>& levels, const std::vector<SweepContact>& contacts, int end) {
  SessionLog log;
  for (const auto& [ms, level, text] : levels) log.add({at(ms), level, text});
  for (const SweepContact& contact : contacts) log.add(contact);
  log.end(at(end));
  return log;
}

TEST(SessionLogTest, RepeatedLevelsAreOneSegmentAndTheLastEndsWithTheSession) {
  const SessionLog log = logOf({{0, kUnknown}, {100, kClear}, {150, kClear}, {300, kConsidered}}, {}, 450);
  const std::vector<Segment> segments = log.segments();
  ASSERT_EQ(segments.size(), 3U);
  EXPECT_EQ(segments[1].begin, at(100));
  EXPECT_EQ(segments[1].end, at(300));
  EXPECT_EQ(segments[2].end, at(450));
  EXPECT_EQ(log.duration(kClear), milliseconds(200));
  EXPECT_EQ(log.duration(kReflex), milliseconds(0));
}

TEST(SessionLogTest, ASegmentHasTheTextThatLastedLongest) {
  const auto segments =
      logOf({{0, kUnknown, "no pose"}, {10, kUnknown, "no mesh"}, {40, kUnknown, "stale"}}, {}, 50).segments();
  ASSERT_EQ(segments.size(), 1U);
  EXPECT_EQ(segments[0].text, "no mesh");
}

TEST(SessionLogTest, LeadsEndAtTheFirstContactOfASweep) {
  const std::vector<Contact> contacts =
      logOf({{0, kClear}, {1000, kConsidered}, {1700, kReflex}, {1910, kContact}, {2600, kClear}},
            {sweepContactAt(1900, 7, 0.001), sweepContactAt(1910, 8, 0.003)}, 2600)
          .contacts();
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].begin, at(1900));
  EXPECT_EQ(contacts[0].end, at(2600));
  EXPECT_EQ(contacts[0].considered_lead, milliseconds(900));
  EXPECT_EQ(contacts[0].reflex_lead, milliseconds(200));
  EXPECT_EQ(contacts[0].mesh_id, "liver");
  EXPECT_EQ(contacts[0].tool_link, "tip");
  EXPECT_EQ(contacts[0].triangles, (Triangles{7, 8}));
  EXPECT_EQ(contacts[0].depth, 0.003);
}

TEST(SessionLogTest, AnInterruptedWarningCountsFromItsReturn) {
  const Contact contact = logOf({{0, kConsidered}, {500, kUnknown}, {600, kConsidered}, {1000, kContact}},
                                {sweepContactAt(1000, 1, 0.0)}, 1100)
                              .contacts()
                              .at(0);
  EXPECT_EQ(contact.considered_lead, milliseconds(400));
  EXPECT_EQ(contact.reflex_lead, milliseconds(0));
}

TEST(SessionLogTest, TheRestOfAWarningAfterAContactCountsAnew) {
  const std::vector<Contact> contacts = logOf({{0, kReflex}, {100, kContact}, {700, kReflex}, {900, kContact}},
                                              {sweepContactAt(90, 1, 0.0), sweepContactAt(890, 2, 0.0)}, 1000)
                                            .contacts();
  ASSERT_EQ(contacts.size(), 2U);
  EXPECT_EQ(contacts[1].reflex_lead, milliseconds(190));
  EXPECT_EQ(contacts[1].triangles, Triangles{2});
}

TEST(SessionLogTest, AWarningAfterTheFirstContactHasNoLead) {
  const Contact contact =
      logOf({{0, kClear}, {95, kReflex}, {100, kContact}}, {sweepContactAt(90, 1, NAN)}, 200).contacts().at(0);
  EXPECT_EQ(contact.reflex_lead, milliseconds(0));
  EXPECT_TRUE(std::isnan(contact.depth));
}

TEST(SessionLogTest, ASweepBelongsToTheContactOfItsPose) {
  const std::vector<Contact> contacts =
      logOf({{0, kContact}, {100, kReflex}, {500, kContact}},
            {sweepContactAt(0, 1, 0.001), sweepContactAt(95, 2, 0.002), sweepContactAt(490, 3, 0.003)}, 600)
          .contacts();
  ASSERT_EQ(contacts.size(), 2U);
  EXPECT_EQ(contacts[0].triangles, (Triangles{1, 2}));
  EXPECT_EQ(contacts[0].depth, 0.002);
  EXPECT_EQ(contacts[1].begin, at(490));
  EXPECT_EQ(contacts[1].reflex_lead, milliseconds(390));
  EXPECT_EQ(contacts[1].triangles, Triangles{3});
}

TEST(SessionLogTest, ASweepInWhichAContactEndedBelongsToTheNextOne) {
  const std::vector<Contact> contacts = logOf({{0, kContact}, {100, kClear}, {105, kContact}},
                                              {sweepContactAt(0, 1, 0.001), sweepContactAt(98, 2, 0.002)}, 200)
                                            .contacts();
  ASSERT_EQ(contacts.size(), 2U);
  EXPECT_EQ(contacts[0].triangles, Triangles{1});
  EXPECT_EQ(contacts[1].begin, at(98));
  EXPECT_EQ(contacts[1].mesh_id, "liver");
}

TEST(SessionLogTest, ASweepAfterTheLastContactBelongsToNone) {
  const SessionLog log =
      logOf({{0, kContact}, {100, kClear}}, {sweepContactAt(95, 1, 0.001), sweepContactAt(101, 2, 0.001)}, 200);
  EXPECT_EQ(log.contacts().at(0).triangles, Triangles{1});
}

TEST(SessionLogTest, IsEmptyWithoutMessages) {
  const SessionLog log;
  EXPECT_TRUE(log.segments().empty());
  EXPECT_TRUE(log.contacts().empty());
}

constexpr int kRate = 8000;

// Number of samples that are not 0, from one time [ms] to another.
long sounding(const std::vector<std::int16_t>& samples, int begin, int end) {
  const auto at = [&](int ms) { return samples.begin() + ms * kRate / 1000; };
  return std::count_if(at(begin), at(end), [](int sample) { return sample != 0; });
}

TEST(SessionSoundTest, LastsAsLongAsTheSessionAndSoundsAsItsLevels) {
  SessionLog log;
  log.add({at(1000), kClear, {}});
  log.add({at(1500), kContact, {}});
  log.add({at(2500), kClear, {}});
  log.end(at(4000));
  const auto samples = soundOf(log, kRate);
  EXPECT_EQ(samples.size(), 3U * kRate);
  EXPECT_EQ(sounding(samples, 100, 500), 0);
  EXPECT_EQ(sounding(samples, 510, 1500), 5940);  // a tone of 1 kHz is 0 at two of its eight samples
  EXPECT_LT(sounding(samples, 1510, 3000), 200);
}

TEST(SessionSoundTest, IsEmptyWithoutWarnings) { EXPECT_TRUE(soundOf(SessionLog(), kRate).empty()); }

}  // namespace
}  // namespace sweep_guard_session
