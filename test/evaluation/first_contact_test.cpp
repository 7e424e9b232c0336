#include "evaluation/first_contact.h"

#include <gtest/gtest.h>

#include "evaluation/motions.h"
#include "evaluation/random.h"

namespace sweep_guard_evaluation {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using sweep_guard_core::ConvexShape;
using sweep_guard_core::Duration;
using sweep_guard_core::StampedPose;
using sweep_guard_core::Time;

// Of the tool in time: at 0.1 m/s the tolerance of 1 um is gone in 10 us.
constexpr double kTimeTolerance = 2e-5;  // [s]

class FirstContactTest : public testing::Test {
 protected:
  static SquareObstacle wall(const Eigen::Vector3d& center, const Eigen::Vector3d& normal) {
    SquareObstacle obstacle;
    obstacle.half_side = 0.1;
    obstacle.X_WS.translation() = center;
    obstacle.X_WS.linear() = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal).toRotationMatrix();
    return obstacle;
  }

  std::optional<Time> contact(const std::vector<StampedPose>& poses, const SquareObstacle& obstacle) const {
    return firstContact(RecordedMotion(poses), tool_, obstacle, poses.front().stamp, poses.back().stamp);
  }

  static double inSeconds(const std::optional<Time>& time) {
    return time ? sweep_guard_core::toSeconds(time->time_since_epoch()) : -1.0;
  }

  ConvexShape tool_ = ConvexShape::cylinder(0.005, 0.1);
};

TEST_F(FirstContactTest, EndOnIntoAWall) {
  const std::vector<StampedPose> poses = straightMotion(0.1, milliseconds(70), seconds(10));
  EXPECT_NEAR(inSeconds(contact(poses, wall({0.5, 0, 0}, Eigen::Vector3d::UnitX()))), 5.0, kTimeTolerance);
}

// Between two poses, whatever their distance: the tool would jump over the wall at its samples.
TEST_F(FirstContactTest, OfAToolThatIsBeyondTheWallAtTheNextPose) {
  const std::vector<StampedPose> poses = straightMotion(0.1, seconds(10), seconds(10));
  EXPECT_NEAR(inSeconds(contact(poses, wall({0.5, 0, 0}, Eigen::Vector3d::UnitX()))), 5.0, kTimeTolerance);
}

TEST_F(FirstContactTest, SidewaysIntoAWallIsARadiusEarlier) {
  std::vector<StampedPose> poses = straightMotion(0.1, milliseconds(70), seconds(10));
  for (StampedPose& pose : poses) pose.X_WT.linear().setIdentity();
  EXPECT_NEAR(inSeconds(contact(poses, wall({0.5, 0, 0}, Eigen::Vector3d::UnitX()))), 4.95, kTimeTolerance);
}

TEST_F(FirstContactTest, WithATiltedWallIsAtTheRim) {
  const std::vector<StampedPose> poses = straightMotion(0.1, milliseconds(70), seconds(10));
  const double tilt = 0.6;
  const SquareObstacle obstacle = wall({0.5, 0, 0}, {std::cos(tilt), std::sin(tilt), 0.0});
  EXPECT_NEAR(inSeconds(contact(poses, obstacle)), 5.0 - 0.005 * std::tan(tilt) / 0.1, kTimeTolerance);
}

// A quarter of a turn about the tip in 1 s, against an edge that lies 80 mm from the tip where the axis comes after 60
// degrees: contact is where the axis is one radius away from it.
TEST_F(FirstContactTest, OfAToolThatOnlyTurns) {
  StampedPose start;
  StampedPose end;
  end.stamp = Time(seconds(1));
  end.X_WT.linear() = Eigen::AngleAxisd(0.5 * kPi, Eigen::Vector3d::UnitX()).toRotationMatrix();
  SquareObstacle edge;
  edge.half_side = 0.02;
  const double angle = kPi / 3.0;
  const double distance = 0.08;
  // After a turn by a the tool's body extends along (0, sin a, -cos a).
  edge.X_WS.translation() = distance * Eigen::Vector3d(0.0, std::sin(angle), -std::cos(angle)) +
                            0.02 * Eigen::Vector3d(0.0, std::cos(angle), std::sin(angle));
  edge.X_WS.linear().col(0) = Eigen::Vector3d::UnitX();
  edge.X_WS.linear().col(1) = Eigen::Vector3d(0.0, std::cos(angle), std::sin(angle));
  edge.X_WS.linear().col(2) = edge.X_WS.linear().col(0).cross(edge.X_WS.linear().col(1));
  const double expected = (angle - std::asin(0.005 / distance)) / (0.5 * kPi);
  EXPECT_NEAR(inSeconds(contact({start, end}, edge)), expected, kTimeTolerance);
}

TEST_F(FirstContactTest, IsNoneBesideTheWall) {
  const std::vector<StampedPose> poses = straightMotion(0.1, milliseconds(70), seconds(10));
  EXPECT_EQ(contact(poses, wall({0.5, 0.1051, 0}, Eigen::Vector3d::UnitX())), std::nullopt);
  EXPECT_NE(contact(poses, wall({0.5, 0.1049, 0}, Eigen::Vector3d::UnitX())), std::nullopt);
}

TEST_F(FirstContactTest, IsLookedForFromAndToTheTimesAskedFor) {
  const RecordedMotion motion(straightMotion(0.1, milliseconds(70), seconds(10)));
  const SquareObstacle obstacle = wall({0.5, 0, 0}, Eigen::Vector3d::UnitX());
  EXPECT_EQ(firstContact(motion, tool_, obstacle, Time(seconds(1)), Time(milliseconds(4999))), std::nullopt);
  EXPECT_EQ(firstContact(motion, tool_, obstacle, Time(milliseconds(5500)), Time(seconds(8))),
            Time(milliseconds(5500)));
  EXPECT_EQ(firstContact(motion, tool_, obstacle, Time(milliseconds(6100)), Time(seconds(8))), std::nullopt);
}

TEST_F(FirstContactTest, IsNoneOfAToolThatRests) {
  EXPECT_EQ(contact(straightMotion(0.0, milliseconds(10), seconds(5)), wall({2e-6, 0, 0}, Eigen::Vector3d::UnitX())),
            std::nullopt);
}

}  // namespace
}  // namespace sweep_guard_evaluation
