// Commanded poses, their follower and the motion guard before a simulated robot that is stopped and released.
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "motion/times.h"
#include "scenes.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/motion/motion_guard.h"
#include "sweep_guard/motion/pose_follower.h"

namespace sweep_guard_core {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using std::chrono::milliseconds;

constexpr double kMaxPoseSpeed = 0.25;
constexpr double kMaxPoseTurnRate = 1.0;

struct RobotDelays {
  int dead_time_ms = 20;
  int lag_ms = 30;
  int period_ms = 10;
  int age_ms = 10;  // of a pose
};

std::string describe(const RobotDelays& delays) {
  return "dead time " + std::to_string(delays.dead_time_ms) + ", lag " + std::to_string(delays.lag_ms) + ", period " +
         std::to_string(delays.period_ms) + ", age " + std::to_string(delays.age_ms) + " ms";
}

constexpr RobotDelays kDefaultLags[] = {
    {20, 30, 2, 1}, {20, 30, 5, 30}, {20, 30, 10, 10}, {20, 30, 20, 0}, {20, 30, 20, 50}};
constexpr RobotDelays kOtherLags[] = {
    {0, 50, 10, 10}, {100, 30, 10, 20}, {50, 200, 8, 5}, {0, 10, 1, 1}, {200, 100, 20, 40}};

Isometry3d placedAndTurned(double x, double turn = 0.0) {
  return along(x) * Eigen::AngleAxisd(turn, Vector3d::UnitZ());
}
double turnOf(const Isometry3d& X_WT) { return std::atan2(X_WT.linear()(1, 0), X_WT.linear()(0, 0)); }

// Follows poses along x and about z after a dead time and with a first-order lag, and stands while its brakes are closed.
class StoppedRobot {
 public:
  explicit StoppedRobot(const RobotDelays& delays)
      : delays_(delays), on_their_way_(static_cast<size_t>(delays.dead_time_ms), Isometry3d::Identity()) {}

  void stand(bool stands) { stands_ = stands; }
  void push(double x) { x_ += x; }
  double x() const { return x_; }
  double turn() const { return turn_; }
  double speed() const { return speed_; }         // [m/s]
  double turnRate() const { return turn_rate_; }  // [rad/s]
  Isometry3d measured() const {
    const auto age = static_cast<size_t>(delays_.age_ms);
    return age < past_.size() ? *(past_.rbegin() + delays_.age_ms) : Isometry3d::Identity();
  }

  void step(const Isometry3d& sent_WT) {
    past_.push_back(placedAndTurned(x_, turn_));
    on_their_way_.push_back(sent_WT);
    const double share = stands_ ? 0.0 : 1.0 - std::exp(-1.0 / delays_.lag_ms);
    const double way = share * (on_their_way_.front().translation().x() - x_);
    const double turned = share * (turnOf(on_their_way_.front()) - turn_);
    on_their_way_.pop_front();
    x_ += way;
    turn_ += turned;
    speed_ = std::abs(way) / 1e-3;
    turn_rate_ = std::abs(turned) / 1e-3;
  }

 private:
  const RobotDelays delays_;
  std::deque<Isometry3d> on_their_way_;
  std::vector<Isometry3d> past_;
  bool stands_ = false;
  double x_ = 0.0;
  double turn_ = 0.0;
  double speed_ = 0.0;
  double turn_rate_ = 0.0;
};

// Sends what is let through of a commanded pose to the robot. The tool is a point.
class PoseSession {
 public:
  explicit PoseSession(const RobotDelays& delays, bool incremental = false, double deceleration = 1.0)
      : delays_(delays),
        robot_(delays),
        follower_(followerOf(delays, incremental, deceleration)),
        guard_(guardOf(delays, deceleration)) {}

  // The robot comes from -x. Empty: no wall.
  void wall(std::optional<double> x) { wall_ = x; }
  void level(WarningLevel level) { level_ = level; }
  StoppedRobot& robot() { return robot_; }
  const Isometry3d& sent() const { return sent_WT_; }
  bool follows() const { return follower_.follows(); }
  double lead() const { return (sent_WT_.translation() - robot_.measured().translation()).norm(); }

