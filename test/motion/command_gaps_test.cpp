#include "sweep_guard/motion/command_gaps.h"

#include <gtest/gtest.h>

#include <vector>

#include "motion/times.h"

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

// Returns what is said of commands that were received at these times, 1 ms after the last one [ms].
std::string rarityOf(const std::vector<int>& times, int timeout = 100) {
  CommandGaps gaps(milliseconds(timeout), "command_timeout");
  for (const int ms : times) gaps.received(received(ms));
  return gaps.rarity(at(times.back() + 1).steady);
}

TEST(CommandGapsTest, SlowCommandsAreSaidWithTheirPeriodAndTheTimeout) {
  const std::string end = ": send them more often, or raise it";
  EXPECT_EQ(rarityOf({0, 200, 400}),
            "commands come every 0.2 s, up to 0.2 s apart, but command_timeout is 0.1 s" + end);
  EXPECT_EQ(rarityOf({0, 80, 200, 280, 400}),
            "commands come every 0.1 s, up to 0.12 s apart, but command_timeout is 0.1 s" + end);
  EXPECT_EQ(rarityOf({0, 1000, 2000}, 500),
            "commands come every 1 s, up to 1 s apart, but command_timeout is 0.5 s" + end);
  EXPECT_EQ(rarityOf({0, 10, 20, 30}, 5),
            "commands come every 0.01 s, up to 0.01 s apart, but command_timeout is 0.005 s" + end);
}

TEST(CommandGapsTest, CommandsWithinTheTimeoutALostOneAndPausesOfTheOperatorAreNotSlow) {
  EXPECT_EQ(rarityOf({0}), "");
  EXPECT_EQ(rarityOf({0, 100, 200, 300}), "");
  EXPECT_EQ(rarityOf({0, 20, 40, 180, 200, 220}), "") << "one command was lost";
  EXPECT_EQ(rarityOf({0, 200, 400, 2500, 2520}), "") << "after a pause the measurement begins again";
}

TEST(CommandGapsTest, OnlyTheNewestIntervalsCount) {
  std::vector<int> times = {0, 200, 400};
  EXPECT_NE(rarityOf(times), "");
  for (size_t i = 0; i < CommandGaps::kIntervals; ++i) times.push_back(times.back() + 20);
  EXPECT_EQ(rarityOf(times), "");
}

TEST(CommandGapsTest, CommandsThatHaveStoppedAreNotSlow) {
  CommandGaps gaps(milliseconds(100), "timeout");
  for (const int ms : {0, 200, 400}) gaps.received(received(ms));
  EXPECT_NE(gaps.rarity(at(2400).steady), "");
  EXPECT_EQ(gaps.rarity(at(2401).steady), "");
}

TEST(CommandGapsTest, SaysWhyTheNewestCommandIsTooOld) {
  CommandGaps gaps(milliseconds(100), "command_timeout");
  gaps.received(received(0));
  EXPECT_EQ(gaps.tooOld(at(120)), "no command: the newest is 0.12 s old, and command_timeout is 0.1 s");
  gaps.received({at(130).stamp - milliseconds(3200), at(130).steady});
  EXPECT_EQ(
      gaps.tooOld(at(130)),
      "the stamp of the newest command is 3.2 s old, and command_timeout is 0.1 s: clocks differ, or commands wait "
      "on their way");
  for (const int ms : {330, 530}) gaps.received(received(ms));
  EXPECT_EQ(gaps.tooOld(at(635)), gaps.rarity(at(635).steady));
  EXPECT_NE(gaps.tooOld(at(635)), "");
  for (const int delay : {1, 20, 50}) {
    gaps.received({at(730 - delay).stamp, at(730).steady});
    EXPECT_EQ(gaps.tooOld(at(830)), gaps.rarity(at(830).steady)) << "too old by its stamp first, but not for its delay";
  }
  gaps.received({at(730).stamp - milliseconds(500), at(730).steady});
  EXPECT_EQ(gaps.tooOld(at(730)).find("the stamp of the newest command is 0.5 s old"), 0U);
}

}  // namespace
}  // namespace sweep_guard_core
