#include "simulation/pace.h"

#include <gtest/gtest.h>

namespace sweep_guard_simulation {
namespace {

using std::chrono::milliseconds;
using sweep_guard::Time;

const Time kStart(std::chrono::seconds(100));

TEST(PaceTest, PosesAreDueAtTheirStampsFromTheStartOn) {
  const Pace pace(kStart, /*live=*/true);
  EXPECT_EQ(pace.due(Time(milliseconds(30))), kStart + milliseconds(30));
}

TEST(PaceTest, AfterAStallAHandGoesOnFromNow) {
  Pace pace(kStart, /*live=*/true);
  EXPECT_TRUE(pace.resume(Time(milliseconds(30)), kStart + milliseconds(3030)));
  EXPECT_EQ(pace.due(Time(milliseconds(30))), kStart + milliseconds(3030));
  EXPECT_EQ(pace.due(Time(milliseconds(40))), kStart + milliseconds(3040));
  EXPECT_FALSE(pace.resume(Time(milliseconds(40)), kStart + milliseconds(3040)));
}

TEST(PaceTest, AShortDelayIsMadeUpFor) {
  Pace pace(kStart, /*live=*/true);
  EXPECT_FALSE(pace.resume(Time(milliseconds(30)), kStart + milliseconds(130)));
  EXPECT_EQ(pace.due(Time(milliseconds(40))), kStart + milliseconds(40));
}

TEST(PaceTest, AMotionThatIsLaidDownKeepsItsStampsWhateverTheDelay) {
  Pace pace(kStart, /*live=*/false);
  EXPECT_FALSE(pace.resume(Time(milliseconds(30)), kStart + milliseconds(3030)));
  EXPECT_EQ(pace.due(Time(milliseconds(40))), kStart + milliseconds(40));
}

}  // namespace
}  // namespace sweep_guard_simulation
