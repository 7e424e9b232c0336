#include "ros/process/log_throttle.h"

#include <gtest/gtest.h>

#include "refusal.h"

namespace sweep_guard_ros {
namespace {

using namespace std::chrono_literals;

// Stays registered until the process ends: on Debian 11, rosconsole crashes when an appender is taken away.
class LoggedLines : public ros::console::LogAppender {
 public:
  static std::vector<std::string>& ofThisTest() {
    static auto* const logged = new LoggedLines();
    return logged->lines_;
  }

 private:
  LoggedLines() { ros::console::register_appender(this); }
  void log(ros::console::Level /*level*/, const char* text, const char* /*file*/, const char* /*function*/,
           int /*line*/) override {
    lines_.emplace_back(text);
  }

  std::vector<std::string> lines_;
};

class LogThrottleTest : public testing::Test {
 protected:
  LogThrottleTest() { lines_.clear(); }

  void error(std::chrono::milliseconds at, const std::string& key, const std::string& text) {
    throttle_.error(key, text, LogThrottle::Clock::time_point(1h) + at);
  }

  std::vector<std::string>& lines_ = LoggedLines::ofThisTest();

 private:
  LogThrottle throttle_;
};

TEST_F(LogThrottleTest, LogsTheFirstErrorOfAKindAtOnce) {
  error(0ms, "liver", "first");
  error(0ms, "spleen", "second");
  EXPECT_EQ(lines_, (std::vector<std::string>{"first", "second"}));
}

TEST_F(LogThrottleTest, AFloodOfOneKindTakesFiveLinesInTenSeconds) {
  for (int ms = 0; ms <= 10000; ++ms) error(std::chrono::milliseconds(ms), "liver", "refused");
  EXPECT_EQ(lines_, (std::vector<std::string>{"refused", "refused (and 999 more)", "refused (and 1999 more)",
                                              "refused (and 3999 more)"}));
}

TEST_F(LogThrottleTest, AFloodOfFreshNamesTakesTwentyLinesInTenSeconds) {
  for (int ms = 0; ms <= 10000; ++ms) {
    const std::string name = "ghost" + std::to_string(ms % 1000);
    error(std::chrono::milliseconds(ms), name, name + " refused");
  }
  EXPECT_LE(lines_.size(), 20U);
  EXPECT_GE(lines_.size(), 5U);
  lines_.clear();
  for (int ms = 10001; ms <= 20000; ++ms) error(std::chrono::milliseconds(ms), std::to_string(ms), "refused");
  EXPECT_LE(lines_.size(), 5U);
}

TEST_F(LogThrottleTest, LogsAtOnceAgainAfterTenQuietSeconds) {
  error(0ms, "liver", "refused");
  error(1ms, "liver", "refused");
  error(10002ms, "liver", "refused again");
  EXPECT_EQ(lines_, (std::vector<std::string>{"refused", "refused again"}));
}

// The text is an argument, not a format.
TEST_F(LogThrottleTest, LogsPercentSignsAsTheyAre) {
  error(0ms, "liver", "%s%n refused");
  EXPECT_EQ(lines_, (std::vector<std::string>{"%s%n refused"}));
}

}  // namespace
}  // namespace sweep_guard_ros