  // Runs for some time. `each` is called after every pose that was sent.
  void run(
      int ms, const std::function<Isometry3d(int ms)>& command, const std::function<void()>& each = [] {}) {
    for (const int end = now_ms_ + ms; now_ms_ < end; ++now_ms_) {
      if (now_ms_ % delays_.period_ms == 0) {
        send(command(now_ms_));
        each();
      }
      robot_.step(sent_WT_);
      fastest_ = std::max(fastest_, robot_.speed());
      fastest_turn_ = std::max(fastest_turn_, robot_.turnRate());
      farthest_ = std::max(farthest_, robot_.x());
    }
  }
  void rest(int ms) {
    run(ms, [](int /*ms*/) { return Isometry3d::Identity(); });
  }
  void forgetSpeed() { fastest_ = fastest_turn_ = 0.0; }
  double fastest() const { return fastest_; }           // since the start, or since it was forgotten [m/s]
  double fastestTurn() const { return fastest_turn_; }  // [rad/s]
  double farthest() const { return farthest_; }         // [m]

  // What a tool that follows is behind at the largest speed [s].
  double wholeReach() const {
    return 1e-3 * (delays_.dead_time_ms + delays_.lag_ms + delays_.period_ms + delays_.age_ms);
  }
  double shortReach() const { return 1e-3 * std::max(10, delays_.lag_ms); }
  // Until a tool that stands is found not to follow.
  int untilFound() const {
    return delays_.dead_time_ms + 2 * std::max(10, delays_.lag_ms) + 2 * delays_.period_ms + 2 * delays_.age_ms + 50;
  }

 private:
  static PoseFollower followerOf(const RobotDelays& delays, bool incremental, double deceleration) {
    PoseLeash::Options options{kMaxPoseSpeed, kMaxPoseTurnRate, {}, {}, deceleration};
    options.dead_time = milliseconds(delays.dead_time_ms);
    options.time_constant = milliseconds(delays.lag_ms);
    return PoseFollower(options, incremental);
  }
  static MotionGuard guardOf(const RobotDelays& delays, double deceleration) {
    MotionGuardOptions options;
    options.deceleration = deceleration;
    options.dead_time = milliseconds(delays.dead_time_ms);
    options.time_constant = milliseconds(delays.lag_ms);
    return MotionGuard(options);
  }

  MotionInputs inputs() const {
    PlaneSet planes{received(now_ms_ - delays_.age_ms), at(now_ms_ + 150).stamp, true, 1, {}, {}};
    planes.X_WT = robot_.measured();
    if (wall_) planes.planes.push_back({0, -Vector3d::UnitX(), Vector3d(*wall_, 0.0, 0.0), 0.0, 0.0});
    return {std::make_shared<const PlaneSet>(planes), tool_,
            MotionInputs::ToolPose{robot_.measured(), received(now_ms_ - delays_.age_ms)},
            MotionInputs::GuardWarning{level_, 0, at(now_ms_).steady}};
  }

  // As motion_guard does.
  void send(const Isometry3d& command_WT) {
    const MotionInputs known = inputs();
    const Isometry3d& X_WT = known.pose->X_WT;
    if (!follower_.begun()) follower_.begin(X_WT);
    const Duration period = milliseconds(delays_.period_ms);
    follower_.observe({X_WT, milliseconds(delays_.age_ms), period, at(now_ms_).steady});
    if (passesASurface(*known.planes, *known.tool, X_WT, follower_.sent())) follower_.takeBack();
    MotionCommand command{follower_.towards(command_WT, period), Vector3d::Zero(), received(now_ms_), period, {}};
    command.rest_WT = follower_.sent();
    const GuardedMotion motion = guard_.guard(known, command, at(now_ms_));
    const bool stops = motion.decision.permission == Permission::kStop;
    sent_WT_ = stops ? follower_.hold(/*tool_is_known=*/true) : follower_.moveOn(motion.twist_W);
  }

