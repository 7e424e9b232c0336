#include "evaluation/retreat.h"

#include <algorithm>
#include <array>

#include "sweep_guard/motion/separating_plane.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::PointHull;
using sweep_guard_core::toSeconds;
using sweep_guard_core::Twist;

namespace {

constexpr size_t kCycles = 30;
constexpr int kTriesForTwist = 1000;       // for each random direction
constexpr double kNormalSpeed = 0.1;       // [m/s]
constexpr double kMinRetreatSpeed = 0.02;  // [m/s] of a random retreat
constexpr double kMinTurnRate = 0.1;       // [rad/s]
constexpr double kShareOfMax = 0.6;        // of the robot's speed, at most

bool opens(const Twist& twist_W, const Eigen::Vector3d& normal, const Eigen::Vector3d& from_origin) {
  return normal.dot(twist_W.v_W + twist_W.w_W.cross(from_origin)) >= 0.0;
}

double keptOf(const Eigen::Vector3d& output, const Eigen::Vector3d& command) {
  const double squared = command.squaredNorm();
  return squared > 0.0 ? output.dot(command) / squared : 1.0;
}

// Speeds up from rest as the robot can; the ratio of translation and turn stays.
std::vector<Twist> speedUpTo(const Twist& twist_W, const RobotOptions& robot) {
  std::vector<Twist> commands_W;
  for (size_t i = 1; i <= kCycles; ++i) {
    const double time = toSeconds(kCommandPeriod) * static_cast<double>(i);
    const double share = std::min({1.0, robot.max_acceleration * time / std::max(1e-9, twist_W.v_W.norm()),
                                   robot.max_turn_acceleration * time / std::max(1e-9, twist_W.w_W.norm())});
    commands_W.push_back({share * twist_W.v_W, share * twist_W.w_W});
  }
  return commands_W;
}

std::vector<Twist> reversed(const std::vector<Twist>& came_W) {
  std::vector<Twist> back_W;
  for (auto twist = came_W.rbegin(); twist != came_W.rend(); ++twist) back_W.push_back({-twist->v_W, -twist->w_W});
  return back_W;
}

Retreat runRetreat(RetreatKind kind, ClosedLoop loop, const std::vector<Twist>& commands_W) {
  Retreat retreat;
  retreat.kind = kind;
  const double begin = loop.scene().separationAt(loop.X_MT()).gap;
  double seconds = 0.0;
  for (const Twist& command_W : commands_W) {
    if (!opensEveryGap(loop.scene(), loop.X_MT(), command_W)) break;
    const LoopCycle cycle = loop.run(command_W);
    ++retreat.commands;
    seconds += toSeconds(kCommandPeriod);
    retreat.speed_kept = std::min(
        {retreat.speed_kept, keptOf(cycle.output_W.v_W, command_W.v_W), keptOf(cycle.output_W.w_W, command_W.w_W)});
    retreat.contact = retreat.contact || cycle.contact;
    if (!retreat.time_until_free && cycle.least_gap >= begin + Retreat::kFree) retreat.time_until_free = seconds;
  }
  return retreat;
}

Twist randomTwist(RetreatKind kind, const RobotOptions& robot, Random& random) {
  Twist twist_W;
  twist_W.v_W = random.uniform(kMinRetreatSpeed, kShareOfMax * robot.max_speed) * random.direction();
  if (kind == RetreatKind::kTurn) {
    twist_W.w_W = random.uniform(kMinTurnRate, robot.max_turn_rate) * random.direction();
  }
  return twist_W;
}

}  // namespace

bool opensEveryGap(const LoopScene& scene, const Eigen::Isometry3d& X_MT, const Twist& twist_W) {
  const Eigen::Vector3d& origin_M = X_MT.translation();
  for (size_t i = 0; i < scene.tool().pieces().size(); ++i) {
    const auto nearest = scene.separationAt(X_MT, i);
    if (!opens(twist_W, nearest.normal, nearest.on_tool - origin_M)) return false;
    for (const auto& ball : enclosingBalls(scene.tool().pieces()[i].shape_T)) {
      const Eigen::Vector3d center_M = X_MT * ball.center_T;
      const auto apart = separation(PointHull(std::array{center_M}), PointHull(scene.corners_M()));
      if (!opens(twist_W, apart.normal, center_M - origin_M)) return false;
    }
  }
  return true;
}

std::vector<Retreat> retreatFrom(const ClosedLoop& held, const std::vector<Twist>& came_W, const RobotOptions& robot,
                                 size_t random_count, Random& random) {
  const LoopScene& scene = held.scene();
  const Eigen::Isometry3d X_MT = held.X_MT();
  const double side = scene.separationAt(X_MT).normal.dot(scene.normal_M()) >= 0.0 ? 1.0 : -1.0;
  const Twist away_W{side * kNormalSpeed * scene.normal_M(), Eigen::Vector3d::Zero()};
  std::vector<Retreat> retreats = {runRetreat(RetreatKind::kNormal, held, speedUpTo(away_W, robot)),
                                   runRetreat(RetreatKind::kReverse, held, reversed(came_W))};
  for (const RetreatKind kind : {RetreatKind::kTranslate, RetreatKind::kTurn}) {
    for (size_t i = 0; i < random_count; ++i) {
      Twist twist_W = randomTwist(kind, robot, random);
      int tries = 0;
      while (tries++ < kTriesForTwist && !opensEveryGap(scene, X_MT, twist_W))
        twist_W = randomTwist(kind, robot, random);
      if (tries <= kTriesForTwist) retreats.push_back(runRetreat(kind, held, speedUpTo(twist_W, robot)));
    }
  }
  const auto none = [](const Retreat& retreat) { return retreat.commands == 0; };
  retreats.erase(std::remove_if(retreats.begin(), retreats.end(), none), retreats.end());
  return retreats;
}

}  // namespace sweep_guard_evaluation
