#include "session/contact_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "recording/gnuplot.h"
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

// Of a PNG file [pixel].
std::uint32_t heightOf(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  stream.seekg(20);
  std::uint32_t height = 0;
  for (int i = 0; i < 4; ++i) height = height << 8U | static_cast<std::uint32_t>(stream.get());
  return height;
}

TEST(ContactTableTest, HasALineForEachContact) {
  EXPECT_EQ(ContactTable({contactAt(1300, "liver")}, kBegin, 5).text(),
            "    # begin [s] lasts [s] workpiece    link of the tool triangles depth [mm]   CONSIDERED   REFLEX\n"
            "    1      1.30      0.70 liver        finger                   2        2.5       0.80 s     none\n");
}

TEST(ContactTableTest, SaysHowManyAreLeftOut) {
  const std::vector<Contact> contacts(7, contactAt(0, "liver"));
  EXPECT_TRUE(has(ContactTable(contacts, kBegin, 5).text(), "  ... and 2 more in contacts.csv\n"));
  EXPECT_FALSE(has(ContactTable(contacts, kBegin, 7).text(), "more"));
  EXPECT_TRUE(has(ContactTable(contacts, kBegin, 5).plot("", "a.png"), "'... and 2 more in contacts.csv'"));
}

TEST(ContactTableTest, ADepthThatIsNotKnownIsNoNumber) {
  Contact contact = contactAt(0, "liver");
  contact.depth = NAN;
  EXPECT_FALSE(has(ContactTable({contact}, kBegin, 5).text(), "nan"));
}

// Names come from messages: they may be long, and hold what ends a line or a text of gnuplot.
TEST(ContactTableTest, AnyNameStaysInItsCell) {
  const std::string line = ContactTable({contactAt(0, "a\nset output 'b'" + std::string(500, 'x'))}, kBegin, 5).text();
  EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 2);
  EXPECT_LT(line.size(), 300U);
  const std::string umlauts =
      "\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4";
  EXPECT_TRUE(has(ContactTable({contactAt(0, "l" + umlauts + umlauts)}, kBegin, 5).text(), "l" + umlauts + "..."));
}

TEST(ContactTableTest, IsDrawnInAPictureThatGrowsWithItsLines) {
  const std::string path = testing::TempDir() + "contact_table_test.png";
  std::uint32_t before = 0;
  for (const std::size_t count : {1U, 10U, 40U, 60U}) {
    const std::vector<Contact> contacts(count, contactAt(0, "operator's\n{liver}_\\1"));
    sweep_guard_recording::runGnuplot(ContactTable(contacts, kBegin, 40).plot("session.bag", path));
    EXPECT_GT(heightOf(path), before);
    EXPECT_LT(heightOf(path), 1500U);
    before = heightOf(path);
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace sweep_guard_session