  const RobotDelays delays_;
  StoppedRobot robot_;
  PoseFollower follower_;
  MotionGuard guard_;
  const std::shared_ptr<const ToolBalls> tool_ =
      std::make_shared<const ToolBalls>(ToolBalls{1, {{{Vector3d::Zero(), 0.0}}}});
  std::optional<double> wall_;
  WarningLevel level_ = WarningLevel::kClear;
  Isometry3d sent_WT_ = Isometry3d::Identity();
  int now_ms_ = 0;
  double fastest_ = 0.0;
  double fastest_turn_ = 0.0;
  double farthest_ = 0.0;
};

Isometry3d toFarAway(int /*ms*/) { return placedAndTurned(0.4, 1.5); }
// A hand that moves and turns without end, at twice what is let through.
Isometry3d handAt(int ms) { return placedAndTurned(5e-4 * ms, 2e-3 * ms); }

std::vector<RobotDelays> allDelays() {
  std::vector<RobotDelays> all(std::begin(kDefaultLags), std::end(kDefaultLags));
  all.insert(all.end(), std::begin(kOtherLags), std::end(kOtherLags));
  return all;
}

// What the steps of the poses alone make of the largest speed: they are followed with a lag.
double ofStepsAlone(const RobotDelays& delays) {
  const double q = static_cast<double>(delays.period_ms) / delays.lag_ms;
  return std::max(1.0, q / (1.0 - std::exp(-q)));
}

TEST(PoseReleaseTest, ThePoseSentLeadsAToolThatFollowsByNoMoreThanItsLagAndCostsItNoSpeed) {
  for (const RobotDelays& delays : allDelays()) {
    PoseSession session(delays);
    session.rest(200);
    double most = 0.0;
    bool followed = true;
    session.run(1000, toFarAway, [&] {
      most = std::max(most, session.lead());
      followed = followed && session.follows();
    });
    EXPECT_LE(most, kMaxPoseSpeed * session.wholeReach() + 1e-9) << describe(delays);
    EXPECT_TRUE(followed) << describe(delays);
    EXPECT_GT(session.robot().x(), kMaxPoseSpeed * (1.0 - session.wholeReach()) - 0.02) << describe(delays);
    session.run(2000, toFarAway);
    EXPECT_NEAR(session.robot().x(), 0.4, 1e-3) << describe(delays);
    EXPECT_NEAR(session.robot().turn(), 1.5, 1e-2) << describe(delays);
  }
}

TEST(PoseReleaseTest, ThePoseSentWaitsForAToolThatStands) {
  for (const bool incremental : {false, true}) {
    for (const RobotDelays& delays : allDelays()) {
      PoseSession session(delays, incremental);
      session.rest(200);
      session.robot().stand(true);
      session.run(session.untilFound(), handAt,
                  [&] { EXPECT_LE(session.lead(), kMaxPoseSpeed * session.wholeReach() + 1e-9) << describe(delays); });
      EXPECT_FALSE(session.follows()) << describe(delays);
      session.run(2000, handAt,
                  [&] { EXPECT_LE(session.lead(), kMaxPoseSpeed * session.shortReach() + 1e-9) << describe(delays); });
      EXPECT_LE(turnOf(session.sent()), kMaxPoseTurnRate * session.shortReach() + 1e-9);
      EXPECT_FALSE(session.follows()) << describe(delays);
    }
  }
}

// On its way, so that it lags when it is stopped.
void standOnTheWay(PoseSession& session, const std::function<Isometry3d(int)>& command, int ms) {
  session.rest(200);
  session.run(600, command);
  session.robot().stand(true);
  session.run(ms, command);
  session.robot().stand(false);
  session.forgetSpeed();
}

TEST(PoseReleaseTest, AToolThatIsReleasedIsNotFasterThanOneThatFollows) {
  for (const bool incremental : {false, true}) {
    for (const RobotDelays& delays : allDelays()) {
      for (const int stood_ms : {300, 1000, 1003, 5000}) {
        PoseSession session(delays, incremental);
        standOnTheWay(session, handAt, session.untilFound() + stood_ms);
        session.run(1500, handAt);
        EXPECT_LE(session.fastest(), kMaxPoseSpeed * ofStepsAlone(delays) * 1.02) << describe(delays);
        EXPECT_LE(session.fastestTurn(), kMaxPoseTurnRate * ofStepsAlone(delays) * 1.02) << describe(delays);
        EXPECT_GT(session.fastest(), 0.9 * kMaxPoseSpeed) << describe(delays);
        EXPECT_TRUE(session.follows()) << describe(delays);
      }
    }
  }
}

TEST(PoseReleaseTest, IsNotFasterThanOneAndAHalfTimesTheLargestSpeedWithTheDefaults) {
  for (const RobotDelays& delays : kDefaultLags) {
    PoseSession session(delays);
    standOnTheWay(session, toFarAway, 2000);
    session.run(1500, toFarAway);
    EXPECT_LE(session.fastest(), 1.5 * kMaxPoseSpeed) << describe(delays);
    EXPECT_LE(session.fastestTurn(), 1.5 * kMaxPoseTurnRate) << describe(delays);
  }
}

TEST(PoseReleaseTest, AToolThatIsReleasedGoesOnToTheCommandedPose) {
  for (const RobotDelays& delays : allDelays()) {
    PoseSession session(delays);
    standOnTheWay(session, toFarAway, 2000);
    session.run(8000, toFarAway);
    EXPECT_NEAR(session.robot().x(), 0.4, 1e-3) << describe(delays);
    EXPECT_NEAR(session.robot().turn(), 1.5, 1e-2) << describe(delays);
  }
}

// Also one that is nearer than the pose sent.
TEST(PoseReleaseTest, NothingPassesAWallThatCameWhileTheToolStood) {
  for (const bool incremental : {false, true}) {
    for (const RobotDelays& delays : allDelays()) {
      for (const double gap : {0.0005, 0.003, 0.006, 0.02, 0.1}) {
        PoseSession session(delays, incremental);
        standOnTheWay(session, handAt, 1000);
        session.robot().stand(true);
        const double wall = session.robot().x() + gap;
        session.wall(wall);
        session.run(200, handAt);
        EXPECT_LT(session.sent().translation().x(), wall) << describe(delays);
        session.robot().stand(false);
        session.run(2000, handAt);
        EXPECT_LT(session.farthest(), wall - 1e-4) << describe(delays) << ", " << gap << " m";
      }
    }
  }
}

// Its brakes slip: it moves, though not where it should.
TEST(PoseReleaseTest, ThePoseSentGoesBackWithAToolThatIsPushedBack) {
  PoseSession session({20, 30, 10, 10});
  session.rest(200);
  session.run(400, toFarAway);
  session.robot().stand(true);
  for (int i = 0; i < 50; ++i) {
    session.robot().push(-0.001);
    session.run(10, toFarAway, [&] { EXPECT_LE(session.lead(), kMaxPoseSpeed * session.wholeReach() + 1e-9); });
  }
}

TEST(PoseReleaseTest, AtAStopThePoseIsDecidedOnceAndNotBeyondThePoseSentLast) {
  for (const RobotDelays& delays : allDelays()) {
    for (const double deceleration : {0.5, 5.0, 50.0}) {
      PoseSession session(delays, /*incremental=*/false, deceleration);
      session.rest(200);
      session.run(600, toFarAway);
      const double last = session.sent().translation().x();
      session.level(WarningLevel::kUnknown);
      std::vector<double> held;
      session.run(1500, toFarAway, [&] { held.push_back(session.sent().translation().x()); });
      EXPECT_LE(held.front(), last + 1e-12) << describe(delays);
      for (const double x : held) EXPECT_EQ(x, held.front()) << describe(delays);
      const double braking = 0.5 * kMaxPoseSpeed * kMaxPoseSpeed / deceleration;
      const double measured = last - kMaxPoseSpeed * session.wholeReach();
      EXPECT_GE(held.front(), std::min(last, measured + 0.5 * braking) - 1e-3) << describe(delays);
      EXPECT_NEAR(session.robot().x(), held.front(), 1e-3) << describe(delays);
      EXPECT_LE(session.farthest(), last + 1e-12) << describe(delays);
    }
  }
}

TEST(PoseReleaseTest, AFastBrakeIsHeldBeforeThePoseSentLast) {
  PoseSession session({20, 100, 10, 10}, /*incremental=*/false, 50.0);
  session.rest(200);
  session.run(600, toFarAway);
  const double last = session.sent().translation().x();
  session.level(WarningLevel::kUnknown);
  session.run(10, toFarAway);
  EXPECT_LT(session.sent().translation().x(), last - 0.01);
}

// While the guard does not know, a robot that is released goes nowhere.
TEST(PoseReleaseTest, AToolThatStoodIsHeldWhereItStands) {
  for (const bool incremental : {false, true}) {
    for (const RobotDelays& delays : allDelays()) {
      PoseSession session(delays, incremental);
      session.rest(200);
      session.run(600, handAt);
      session.robot().stand(true);
      session.run(1000, handAt);
      const double stood = session.robot().x();
      session.level(WarningLevel::kUnknown);
      session.run(500, handAt);
      session.robot().stand(false);
      session.run(1000, handAt);
      EXPECT_NEAR(session.robot().x(), stood, 1e-9) << describe(delays);
      session.level(WarningLevel::kClear);
      session.forgetSpeed();
      session.run(1000, handAt);
      EXPECT_LE(session.fastest(), kMaxPoseSpeed * ofStepsAlone(delays) * 1.02) << describe(delays);
      EXPECT_GT(session.robot().x(), stood + 0.05) << describe(delays);
    }
  }
}

TEST(PoseReleaseTest, WithoutAFreshPoseTheOneSentLastIsHeldUntilThereIsOne) {
  PoseFollower follower({kMaxPoseSpeed, kMaxPoseTurnRate, milliseconds(20), milliseconds(30), 50.0},
                        /*incremental=*/false);
  follower.begin(Isometry3d::Identity());
  follower.observe({Isometry3d::Identity(), milliseconds(10), milliseconds(10), at(0).steady});
  const double sent = follower.moveOn(follower.towards(placedAndTurned(0.4), milliseconds(10))).translation().x();
  ASSERT_GT(sent, 0.0);
  EXPECT_EQ(follower.hold(/*tool_is_known=*/false).translation().x(), sent);
  EXPECT_EQ(follower.hold(/*tool_is_known=*/true).translation().x(), 0.0);
}

TEST(PoseLeashTest, RefusesOptionsThatAreOutOfRange) {
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    EXPECT_THROW(PoseLeash({bad, 1.0, {}, {}, 1.0}), InvalidInput);
    EXPECT_THROW(PoseLeash({1.0, bad, {}, {}, 1.0}), InvalidInput);
    EXPECT_THROW(PoseLeash({1.0, 1.0, {}, {}, bad}), InvalidInput);
  }
  EXPECT_THROW(PoseLeash({1.0, 1.0, milliseconds(-1), {}, 1.0}), InvalidInput);
  EXPECT_THROW(PoseLeash({1.0, 1.0, {}, milliseconds(-1), 1.0}), InvalidInput);
}

