#include "evaluation/first_contact.h"

#include <gtest/gtest.h>

#include "evaluation/motions.h"
#include "evaluation/random.h"
#include "square_at.h"
#include "timeline.h"

namespace sweep_guard_evaluation {
namespace {

using sweep_guard_core::ConvexShape;
using sweep_guard_core::timeline::at;

// Of the tool in time: at 0.1 m/s the tolerance of 1 um is gone in 10 us.
constexpr double kTimeTolerance = 2e-5;  // [s]

class FirstContactTest : public testing::Test {
 protected:
  static SquareObstacle wall(const Eigen::Vector3d& center, const Eigen::Vector3d& normal) {
    return squareAt(center, normal, 0.1);
  }

  // Returns the time of the first contact [s]; -1: none.
  double contactTime(const std::vector<StampedPose>& poses, const SquareObstacle& obstacle) const {
    const auto time = firstContact(RecordedMotion(poses), tool_, obstacle, poses.front().stamp, poses.back().stamp);
    return time ? sweep_guard_core::toSeconds(time->time_since_epoch()) : -1.0;
  }

  const std::vector<StampedPose> straight_ = straightMotion(0.1, milliseconds(70), seconds(10));
  const SquareObstacle wall_ = wall({0.5, 0, 0}, Eigen::Vector3d::UnitX());
  ConvexShape tool_ = ConvexShape::cylinder(0.005, 0.1);
};

TEST_F(FirstContactTest, EndOnIntoAWall) { EXPECT_NEAR(contactTime(straight_, wall_), 5.0, kTimeTolerance); }

// Between two poses, whatever their distance: the tool would jump over the wall at its samples.
TEST_F(FirstContactTest, OfAToolThatIsBeyondTheWallAtTheNextPose) {
  EXPECT_NEAR(contactTime(straightMotion(0.1, seconds(10), seconds(10)), wall_), 5.0, kTimeTolerance);
}

TEST_F(FirstContactTest, SidewaysIntoAWallIsARadiusEarlier) {
  std::vector<StampedPose> poses = straight_;
  for (StampedPose& pose : poses) pose.X_WT.linear().setIdentity();
  EXPECT_NEAR(contactTime(poses, wall_), 4.95, kTimeTolerance);
}

TEST_F(FirstContactTest, WithATiltedWallIsAtTheRim) {
  const double tilt = 0.6;
  const SquareObstacle obstacle = wall({0.5, 0, 0}, {std::cos(tilt), std::sin(tilt), 0.0});
  EXPECT_NEAR(contactTime(straight_, obstacle), 5.0 - 0.005 * std::tan(tilt) / 0.1, kTimeTolerance);
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
  EXPECT_NEAR(contactTime({start, end}, edge), expected, kTimeTolerance);
}

TEST_F(FirstContactTest, IsNoneBesideTheWall) {
  EXPECT_EQ(contactTime(straight_, wall({0.5, 0.1051, 0}, Eigen::Vector3d::UnitX())), -1.0);
  EXPECT_NE(contactTime(straight_, wall({0.5, 0.1049, 0}, Eigen::Vector3d::UnitX())), -1.0);
}

TEST_F(FirstContactTest, IsLookedForFromAndToTheTimesAskedFor) {
  const auto contact = [&](int from_ms, int to_ms) {
    return firstContact(RecordedMotion(straight_), tool_, wall_, at(from_ms), at(to_ms));
  };
  EXPECT_EQ(contact(1000, 4999), std::nullopt);
  EXPECT_EQ(contact(5500, 8000), at(5500));
  EXPECT_EQ(contact(6100, 8000), std::nullopt);
}

TEST_F(FirstContactTest, IsNoneOfAToolThatRests) {
  const std::vector<StampedPose> resting = straightMotion(0.0, milliseconds(10), seconds(5));
  EXPECT_EQ(contactTime(resting, wall({2e-6, 0, 0}, Eigen::Vector3d::UnitX())), -1.0);
}

}  // namespace
}  // namespace sweep_guard_evaluation
