#include "guard/recent_poses.h"

#include <gtest/gtest.h>

#include <future>

#include "guard/times.h"
#include "scenes.h"

namespace sweep_guard_core {
namespace {

class RecentPosesTest : public testing::Test {
 protected:
  void add(double seconds) { poses_.add(atSecond(seconds), {BodyPose{up(seconds)}}); }
  // Returns the heights around a time, which are the stamps.
  std::pair<double, double> around(double seconds) const {
    const auto found = poses_.around(atSecond(seconds), Duration::zero());
    if (!found) return {-1.0, -1.0};
    return {found->first[0].X_WB.translation().z(), found->second[0].X_WB.translation().z()};
  }

  RecentPoses poses_;
};

TEST_F(RecentPosesTest, AreThoseBeforeAndAfterATime) {
  for (const double seconds : {1.0, 1.25, 1.5}) add(seconds);
  EXPECT_EQ(around(1.3), std::pair(1.25, 1.5));
  EXPECT_EQ(around(1.25), std::pair(1.25, 1.5));
}

TEST_F(RecentPosesTest, AreTheNewestTwiceAtItsTimeAndUnknownAfterIt) {
  add(1.0);
  EXPECT_EQ(around(1.0), std::pair(1.0, 1.0));
  EXPECT_EQ(around(1.001), std::pair(-1.0, -1.0));
}

TEST_F(RecentPosesTest, AreWaitedFor) {
  add(1.0);
  auto found = std::async(std::launch::async, [&] { return poses_.around(atSecond(1.5), std::chrono::seconds(20)); });
  add(2.0);
  ASSERT_TRUE(found.get());
}

TEST_F(RecentPosesTest, NoneIsKnownBeforeTheFirst) {
  EXPECT_EQ(around(1.0), std::pair(-1.0, -1.0));
  add(1.0);
  EXPECT_EQ(around(0.5), std::pair(-1.0, -1.0));
}

TEST_F(RecentPosesTest, OlderThanASecondAreForgotten) {
  add(1.0);
  add(2.5);
  EXPECT_EQ(around(1.5), std::pair(-1.0, -1.0));
}

TEST_F(RecentPosesTest, TimeThatGoesBackBeginsAnew) {
  add(5.0);
  add(1.0);
  EXPECT_EQ(around(5.0), std::pair(-1.0, -1.0));
  EXPECT_EQ(around(1.0), std::pair(1.0, 1.0));
}

}  // namespace
}  // namespace sweep_guard_core
