#include "sweep_guard/ros/conversions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sweep_guard/common/error.h"

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

geometry_msgs::Pose poseOf(const Eigen::Vector3d& position, const Eigen::Vector4d& xyzw) {
  geometry_msgs::Pose pose;
  pose.position.x = position.x();
  pose.position.y = position.y();
  pose.position.z = position.z();
  pose.orientation.x = xyzw.x();
  pose.orientation.y = xyzw.y();
  pose.orientation.z = xyzw.z();
  pose.orientation.w = xyzw.w();
  return pose;
}

std::string refusalOf(const geometry_msgs::Pose& pose) {
  try {
    fromMsg(pose);
  } catch (const sweep_guard_core::InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(ConversionsTest, WhatNoCameraSeesIsUnknownAndNotReflex) {
  sweep_guard_core::Warning warning;
  warning.reasons = sweep_guard_core::kNotSeen;
  warning.seen = 0.03;
  EXPECT_EQ(toMsg(warning).level, sweep_guard::Warning::UNKNOWN);
  EXPECT_TRUE(toMsg(warning).considered);
  EXPECT_FALSE(toMsg(warning).reflex);
  EXPECT_EQ(toMsg(warning).seen, 0.03);
  warning.reasons |= sweep_guard_core::kPoseStale;
  warning.seen.reset();
  EXPECT_TRUE(toMsg(warning).reflex);
  EXPECT_TRUE(std::isnan(toMsg(warning).seen));
}

TEST(ConversionsTest, AQuaternionOfAnotherLengthIsRefusedWithItsValueAndLength) {
  const std::string begin = "orientation is not a unit quaternion: the length of ";
  const Eigen::Vector3d place(1.0, 2.0, 3.0);
  EXPECT_EQ(refusalOf(poseOf(place, {0.7, 0.0, 0.0, 0.7})), "");
  EXPECT_EQ(refusalOf(poseOf(place, {0.0, 0.0, 0.0, 1.0999})), "");
  EXPECT_EQ(refusalOf(poseOf(place, {0.0, 0.0, 0.0, 0.0})), begin + "(0, 0, 0, 0) is 0");
  EXPECT_EQ(refusalOf(poseOf(place, {0.0, 0.6, 0.0, 0.6})), begin + "(0, 0.6, 0, 0.6) is 0.848528");
  EXPECT_EQ(refusalOf(poseOf(place, {0.0, 0.0, 1.25, 0.0})), begin + "(0, 0, 1.25, 0) is 1.25");
  EXPECT_EQ(refusalOf(poseOf(place, {0.0, NAN, 0.0, 1.0})), begin + "(0, nan, 0, 1) is nan");
}

TEST(ConversionsTest, APositionThatIsNoneIsRefusedWithItsValue) {
  const std::string begin = "position is NaN, infinite or beyond 1e7 m: ";
  const Eigen::Vector4d upright(0.0, 0.0, 0.0, 1.0);
  EXPECT_EQ(refusalOf(poseOf({1.0, NAN, 0.5}, upright)), begin + "(1, nan, 0.5)");
  EXPECT_EQ(refusalOf(poseOf({1.0, 2.0, -INFINITY}, upright)), begin + "(1, 2, -inf)");
  EXPECT_EQ(refusalOf(poseOf({2e7, 0.0, 0.0}, upright)), begin + "(2e+07, 0, 0)");
}

}  // namespace
}  // namespace sweep_guard_ros
