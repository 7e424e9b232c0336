#include "simulation/pose_scheduler.h"

#include <gtest/gtest.h>

namespace sweep_guard_simulation {
namespace {

using std::chrono::milliseconds;
using sweep_guard_core::Time;

const Time kStart(std::chrono::seconds(100));

TEST(PoseSchedulerTest, PosesAreDueAtTheirStampsFromTheStartOn) {
  const PoseScheduler scheduler(kStart, /*live=*/true);
  EXPECT_EQ(scheduler.due(Time(milliseconds(30))), kStart + milliseconds(30));
}

TEST(PoseSchedulerTest, AfterAStallAHandGoesOnFromNow) {
  PoseScheduler scheduler(kStart, /*live=*/true);
  EXPECT_TRUE(scheduler.resume(Time(milliseconds(30)), kStart + milliseconds(3030)));
  EXPECT_EQ(scheduler.due(Time(milliseconds(30))), kStart + milliseconds(3030));
  EXPECT_EQ(scheduler.due(Time(milliseconds(40))), kStart + milliseconds(3040));
  EXPECT_FALSE(scheduler.resume(Time(milliseconds(40)), kStart + milliseconds(3040)));
}

TEST(PoseSchedulerTest, AShortDelayIsMadeUpFor) {
  PoseScheduler scheduler(kStart, /*live=*/true);
  EXPECT_FALSE(scheduler.resume(Time(milliseconds(30)), kStart + milliseconds(130)));
  EXPECT_EQ(scheduler.due(Time(milliseconds(40))), kStart + milliseconds(40));
}

TEST(PoseSchedulerTest, AMotionThatIsLaidDownKeepsItsStampsWhateverTheDelay) {
  PoseScheduler scheduler(kStart, /*live=*/false);
  EXPECT_FALSE(scheduler.resume(Time(milliseconds(30)), kStart + milliseconds(3030)));
  EXPECT_EQ(scheduler.due(Time(milliseconds(40))), kStart + milliseconds(40));
}

}  // namespace
}  // namespace sweep_guard_simulation
