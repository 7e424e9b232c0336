#include "common/trail.h"

#include <gtest/gtest.h>

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

// A point is replaced until it is 20 ms from the last but one: at 1 kHz, points are 19 ms apart.
TEST(TrailTest, KeepsTwoSecondsAtAboutFiftyPointsPerSecond) {
  Trail trail;
  for (int ms = 0; ms <= 5000; ++ms) trail.add(Time(milliseconds(ms)), {0.001 * ms, 0.0, 0.0});
  EXPECT_NEAR(static_cast<double>(trail.points().size()), 2.0 / 0.019, 2.0);
  EXPECT_GE(trail.points().front().stamp, Time(milliseconds(3000)));
  EXPECT_EQ(trail.points().back().value.x(), 5.0);
}

TEST(TrailTest, StartsAnewWhenTimeGoesBack) {
  Trail trail;
  for (const int ms : {1000, 1500, 900}) trail.add(Time(milliseconds(ms)), Eigen::Vector3d::Zero());
  EXPECT_EQ(trail.points().size(), 1U);
}

}  // namespace
}  // namespace sweep_guard_core
