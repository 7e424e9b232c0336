#include "session/session_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "refusal.h"

namespace sweep_guard_session {
namespace {

using std::chrono::milliseconds;
using sweep_guard_core::Time;

const Time kBegin(std::chrono::seconds(100));

Contact contactAt(int ms, const std::string& mesh) {
  const Time begin = kBegin + milliseconds(ms);
  return {begin, begin + milliseconds(700), mesh, "finger", {3, 4}, 0.0025, milliseconds(800), milliseconds(0)};
}

TEST(ContactTableTest, HasALineForEachContact) {
  EXPECT_EQ(contactTable({contactAt(1300, "liver")}, kBegin, 5),
            "    # begin [s] lasts [s] workpiece    link of the tool triangles depth [mm]   CONSIDERED   REFLEX\n"
            "    1      1.30      0.70 liver        finger                   2        2.5       0.80 s     none\n");
}

TEST(ContactTableTest, SaysHowManyAreLeftOut) {
  const std::vector<Contact> contacts(7, contactAt(0, "liver"));
  EXPECT_TRUE(has(contactTable(contacts, kBegin, 5), "  ... and 2 more in contacts.csv\n"));
  EXPECT_FALSE(has(contactTable(contacts, kBegin, 7), "more"));
}

TEST(ContactTableTest, ADepthThatIsNotKnownIsNoNumber) {
  Contact contact = contactAt(0, "liver");
  contact.depth = NAN;
  EXPECT_FALSE(has(contactTable({contact}, kBegin, 5), "nan"));
}

// Names come from messages: they may be long, and hold what ends a line.
TEST(ContactTableTest, AnyNameStaysInItsCell) {
  const std::string line = contactTable({contactAt(0, "a\nb" + std::string(500, 'x'))}, kBegin, 5);
  EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 2);
  EXPECT_LT(line.size(), 300U);
  const std::string umlauts =
      "\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4";
  EXPECT_TRUE(has(contactTable({contactAt(0, "l" + umlauts + umlauts)}, kBegin, 5), "l" + umlauts + "..."));
}

}  // namespace
}  // namespace sweep_guard_session