TEST(PassesASurfaceTest, OnlyWhatLiesBetweenTheTwoPoses) {
  PlaneSet planes{received(0), at(150).stamp, true, 1, {}, {}};
  planes.planes.push_back({0, -Vector3d::UnitX(), Vector3d(0.1, 0.0, 0.0), 0.0, 0.0});
  const ToolBalls tool{1, {{{Vector3d::Zero(), 0.01}, {Vector3d(0.0, 0.05, 0.0), 0.01}}}};
  EXPECT_FALSE(passesASurface(planes, tool, placedAndTurned(0.0), placedAndTurned(0.09)));
  EXPECT_TRUE(passesASurface(planes, tool, placedAndTurned(0.0), placedAndTurned(0.091)));
  EXPECT_TRUE(passesASurface(planes, tool, placedAndTurned(0.08), placedAndTurned(0.08, -0.5)));
  EXPECT_FALSE(
      passesASurface(planes, tool, placedAndTurned(0.095), placedAndTurned(0.12)));  // it is in contact already
  EXPECT_FALSE(passesASurface(planes, tool, placedAndTurned(0.12), placedAndTurned(0.0)));
  planes.planes.clear();
  planes.uncovered.distance = 0.05;
  EXPECT_FALSE(passesASurface(planes, tool, placedAndTurned(0.0), placedAndTurned(0.04)));
  EXPECT_TRUE(passesASurface(planes, tool, placedAndTurned(0.0), placedAndTurned(0.06)));
  EXPECT_FALSE(passesASurface(planes, tool, placedAndTurned(0.06), placedAndTurned(0.07)));
}

}  // namespace
}  // namespace sweep_guard_core
