#include "ros/connection/sole_publisher.h"

#include <gtest/gtest.h>

#include "motion/times.h"

namespace sweep_guard_ros {
namespace {

using std::chrono::milliseconds;
using sweep_guard_core::steadyAt;

TEST(SolePublisherTest, OneNodeIsAlone) {
  SolePublisher sole(milliseconds(150));
  for (int ms = 0; ms < 1000; ms += 10) EXPECT_TRUE(sole.alone("/guard", steadyAt(ms)));
}

TEST(SolePublisherTest, OfTwoNodesNeitherIsAlone) {
  SolePublisher sole(milliseconds(150));
  EXPECT_TRUE(sole.alone("/guard", steadyAt(0)));
  EXPECT_FALSE(sole.alone("/other", steadyAt(5)));
  EXPECT_FALSE(sole.alone("/guard", steadyAt(10)));
  EXPECT_FALSE(sole.alone("/other", steadyAt(15)));
}

TEST(SolePublisherTest, ANodeThatIsSilentCountsNoMore) {
  SolePublisher sole(milliseconds(150));
  EXPECT_TRUE(sole.alone("/guard", steadyAt(0)));
  EXPECT_FALSE(sole.alone("/other", steadyAt(150)));
  EXPECT_TRUE(sole.alone("/other", steadyAt(151)));
}

}  // namespace
}  // namespace sweep_guard_ros
