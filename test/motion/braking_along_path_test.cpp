#include <gtest/gtest.h>

#include <cmath>

#include "motion/times.h"
#include "sweep_guard/motion/motion_guard.h"

namespace sweep_guard_core {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using std::chrono::milliseconds;

constexpr double kSimulatedStep = 1e-3;  // of the simulation [s]
constexpr double kLeastTipGap = 0.0015;  // the standoff is 2 mm
constexpr int kGoesOn = 1'000'000;       // [ms]
constexpr double kSpeedsUp = 10.0;       // at this acceleration [m/s^2]

// A tool that is one point, before planes, with commands of one velocity until it is let go.
struct Approach {
  Vector3d p_T;
  Isometry3d X_WT = Isometry3d::Identity();
  std::vector<SeparatingPlane> planes;
  Twist command_W;
  int let_go_ms = kGoesOn;
  int period_ms = 10;
  int end_ms = 3000;
};

SeparatingPlane planeAt(const Vector3d& normal_W, const Vector3d& point_W) { return {0, normal_W, point_W, 0.0, 0.0}; }

double tipGap(const SeparatingPlane& plane, const Approach& approach, const Isometry3d& X_WT) {
  return plane.normal_W.dot(X_WT * approach.p_T - plane.point_W);
}

// The robot keeps to its path when it is stopped, and its tip brakes no harder than at 1 m/s^2.
class BrakingRobot {
 public:
  explicit BrakingRobot(const Approach& approach) : X_WT_(approach.X_WT), p_T_(approach.p_T) {}

  const Isometry3d& pose() const { return X_WT_; }
  void step(const Twist& sent_W) {
    const Vector3d p_W = X_WT_.linear() * p_T_;
    const auto tip = [&](const Twist& twist_W) { return atPoint(twist_W, p_W).v_W.norm(); };
    Twist change_W{sent_W.v_W - velocity_W_.v_W, sent_W.w_W - velocity_W_.w_W};
    const double most = kSimulatedStep * (tip(sent_W) > tip(velocity_W_) ? kSpeedsUp : 1.0);
    const double share = std::min(1.0, most / std::max(1e-12, tip(change_W)));
    velocity_W_.v_W += share * change_W.v_W;
    velocity_W_.w_W += share * change_W.w_W;
    X_WT_.translation() += kSimulatedStep * velocity_W_.v_W;
    const double angle = kSimulatedStep * velocity_W_.w_W.norm();
    if (angle > 0.0) X_WT_.linear() = Eigen::AngleAxisd(angle, velocity_W_.w_W.normalized()) * X_WT_.linear();
  }

