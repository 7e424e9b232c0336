#include "common/number_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <locale>
#include <string>

namespace sweep_guard_core {
namespace {

TEST(NumberTextTest, ReadsDecimalNumbers) {
  EXPECT_EQ(parseNumber<double>("-1.5e-3"), -1.5e-3);
  EXPECT_EQ(parseNumber<double>(".5"), 0.5);
  EXPECT_EQ(parseNumber<double>("-inf"), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(parseNumber<double>("nan").value()));
  EXPECT_EQ(parseNumber<long double>("1668000000.123456789"), 1668000000.123456789L);
  EXPECT_EQ(parseNumber<int>("-12"), -12);
  EXPECT_EQ(parseNumber<size_t>("18446744073709551615"), std::numeric_limits<size_t>::max());
}

TEST(NumberTextTest, RefusesWhatIsNotOnlyANumber) {
  for (const char* text : {"", " 1", "1 ", "\t1", "+1", "0x10", "1,5", "1.5m", "1.5 2", "--1", "e5", "-"}) {
    EXPECT_EQ(parseNumber<double>(text), std::nullopt) << text;
    EXPECT_EQ(parseNumber<int>(text), std::nullopt) << text;
  }
  EXPECT_EQ(parseNumber<int>("1.0"), std::nullopt);
}

TEST(NumberTextTest, RefusesWhatTheTypeCannotHold) {
  EXPECT_EQ(parseNumber<double>("1e400"), std::nullopt);
  EXPECT_EQ(parseNumber<double>("1e-400"), std::nullopt);
  EXPECT_EQ(parseNumber<double>("4e-320"), 4e-320);
  EXPECT_EQ(parseNumber<long double>("1e400"), 1e400L);
  EXPECT_EQ(parseNumber<int>("2147483648"), std::nullopt);
}

TEST(NumberTextTest, WritesTheFewestDigitsThatAreReadAsTheSameNumber) {
  EXPECT_EQ(shortestText(0.1), "0.1");
  EXPECT_EQ(shortestText(-2.0), "-2");
  for (const double number : {1.0 / 3.0, 0.1 + 0.2, 1e300 / 7.0, 4e-320, 0.0}) {
    EXPECT_EQ(parseNumber<double>(shortestText(number)), number);
  }
}

TEST(NumberTextTest, WritesANumberForPeopleWithSixDigitsAtMost) {
  EXPECT_EQ(shortText(1e227), "1e+227");
  EXPECT_EQ(shortText(0.1 + 0.2), "0.3");
  EXPECT_EQ(shortText(-12345.678), "-12345.7");
  EXPECT_EQ(shortText(3e-05), "3e-05");
  EXPECT_EQ(shortText(std::numeric_limits<double>::infinity()), "inf");
}

TEST(NumberTextTest, WritesAPointInEveryLocale) {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  const std::string text = shortestText(0.25);
  std::locale::global(before);
  EXPECT_EQ(text, "0.25");
}

}  // namespace
}  // namespace sweep_guard_core
