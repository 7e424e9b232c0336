// Searches on random arms.
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <limits>

#include "allocations.h"
#include "motion/random_arms.h"
#include "motion/random_scenes.h"

namespace sweep_guard_core {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using std::chrono::milliseconds;

struct OracleRow {
  double closing;
  double limit;
};

// All balls before their planes in a state. Velocities are differences of places.
std::vector<OracleRow> rowsOf(const ArmCase& arm, const RobotState& state, const BrakingLimits& limits) {
  MovingTool tool(arm.tree);
  tool.place(state, *arm.inputs.tool, arm.command.velocities, limits);
  std::vector<OracleRow> rows;
  for (const SeparatingPlane& plane : arm.inputs.planes->planes) {
    for (size_t i = 0; i < arm.inputs.tool->pieces[plane.piece].size(); ++i) {
      const auto center = [&](double time) {
        return centerOf(arm, after(state, arm.command.velocities, time), plane.piece, i);
      };
      const double gap =
          plane.normal_W.dot(center(0.0) - plane.point_W) - arm.inputs.tool->pieces[plane.piece][i].radius;
      const double acceleration = tool.balls()[tool.pieces()[plane.piece].first_ball + i].acceleration;
      rows.push_back(
          {-plane.normal_W.dot(center(1e-5) - center(-1e-5)) / 2e-5,
           closingLimit({plane.normal_W, Vector3d::Zero(), gap, plane.surface_speed}, acceleration, limits)});
    }
  }
  return rows;
}

TEST(JointMotionGuardSearchTest, TheScaleIsTheLargestThatNoBallClosesFasterThanItMayAtTheNewestAndTheExpectedState) {
  Random random(91);
  int limited = 0;
  int whole = 0;
  MotionGuardOptions options;
  options.dead_time = milliseconds(30);
  for (std::uint64_t i = 0; i < caseCount(3'000); ++i) {
    ArmCase arm = randomArm(random, random.below(6));
    if (random.chance(0.2)) editable(arm).uncovered.distance = random.uniform(0.0, 0.5);
    JointMotionGuard guard(options, arm.tree);
    ArmCase before = arm;
    before.command.velocities = velocitiesOf(*arm.tree, random, 0.3);
    const double sent = guard.guard(before.inputs, before.joints, before.command, at(1000)).scale;
    const double scale = guard.guard(arm.inputs, arm.joints, arm.command, at(1010)).scale;
    ASSERT_GE(scale, 0.0);
    ASSERT_LE(scale, 1.0);
    const BrakingLimits limits{1.0, 0.05, 0.002, 0.0};
    const RobotState expected = after(arm.joints.state, before.command.velocities, 0.01 * sent);
    bool more_is_too_much = scale == 1.0;
    MovingTool swept(arm.tree);
    swept.place(arm.joints.state, *arm.inputs.tool, arm.command.velocities, limits);
    double fastest = 0.0;
    double way = 0.0;
    for (const RobotState& state : {arm.joints.state, expected}) {
      for (const OracleRow& row : rowsOf(arm, state, limits)) {
        EXPECT_LE(scale * row.closing, row.limit + 1e-8);
        more_is_too_much = more_is_too_much || (scale + 1e-6) * row.closing > row.limit - 1e-8;
      }
      MovingTool tool(arm.tree);
      tool.place(state, *arm.inputs.tool, arm.command.velocities, limits);
      fastest = std::max(fastest, tool.fastest());
      way = tool.largestDisplacement(swept, *arm.inputs.tool);
    }
    UncoveredSurfaces uncovered = arm.inputs.planes->uncovered;
    uncovered.distance -= way;
    EXPECT_LE(scale * fastest, allowedSpeed(uncovered, limits) + 1e-9);
    more_is_too_much = more_is_too_much || (scale + 1e-6) * fastest > allowedSpeed(uncovered, limits) - 1e-9;
    EXPECT_TRUE(more_is_too_much) << i << ": " << scale;
    ++(scale == 1.0 ? whole : limited);
  }
  EXPECT_GT(limited, 300);
  EXPECT_GT(whole, 300);
}

TEST(JointMotionGuardSearchTest, FreeMotionIsPassedOnBitForBit) {
  Random random(92);
  for (int i = 0; i < 1000; ++i) {
    ArmCase arm = randomArm(random, 6, 10.0, 20.0);
    arm.command.velocities *= 0.3;
    EXPECT_EQ(guardOnce(arm).scale, 1.0) << i;
  }
}

TEST(JointMotionGuardSearchTest, ARetreatIsPassedOnBitForBitAtAnyGap) {
  Random random(93);
  int retreats = 0;
  while (retreats < 1000) {
    ArmCase arm = randomArm(random, 1 + random.below(2), -0.02, 0.02);
    for (int sign = 0; sign < 2; ++sign) {
      arm.command.velocities *= -1.0;
      const std::vector<OracleRow> rows = rowsOf(arm, arm.joints.state, {});
      if (std::any_of(rows.begin(), rows.end(), [](const OracleRow& row) { return row.closing > -1e-9; })) continue;
      EXPECT_EQ(guardOnce(arm).scale, 1.0);
      ++retreats;
    }
  }
}

TEST(JointMotionGuardSearchTest, IsContinuousInTheCommand) {
  Random random(94);
  int compared = 0;
  for (std::uint64_t i = 0; i < caseCount(2'000); ++i) {
    ArmCase arm = randomArm(random, 4, 0.005, 0.2);
    const double before = guardOnce(arm).scale;
    arm.command.velocities += 1e-9 * velocitiesOf(*arm.tree, random, 1.0);
    EXPECT_NEAR(guardOnce(arm).scale, before, 1e-4) << i;
    compared += before < 1.0 ? 1 : 0;
  }
  EXPECT_GT(compared, 100);
}

TEST(JointMotionGuardSearchTest, OlderPlanesSlowDownMore) {
  Random random(95);
  int slower = 0;
  for (int i = 0; i < 500; ++i) {
    ArmCase arm = randomArm(random, 4, 0.005, 0.1);
    const double fresh = guardOnce(arm).scale;
    editable(arm).timestamps = received(950);
    const double old = guardOnce(arm).scale;
    EXPECT_LE(old, fresh);
    if (fresh < 1.0 && old < fresh) ++slower;
  }
  EXPECT_GT(slower, 50);
}

TEST(JointMotionGuardSearchTest, AllocatesNothing) {
  Random random(96);
  MotionGuardOptions options;
  options.escape_speed = 0.01;
  for (int i = 0; i < 50; ++i) {
    ArmCase arm = randomArm(random, 64, 0.0, 0.5);
    if (i % 3 == 0) arm.inputs.warning->level = WarningLevel::kUnknown;
    JointMotionGuard guard(options, arm.tree);
    guard.guard(arm.inputs, arm.joints, arm.command, at(1000));
    const Allocations allocations;
    for (int ms = 1001; ms < 1010; ++ms) guard.guard(arm.inputs, arm.joints, arm.command, at(ms));
    guard.stop(at(1010).steady);
    EXPECT_EQ(allocations.count(), 0U) << allocations.stacks();
  }
}

// A robot that follows commands after a dead time and with a first-order lag.
class LaggingArm {
 public:
  LaggingArm(const RobotState& state, int dead_time_ms, int lag_ms)
      : state_(state), lag_ms_(lag_ms), velocity_(VectorXd::Zero(size())) {
    for (int i = 0; i < dead_time_ms; ++i) sent_.emplace_back(VectorXd::Zero(size()));
  }

  const RobotState& state() const { return state_; }
  const RobotState& measured(int age_ms) const {
    return age_ms < static_cast<int>(past_.size()) ? *(past_.rbegin() + age_ms) : past_.front();
  }
  void step(const VectorXd& command) {
    past_.push_back(state_);
    sent_.push_back(command);
    velocity_ += (sent_.front() - velocity_) / std::max(1, lag_ms_);
    sent_.pop_front();
    state_ = after(state_, velocity_, 1e-3);
  }

 private:
  Eigen::Index size() const { return static_cast<Eigen::Index>(state_.positions.size()); }

  RobotState state_;
  int lag_ms_;
  VectorXd velocity_;
  std::deque<VectorXd> sent_;
  std::vector<RobotState> past_;
};

double leastGap(const ArmCase& arm, const RobotState& state) {
  double least = std::numeric_limits<double>::infinity();
  for (const SeparatingPlane& plane : arm.inputs.planes->planes) {
    const auto& balls = arm.inputs.tool->pieces[plane.piece];
    for (size_t i = 0; i < balls.size(); ++i) {
      const Vector3d from_plane = centerOf(arm, state, plane.piece, i) - plane.point_W;
      least = std::min(least, plane.normal_W.dot(from_plane) - balls[i].radius);
    }
  }
  return least;
}

// Planes and positions are 10 ms old.
TEST(JointMotionGuardSearchTest, AnArmWithDelaysDoesNotPassTheStandoff) {
  Random random(97);
  int came = 0;
  for (std::uint64_t i = 0; i < caseCount(40); ++i) {
    ArmCase arm = randomArm(random, 3, 0.003, 0.2);
    for (SeparatingPlane& plane : editable(arm).planes) plane.surface_speed = 0.0;
    const int dead_time_ms = random.below(50);
    const int lag_ms = random.below(50);
    MotionGuardOptions options;
    options.dead_time = milliseconds(dead_time_ms);
    options.time_constant = milliseconds(lag_ms);
    options.deceleration = random.logUniform(0.5, 5.0);
    JointMotionGuard guard(options, arm.tree);
    LaggingArm robot(arm.joints.state, dead_time_ms, lag_ms);
    robot.step(VectorXd::Zero(arm.command.velocities.size()));
    VectorXd output;
    double least = leastGap(arm, robot.state());
    for (int ms = 0; ms < 2000; ++ms) {
      if (ms % 10 == 0) {
        arm.joints = {robot.measured(10), received(ms - 10)};
        editable(arm).timestamps = received(ms - 10);
        editable(arm).valid_until = at(ms + 100).stamp;
        arm.inputs.warning->received = at(ms).steady;
        arm.command.timestamps = received(ms);
        output = guard.guard(arm.inputs, arm.joints, arm.command, at(ms)).scale * arm.command.velocities;
      }
      robot.step(output);
      if (ms % 5 == 4) least = std::min(least, leastGap(arm, robot.state()));
    }
    EXPECT_GT(least, options.standoff - 1e-6)
        << i << ": " << dead_time_ms << " ms, " << lag_ms << " ms, " << options.deceleration << " m/s^2";
    came += least < options.standoff + 0.002 ? 1 : 0;
  }
  EXPECT_GT(came, 5);
}

}  // namespace
}  // namespace sweep_guard_core
