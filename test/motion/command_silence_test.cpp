#include "sweep_guard/motion/command_period.h"

#include <gtest/gtest.h>

#include "motion/times.h"

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

TEST(CommandSilenceTest, IsSilentUntilTheFirstCommand) {
  CommandSilence silence(milliseconds(100));
  EXPECT_TRUE(silence.silent(steadyAt(-1)));
  EXPECT_TRUE(silence.silent(steadyAt(1)));
  silence.received(steadyAt(2));
  EXPECT_FALSE(silence.silent(steadyAt(2)));
}

TEST(CommandSilenceTest, BeginsWhenTheNewestCommandIsOlderThanTheTimeoutAndEndsWithTheNext) {
  CommandSilence silence(milliseconds(100));
  silence.received(steadyAt(0));
  silence.received(steadyAt(50));
  EXPECT_FALSE(silence.silent(steadyAt(150)));
  EXPECT_TRUE(silence.silent(steadyAt(151)));
  silence.received(steadyAt(1000));
  EXPECT_FALSE(silence.silent(steadyAt(1100)));
}

}  // namespace
}  // namespace sweep_guard_core
