#include "ros/sole_publisher.h"

#include <gtest/gtest.h>

namespace sweep_guard_ros {
namespace {

using std::chrono::milliseconds;

sweep_guard_core::SteadyTime at(int ms) { return sweep_guard_core::SteadyTime(milliseconds(ms)); }

TEST(SolePublisherTest, OneNodeIsAlone) {
  SolePublisher sole(milliseconds(150));
  for (int ms = 0; ms < 1000; ms += 10) EXPECT_TRUE(sole.alone("/guard", at(ms)));
}

TEST(SolePublisherTest, OfTwoNodesNeitherIsAlone) {
  SolePublisher sole(milliseconds(150));
  EXPECT_TRUE(sole.alone("/guard", at(0)));
  EXPECT_FALSE(sole.alone("/other", at(5)));
  EXPECT_FALSE(sole.alone("/guard", at(10)));
  EXPECT_FALSE(sole.alone("/other", at(15)));
}

TEST(SolePublisherTest, ANodeThatIsSilentCountsNoMore) {
  SolePublisher sole(milliseconds(150));
  EXPECT_TRUE(sole.alone("/guard", at(0)));
  EXPECT_FALSE(sole.alone("/other", at(150)));
  EXPECT_TRUE(sole.alone("/other", at(151)));
}

}  // namespace
}  // namespace sweep_guard_ros
