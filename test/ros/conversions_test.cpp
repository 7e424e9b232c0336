#include "sweep_guard/ros/conversions.h"

#include <gtest/gtest.h>

namespace sweep_guard_ros {
namespace {

using namespace std::chrono_literals;
using sweep_guard_core::Duration;
using sweep_guard_core::Time;

// `/clock` may stand there.
TEST(ConversionsTest, StampsAtTheEndOfRosTimeAreKeptAndLaterOnesAreTheLast) {
  const Time last = fromMsg(ros::TIME_MAX);
  EXPECT_EQ(toMsg(last), ros::TIME_MAX);
  EXPECT_EQ(toMsg(last + 200ms), ros::TIME_MAX);
  EXPECT_EQ(toMsg(Time::max()), ros::TIME_MAX);
  EXPECT_EQ(toMsg(last - 1ns), ros::Time(ros::TIME_MAX.sec, ros::TIME_MAX.nsec - 1));
}

TEST(ConversionsTest, StampsBeforeTheBeginningOfRosTimeAreZero) {
  EXPECT_EQ(toMsg(Time(-1ns)), ros::Time());
  EXPECT_EQ(toMsg(Time(1ns)), ros::Time(0, 1));
}

TEST(ConversionsTest, DurationsBeyondThoseOfRosAreTheLongest) {
  EXPECT_EQ(toMsg(Duration(-1500ms)), ros::Duration(-1.5));
  EXPECT_GT(toMsg(Duration::max()).toSec(), 2e9);
  EXPECT_LT(toMsg(Duration::min()).toSec(), -2e9);
}

// The interval of a workpiece may be shorter than the message's, for example after a failure of another workpiece.
TEST(ConversionsTest, TimesOfImpactAreFractionsOfTheMessagesInterval) {
  const sweep_guard_core::Tool tool(sweep_guard_core::ConvexShape::cylinder(0.005, 0.1));
  const sweep_guard_core::TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const sweep_guard_core::Impact halfway{0.5, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), 0.0};
  sweep_guard_core::SweptObject early;
  early.workpiece =
      std::make_shared<sweep_guard_core::Workpiece>(sweep_guard_core::Workpiece{"sheet", 1, {}, {}, "world", mesh});
  early.interval_start = Time(1s);
  early.result.fine = true;
  early.result.triangles = early.result.not_ruled_out = {0};
  early.result.in_contact = {{0, 0, halfway}};
  sweep_guard_core::SweptObject late = early;
  late.interval_start = Time(4s);
  sweep_guard_core::SweepReport report;
  report.start = Time(1s);
  report.end = Time(5s);
  report.objects = {early, late};
  const sweep_guard::Contacts contacts = toMsg(report, tool);
  ASSERT_EQ(contacts.objects.size(), 2U);
  EXPECT_EQ(contacts.objects[0].impacts.at(0).time_of_impact, 0.5);    // at 3 s
  EXPECT_EQ(contacts.objects[1].impacts.at(0).time_of_impact, 0.875);  // at 4.5 s
}

}  // namespace
}  // namespace sweep_guard_ros
