#include "sweep_guard/motion/command_period.h"

#include <gtest/gtest.h>

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

constexpr SteadyTime at(int ms) { return SteadyTime(milliseconds(ms)); }

TEST(CommandSilenceTest, IsSilentUntilTheFirstCommand) {
  CommandSilence silence(milliseconds(100));
  EXPECT_TRUE(silence.silent(at(-1)));
  EXPECT_TRUE(silence.silent(at(1)));
  silence.received(at(2));
  EXPECT_FALSE(silence.silent(at(2)));
}

TEST(CommandSilenceTest, BeginsWhenTheNewestCommandIsOlderThanTheTimeoutAndEndsWithTheNext) {
  CommandSilence silence(milliseconds(100));
  silence.received(at(0));
  silence.received(at(50));
  EXPECT_FALSE(silence.silent(at(150)));
  EXPECT_TRUE(silence.silent(at(151)));
  silence.received(at(1000));
  EXPECT_FALSE(silence.silent(at(1100)));
}

}  // namespace
}  // namespace sweep_guard_core
