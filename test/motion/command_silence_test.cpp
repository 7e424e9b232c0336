#include "sweep_guard/motion/command_period.h"

#include <gtest/gtest.h>

#include "motion/times.h"

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

TEST(CommandSilenceTest, IsSilentUntilTheFirstCommand) {
  EXPECT_TRUE(isSilent({}, milliseconds(100), steadyAt(-1)));
  EXPECT_TRUE(isSilent({}, milliseconds(100), steadyAt(1)));
  EXPECT_FALSE(isSilent(steadyAt(2), milliseconds(100), steadyAt(2)));
}

TEST(CommandSilenceTest, BeginsWhenTheNewestCommandIsOlderThanTheTimeoutAndEndsWithTheNext) {
  EXPECT_FALSE(isSilent(steadyAt(50), milliseconds(100), steadyAt(150)));
  EXPECT_TRUE(isSilent(steadyAt(50), milliseconds(100), steadyAt(151)));
  EXPECT_FALSE(isSilent(steadyAt(1000), milliseconds(100), steadyAt(1100)));
}

}  // namespace
}  // namespace sweep_guard_core
