#include "sweep_guard/motion/motion_in_flight.h"

#include <gtest/gtest.h>

#include <deque>

#include "motion/times.h"
#include "sweep_guard/motion/velocity_limiter.h"

namespace sweep_guard_core {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using std::chrono::microseconds;
using std::chrono::milliseconds;

Twist movingAlong(double x) { return {{x, 0.0, 0.0}, Vector3d::Zero()}; }

TEST(MotionInFlightTest, AddsUpWhatWasSentWithinTheWindow) {
  MotionInFlight in_flight;
  in_flight.add(movingAlong(1.0), steadyAt(0));
  in_flight.add(movingAlong(2.0), steadyAt(10));
  in_flight.add(movingAlong(4.0), steadyAt(20));
  const auto expected = [&](int window_ms) {
    return in_flight.expectedPose(Isometry3d::Identity(), steadyAt(30), milliseconds(window_ms)).translation().x();
  };
  EXPECT_DOUBLE_EQ(expected(0), 0.0);
  EXPECT_DOUBLE_EQ(expected(10), 0.04);
  EXPECT_DOUBLE_EQ(expected(15), 0.05);
  EXPECT_DOUBLE_EQ(expected(1000), 0.07);
}

TEST(MotionInFlightTest, TurnsAboutTheOriginOfTheTool) {
  MotionInFlight in_flight;
  in_flight.add({Vector3d::Zero(), {0.0, 0.0, 1.0}}, steadyAt(0));
  Isometry3d X_WT = Isometry3d::Identity();
  X_WT.translation() = Vector3d(1.0, 2.0, 3.0);
  const Isometry3d expected = in_flight.expectedPose(X_WT, steadyAt(100), milliseconds(100));
  EXPECT_EQ(expected.translation(), X_WT.translation());
  EXPECT_TRUE(expected.linear().isApprox(Eigen::AngleAxisd(0.1, Vector3d::UnitZ()).toRotationMatrix(), 1e-12));
}

TEST(MotionInFlightTest, ForgetsTheOldest) {
  MotionInFlight in_flight;
  const int count = static_cast<int>(MotionInFlight::kCapacity) + 10;
  for (int i = 0; i < count; ++i) in_flight.add(movingAlong(1.0), steadyAt(i));
  const double moved =
      in_flight.expectedPose(Isometry3d::Identity(), steadyAt(count), milliseconds(1 << 20)).translation().x();
  EXPECT_NEAR(moved, 1e-3 * static_cast<double>(MotionInFlight::kCapacity), 1e-12);
  in_flight.clear();
  EXPECT_TRUE(in_flight.expectedPose(Isometry3d::Identity(), steadyAt(count), milliseconds(100))
                  .isApprox(Isometry3d::Identity()));
}

TEST(MotionInFlightTest, RemembersOneSecondAtAnyRate) {
  MotionInFlight in_flight;
  for (int i = 0; i < 20'000; ++i)
    in_flight.add(movingAlong(i % 2 == 0 ? 1.5 : 0.5), steadyAt(0) + i * microseconds(50));
  const Isometry3d expected = in_flight.expectedPose(Isometry3d::Identity(), steadyAt(1000), milliseconds(1000));
  EXPECT_NEAR(expected.translation().x(), 1.0, 1e-3);
}

TEST(MotionInFlightTest, VelocitiesAtTheSameMomentDoNotAddUp) {
  MotionInFlight in_flight;
  for (int i = 0; i < 5; ++i) in_flight.add(movingAlong(1.0 + i), steadyAt(0));
  const Isometry3d expected = in_flight.expectedPose(Isometry3d::Identity(), steadyAt(10), milliseconds(100));
  EXPECT_NEAR(expected.translation().x(), 0.05, 1e-12);
}

// A robot that follows commands after a dead time and with a first-order lag, before a wall at x = 0.
class DelayedRobot {
 public:
  DelayedRobot(double x, int dead_time_ms, int lag_ms)
      : x_(x), lag_ms_(lag_ms), sent_(static_cast<size_t>(dead_time_ms), 0.0) {}

  double x() const { return x_; }
  double measured(int age_ms) const {
    return age_ms < static_cast<int>(past_.size()) ? *(past_.rbegin() + age_ms) : x_;
  }
  void step(double command) {
    past_.push_back(x_);
    sent_.push_back(command);
    velocity_ += (sent_.front() - velocity_) / std::max(1, lag_ms_);
    sent_.pop_front();
    x_ += 1e-3 * velocity_;
  }

 private:
  double x_;
  int lag_ms_;
  double velocity_ = 0.0;
  std::deque<double> sent_;
  std::vector<double> past_;
};

struct Delays {
  int age_ms;  // of a pose
  int dead_time_ms;
  int lag_ms;
};

constexpr int kPeriodMs = 10;
constexpr double kStandoff = 0.002;

// Returns the smallest distance to the wall that the robot comes to when it is commanded to drive into the wall.
double nearest(double x, const Delays& delays, double deceleration, bool count_in_flight) {
  const auto& [age_ms, dead_time_ms, lag_ms] = delays;
  const BrakingLimits limits{deceleration, 1e-3 * (kPeriodMs + age_ms + dead_time_ms + lag_ms), kStandoff, 0.0};
  const Duration window = milliseconds(age_ms + dead_time_ms + (count_in_flight ? 2 * lag_ms : 0));
  const SeparatingPlane wall{0, Vector3d::UnitX(), Vector3d::Zero(), 0.0, 0.0};
  VelocityLimiter limiter(2);
  MotionInFlight in_flight;
  DelayedRobot robot(x, dead_time_ms, lag_ms);
  Twist output;
  double least = x;
  for (int ms = 0; ms < 4000; ++ms) {
    if (ms % kPeriodMs == 0) {
      Isometry3d X_WT = Isometry3d::Identity();
      X_WT.translation().x() = robot.measured(age_ms);
      std::vector<FacingBall> facing;
      addFacingBalls(wall, {{Vector3d::Zero(), 0.0}}, X_WT, facing);
      if (count_in_flight)
        addFacingBalls(wall, {{Vector3d::Zero(), 0.0}}, in_flight.expectedPose(X_WT, steadyAt(ms), window), facing);
      output = limiter.limit(movingAlong(-1.0), facing, {}, limits);
      in_flight.add(output, steadyAt(ms));
    }
    robot.step(output.v_W.x());
    least = std::min(least, robot.x());
  }
  return least;
}

constexpr Delays kDelays[] = {{20, 20, 1}, {1, 50, 1}, {50, 0, 1}, {0, 0, 50}, {20, 0, 20}, {50, 0, 50}, {30, 30, 30}};

TEST(MotionInFlightTest, ARobotWithDelaysStopsAtTheStandoffAndDoesNotOvershoot) {
  for (const Delays& delays : kDelays) {
    for (const double deceleration : {0.5, 1.0, 5.0}) {
      for (const double x : {0.003, 0.005, 0.01, 0.03, 0.1, 0.3}) {
        const double least = nearest(x, delays, deceleration, /*count_in_flight=*/true);
        EXPECT_GT(least, kStandoff - 1e-6) << x << " m, pose " << delays.age_ms << " ms, " << delays.dead_time_ms
                                           << " ms, " << delays.lag_ms << " ms, " << deceleration << " m/s^2";
        EXPECT_LT(least, kStandoff + 1e-4);
      }
    }
  }
}

TEST(MotionInFlightTest, WithoutItARobotOvershoots) {
  EXPECT_LT(nearest(0.01, {50, 0, 50}, 1.0, /*count_in_flight=*/false), 0.0);
}

}  // namespace
}  // namespace sweep_guard_core
