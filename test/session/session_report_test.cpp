#include "session/session_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "refusal.h"

namespace sweep_guard_session {
namespace {

using std::chrono::milliseconds;
using sweep_guard_core::Time;
using sweep_guard_core::WarningLevel;

const Time kBagBegin(std::chrono::seconds(100));

Time at(int ms) { return kBagBegin + milliseconds(ms); }

// The last pose is in contact, and there is a pose every 10 ms before it.
SessionBag bagOf(int poses) {
  SessionBag bag;
  for (int i = poses; i > 0; --i) bag.poses.push_back(at(1320 - 10 * i));
  bag.begin = kBagBegin;
  bag.start = kBagBegin;
  bag.end = at(2000);
  return bag;
}

SessionLog oneContact() {
  SessionLog log;
  log.add({at(0), WarningLevel::kUnknown, "UNKNOWN: no tool pose yet"});
  log.add({at(100), WarningLevel::kClear, "CLEAR"});
  log.add({at(500), WarningLevel::kConsidered, "CONSIDERED", milliseconds(900)});
  log.add({at(1200), WarningLevel::kReflex, "REFLEX", milliseconds(100)});
  log.add({at(1310), WarningLevel::kContact, "CONTACT: tool meets 'a, b'", milliseconds(0)});
  log.add({at(1300), at(1310), "a, b", "tip", {3, 4}, 0.0025});
  log.addSweep(at(1290), at(1310));
  log.end(at(2000));
  return log;
}

TEST(SessionReportTest, WritesALineForEachContact) {
  EXPECT_EQ(contactsCsv(oneContact(), kBagBegin),
            "contact,begin_s,end_s,stamp_s,mesh,tool_link,triangles,depth_mm,considered_lead_s,reflex_lead_s\n"
            "1,1.3000,2.0000,101.300000,\"a, b\",tip,2,2.5,0.8000,0.1000\n");
}

TEST(SessionReportTest, WritesALineForEachSegment) {
  EXPECT_EQ(levelsCsv(oneContact(), kBagBegin),
            "begin_s,end_s,level,text\n"
            "0.0000,0.1000,UNKNOWN,UNKNOWN: no tool pose yet\n"
            "0.1000,0.5000,CLEAR,CLEAR\n"
            "0.5000,1.2000,CONSIDERED,CONSIDERED\n"
            "1.2000,1.3100,REFLEX,REFLEX\n"
            "1.3100,2.0000,CONTACT,\"CONTACT: tool meets 'a, b'\"\n");
}

TEST(SessionReportTest, WritesTheTimeToCollisionOfEachWarning) {
  EXPECT_EQ(collisionsCsv(oneContact(), kBagBegin),
            "received_s,time_to_collision_s\n0.0000,\n0.1000,\n0.5000,0.9000\n1.2000,0.1000\n1.3100,0.0000\n");
}

TEST(SessionReportTest, SummaryNamesContactsAndPosesNotSwept) {
  SessionLog log = oneContact();
  EXPECT_TRUE(has(summary(log, bagOf(1)), "swept      1 times, without a gap\n"));
  EXPECT_TRUE(
      has(summary(log, bagOf(2)), "; 1 poses waited for the next, up to 0.020 s were swept at once, or were refused"));
  EXPECT_TRUE(has(summary(log, bagOf(1)), "ahead of 1 of 1, by 0.10 s in the median"));
  log.addSweep(at(1360), at(1370));
  EXPECT_TRUE(has(summary(log, bagOf(2)), "0.050 s between two poses NOT SWEPT"));
}

TEST(SessionReportTest, SummarySaysFromWhereOnItWasPlayedAndWhatWasMissing) {
  SessionBag bag = bagOf(1);
  EXPECT_TRUE(has(summary(oneContact(), bag), "session    2.0 s, 1 poses, "));
  bag.start = at(1500);
  bag.missing = {"no transform of 'table'", "no vertices"};
  const std::string text = summary(oneContact(), bag);
  EXPECT_TRUE(has(text, "session    2.0 s (played from 1.5 s on), 1 poses, ")) << text;
  EXPECT_TRUE(has(text, "\nmissing    no transform of 'table'\nmissing    no vertices\nswept ")) << text;
}

TEST(SessionReportTest, SummaryNamesTheConfiguration) {
  SessionBag bag = bagOf(1);
  EXPECT_FALSE(has(summary(oneContact(), bag), "config"));
  bag.config = {"/x/black_box_1.yaml"};
  bag.missing = {"no vertices"};
  EXPECT_TRUE(has(summary(oneContact(), bag), " vertices\nconfig     /x/black_box_1.yaml\nmissing    no vertices\n"));
  bag.config.emplace_back("it differs from that of /x/black_box_2.bag");
  EXPECT_TRUE(has(summary(oneContact(), bag), ".yaml\nconfig     it differs from that of /x/black_box_2.bag\n"));
}

TEST(SessionReportTest, SummaryCountsAPoseAsSweptOnlyWithinAnInterval) {
  const SessionLog log = oneContact();
  SessionBag bag = bagOf(5);
  EXPECT_TRUE(has(summary(log, bag), "1 poses waited"));
  EXPECT_TRUE(has(summary(log, bag), "\n           3 poses NOT SWEPT\n"));
  bag.poses.push_back(at(1560));
  EXPECT_TRUE(has(summary(log, bag), "\n           4 poses NOT SWEPT, including the last 0.250 s\n"));
  SessionLog blind;
  blind.add({at(0), WarningLevel::kUnknown, "UNKNOWN: no workpiece yet"});
  blind.end(at(2000));
  EXPECT_TRUE(has(summary(blind, bag), "NOTHING WAS SWEPT"));
  EXPECT_FALSE(has(summary(blind, bag), "waited"));
}

TEST(SessionReportTest, ReportsASessionOfOneInstant) {
  SessionLog instant;
  instant.add({at(0), WarningLevel::kUnknown, "UNKNOWN: no tool pose yet"});
  instant.end(at(0));
  for (const SessionLog& log : {SessionLog(), instant}) {
    EXPECT_TRUE(has(summary(log, bagOf(0)), "UNKNOWN         0.0 s   0.0 %\n"));
    EXPECT_TRUE(has(summary(log, bagOf(0)), "contacts   0\n"));
  }
}

Contact contactAt(int ms, const std::string& mesh) {
  const Time begin = kBagBegin + milliseconds(ms);
  return {begin, begin + milliseconds(700), mesh, "finger", {3, 4}, 0.0025, milliseconds(800), milliseconds(0)};
}

TEST(ContactTableTest, HasALineForEachContact) {
  EXPECT_EQ(contactTable({contactAt(1300, "liver")}, kBagBegin, 5),
            "    # begin [s] lasts [s] workpiece    link of the tool triangles depth [mm]   CONSIDERED   REFLEX\n"
            "    1      1.30      0.70 liver        finger                   2        2.5       0.80 s     none\n");
}

TEST(ContactTableTest, SaysHowManyAreLeftOut) {
  const std::vector<Contact> contacts(7, contactAt(0, "liver"));
  EXPECT_TRUE(has(contactTable(contacts, kBagBegin, 5), "  ... and 2 more in contacts.csv\n"));
  EXPECT_FALSE(has(contactTable(contacts, kBagBegin, 7), "more"));
}

TEST(ContactTableTest, ADepthThatIsNotKnownIsNoNumber) {
  Contact contact = contactAt(0, "liver");
  contact.depth = NAN;
  EXPECT_FALSE(has(contactTable({contact}, kBagBegin, 5), "nan"));
}

// Names come from messages: they may be long, and hold what ends a line.
TEST(ContactTableTest, AnyNameStaysInItsCell) {
  const std::string line = contactTable({contactAt(0, "a\nb" + std::string(500, 'x'))}, kBagBegin, 5);
  EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 2);
  EXPECT_LT(line.size(), 300U);
  const std::string umlauts =
      "\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4";
  EXPECT_TRUE(has(contactTable({contactAt(0, "l" + umlauts + umlauts)}, kBagBegin, 5), "l" + umlauts + "..."));
}

}  // namespace
}  // namespace sweep_guard_session