 private:
  Isometry3d X_WT_;
  Vector3d p_T_;
  Twist velocity_W_;
};

MotionInputs inputsOf(const Approach& approach, const Isometry3d& X_WT, int ms) {
  PlaneSet set{received(ms), at(ms + 150).stamp, true, 1, approach.planes, {}};
  set.X_WT = X_WT;
  for (SeparatingPlane& plane : set.planes) plane.gap = tipGap(plane, approach, X_WT);
  return {std::make_shared<const PlaneSet>(set),
          std::make_shared<const ToolBalls>(ToolBalls{1, {{{approach.p_T, 0.0}}}, {}}),
          MotionInputs::ToolPose{X_WT, received(ms)},
          MotionInputs::GuardWarning{WarningLevel::kClear, 0, at(ms).steady}};
}

// Returns the least gap that a guarded robot comes to [m].
double leastGapOf(const Approach& approach) {
  MotionGuard guard({});
  BrakingRobot robot(approach);
  Twist sent_W;
  double least = 1.0;
  for (int ms = 1000; ms < 1000 + approach.end_ms; ++ms) {
    if (ms % approach.period_ms == 0) {
      const Twist command_W = ms - 1000 < approach.let_go_ms ? approach.command_W : Twist{};
      const MotionCommand command{command_W, Vector3d::Zero(), received(ms), milliseconds(approach.period_ms), {}};
      sent_W = guard.guard(inputsOf(approach, robot.pose(), ms), command, at(ms)).twist_W;
    }
    robot.step(sent_W);
    for (const SeparatingPlane& plane : approach.planes) least = std::min(least, tipGap(plane, approach, robot.pose()));
  }
  return least;
}

TEST(BrakingAlongPathTest, ASlideThatIsLetGoEndsBeforeTheFloor) {
  for (const double speed : {0.1, 0.25, 0.5}) {
    for (const double angle : {0.2, 0.5, M_PI / 2.0}) {
      Approach approach;
      approach.p_T = Vector3d::Zero();
      approach.X_WT.translation().z() = 0.002 + 0.6 * speed * std::sin(angle);
      approach.planes = {planeAt(Vector3d::UnitZ(), Vector3d::Zero())};
      approach.command_W.v_W = speed * Vector3d(std::cos(angle), 0.0, -std::sin(angle));
      for (approach.let_go_ms = 300; approach.let_go_ms < 1200; approach.let_go_ms += 30)
        EXPECT_GT(leastGapOf(approach), kLeastTipGap) << speed << " m/s, " << angle << " rad, " << approach.let_go_ms;
    }
  }
}

TEST(BrakingAlongPathTest, ASlideAlongOneSideOfANotchEndsBeforeTheOther) {
  for (const double speed : {0.1, 0.25, 0.5}) {
    for (const double angle : {0.35, 0.8, 1.4}) {
      Approach approach;
      approach.p_T = Vector3d::Zero();
      approach.X_WT.translation().z() = 0.0021;
      approach.planes = {planeAt(Vector3d::UnitZ(), Vector3d::Zero()),
                         planeAt({-std::sin(angle), 0.0, -std::cos(angle)}, {0.5, 0.0, 0.0})};
      approach.command_W.v_W = speed * Vector3d::UnitX();
      approach.end_ms = 6000;
      EXPECT_GT(leastGapOf(approach), kLeastTipGap) << speed << " m/s, " << angle << " rad";
    }
  }
}

TEST(BrakingAlongPathTest, ATurnEndsBeforeAPlaneThatCutsTheCircleOfItsTip) {
  for (const double length : {0.2, 0.5, 0.8}) {
    for (const double turn_rate : {0.3, 1.0}) {
      for (const double cut : {0.1, 0.3}) {
        Approach approach;
        approach.p_T = length * Vector3d::UnitX();
        approach.X_WT.linear() = Eigen::AngleAxisd(-0.6 - cut, Vector3d::UnitZ()).toRotationMatrix();
        approach.planes = {planeAt(-Vector3d::UnitX(), length * std::cos(cut) * Vector3d::UnitX())};
        approach.command_W.w_W = turn_rate * Vector3d::UnitZ();
        approach.end_ms = static_cast<int>(1000.0 * (0.7 / turn_rate + 3.0));
        EXPECT_GT(leastGapOf(approach), kLeastTipGap) << length << " m, " << turn_rate << " rad/s, " << cut << " rad";
      }
    }
  }
}

TEST(BrakingAlongPathTest, ATurnThatOpensItsGapAtFirstEndsBeforeItIsBack) {
  for (const double length : {0.2, 0.5, 0.8}) {
    Approach approach;
    approach.p_T = length * Vector3d::UnitX();
    approach.X_WT.linear() = Eigen::AngleAxisd(0.05, Vector3d::UnitZ()).toRotationMatrix();
    approach.planes = {planeAt(-Vector3d::UnitX(), (length + 0.003) * Vector3d::UnitX())};
    approach.command_W = {Vector3d(0.2, 0.0, 0.0), Vector3d::UnitZ()};
    EXPECT_GT(leastGapOf(approach), kLeastTipGap) << length << " m";
  }
}

// In each period the arc of the tip would take a little of the gap that the turn is counted to open.
TEST(BrakingAlongPathTest, APushDoesNotCreepThroughAPlaneThatATurnLeadsAwayFrom) {
  for (const int period_ms : {1, 10, 20}) {
    Approach approach;
    approach.p_T = 0.5 * Vector3d::UnitX();
    approach.planes = {planeAt(Vector3d::UnitZ(), {0.0, 0.0, -0.003})};
    approach.command_W = {-0.5 * Vector3d::UnitZ(), -Vector3d::UnitY()};
    approach.period_ms = period_ms;
    approach.end_ms = 1000;
    EXPECT_GT(leastGapOf(approach), kLeastTipGap) << period_ms << " ms";
  }
}

}  // namespace
}  // namespace sweep_guard_core
