#include "sweep_guard/common/printable.h"

#include <gtest/gtest.h>

namespace sweep_guard_core {
namespace {

TEST(PrintableTest, LeavesWordsAndUmlauts) {
  for (const std::string text : {"", "liver", "a b/c-'?'", "Säge", "\u00a0", "\u20ac", "\U0001f480", "\U0010ffff"}) {
    EXPECT_EQ(printable(text), text);
  }
}

TEST(PrintableTest, ReplacesControlCharacters) {
  EXPECT_EQ(printable("a\nb\tc\rd"), "a?b?c?d");
  EXPECT_EQ(printable("\x1b[2J"), "?[2J");
  EXPECT_EQ(printable(std::string_view("\0", 1)), "?");
  EXPECT_EQ(printable("\x1f\x20\x7e\x7f"), "? ~?");
  EXPECT_EQ(printable("\xc2\x80\xc2\x9b\xc2\x9f"), "??????");  // of two bytes each
}

TEST(PrintableTest, ReplacesBytesThatAreNoUtf8) {
  EXPECT_EQ(printable("\x80"), "?");    // continues nothing
  EXPECT_EQ(printable("a\xc3"), "a?");  // ends too early
  EXPECT_EQ(printable("\xc3z"), "?z");  // is not continued
  EXPECT_EQ(printable("\xe2\x82z"), "??z");
  EXPECT_EQ(printable("\xff\xfe"), "??");
  EXPECT_EQ(printable("\xed\xa0\x80"), "???");       // surrogate
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "????");  // beyond U+10FFFF
  EXPECT_EQ(printable("\xf5\x80\x80\x80"), "????");
}

// A line feed in more bytes than it needs is none for the check, and one for some displays.
TEST(PrintableTest, ReplacesOverlongUtf8) {
  EXPECT_EQ(printable("\xc0\x8a"), "??");
  EXPECT_EQ(printable("\xc1\xbf"), "??");
  EXPECT_EQ(printable("\xe0\x80\x8a"), "???");
  EXPECT_EQ(printable("\xe0\x9f\xbf"), "???");
  EXPECT_EQ(printable("\xf0\x80\x80\x8a"), "????");
  EXPECT_EQ(printable("\xf0\x8f\xbf\xbf"), "????");
  EXPECT_EQ(printable("\xe0\xa0\x80"), "\u0800");
  EXPECT_EQ(printable("\xf0\x90\x80\x80"), "\U00010000");
}

TEST(PrintableTest, CutsAtTheLargestLength) {
  EXPECT_EQ(printable(std::string(128, 'a')), std::string(128, 'a'));
  EXPECT_EQ(printable(std::string(129, 'a')), std::string(128, 'a') + "...");
  EXPECT_EQ(printable(std::string(1 << 20, '\n')), std::string(128, '?') + "...");
  EXPECT_EQ(printable("abc", 2), "ab...");
}

TEST(PrintableTest, CutsNoCharacterInTwo) {
  EXPECT_EQ(printable("aaa\u20ac", 5), "aaa...");
  EXPECT_EQ(printable("aaa\u20ac", 6), "aaa\u20ac");
  EXPECT_EQ(printable(std::string(127, 'a') + "\u00e4"), std::string(127, 'a') + "...");
}

TEST(PrintableTest, ANameIsShownAsItIs) {
  for (const std::string& name : {std::string("liver"), std::string("S\u00e4ge 1"), std::string(128, 'a')}) {
    EXPECT_TRUE(isName(name)) << name;
  }
  for (const std::string& text : {std::string(), std::string("a\n"), std::string("\xff"), std::string(129, 'a'),
                                  std::string(5000, 'a'), std::string("a\0", 2), std::string(127, 'a') + "\u00e4"}) {
    EXPECT_FALSE(isName(text)) << text;
  }
}

}  // namespace
}  // namespace sweep_guard_core
