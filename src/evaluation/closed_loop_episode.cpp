#include "evaluation/closed_loop_episode.h"

#include <algorithm>
#include <cstring>

#include "evaluation/random.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::Duration;
using sweep_guard_core::toSeconds;
using sweep_guard_core::Twist;

namespace {

constexpr size_t kWatched = 100;

bool sameBits(const Twist& a, const Twist& b) {
  return std::memcmp(a.v_W.data(), b.v_W.data(), sizeof(double) * 3) == 0 &&
         std::memcmp(a.w_W.data(), b.w_W.data(), sizeof(double) * 3) == 0;
}

double keptOf(const Eigen::Vector3d& output, const Eigen::Vector3d& command) {
  const double squared = command.squaredNorm();
  return squared > 0.0 ? output.dot(command) / squared : 1.0;
}

double kept(const Twist& output_W, const Twist& command_W) {
  return std::min(keptOf(output_W.v_W, command_W.v_W), keptOf(output_W.w_W, command_W.w_W));
}

/// Where the guard held the tool most.
struct Held {
  ClosedLoop loop;
  std::vector<Twist> came_W;  // velocities of the robot before, newest last
};

bool opensNearest(const SweptContact& contact, const ClosedLoop& loop, const Twist& twist_W) {
  const Eigen::Isometry3d X_MT = loop.pose_M();
  const auto apart = contact.separationAt(X_MT);
  return apart.normal.dot(twist_W.v_W + twist_W.w_W.cross(apart.on_tool - X_MT.translation())) >= 0.0;
}

bool opensAll(const SweptContact& contact, const ClosedLoop& loop, const std::vector<sweep_guard_core::ToolBall>& balls,
              const Twist& twist_W) {
  if (!opensNearest(contact, loop, twist_W)) return false;
  const Eigen::Isometry3d X_MT = loop.pose_M();
  for (const auto& ball : balls) {
    const Eigen::Vector3d center = X_MT * ball.center_T;
    struct Point {
      Eigen::Vector3d p;
      Eigen::Vector3d supportPoint(const Eigen::Vector3d&) const { return p; }
    } point{center};
    const auto apart = separation(point, sweep_guard_core::PointHull(contact.corners()));
    if (apart.normal.dot(twist_W.v_W + twist_W.w_W.cross(center - X_MT.translation())) < 0.0) return false;
  }
  return true;
}

class Retreats {
 public:
  Retreats(const SweptContact& contact, const ClosedLoopOptions& options, const Held& held, std::uint64_t seed)
      : contact_(contact), options_(options), held_(held), random_(seed), balls_(enclosingBalls(options.guard.tool)) {}

  std::vector<Retreat> run() {
    std::vector<Retreat> all;
    const auto apart = contact_.separationAt(held_.loop.pose_M());
    const Eigen::Vector3d across = (contact_.corners()[1] - contact_.corners()[0])
                                       .cross(contact_.corners()[3] - contact_.corners()[0])
                                       .normalized();
    const double side = apart.normal.dot(across) >= 0.0 ? 1.0 : -1.0;
    all.push_back(retreat(Retreat::Kind::kAway, steady({side * 0.1 * across, Eigen::Vector3d::Zero()}, 30)));
    std::vector<Twist> back_W(held_.came_W.rbegin(), held_.came_W.rend());
    for (Twist& twist : back_W) twist = {-twist.v_W, -twist.w_W};
    all.push_back(retreat(Retreat::Kind::kBack, back_W));
    for (size_t i = 0; i < options_.retreats; ++i) {
      const bool turn = i % 2 == 1;
      for (int tries = 0; tries < 1000; ++tries) {
        Twist twist_W;
        twist_W.v_W = random_.uniform(0.02, 0.3) * direction();
        if (turn) twist_W.w_W = random_.uniform(0.1, options_.robot.max_turn_rate) * direction();
        if (!opensAll(contact_, held_.loop, balls_, twist_W)) continue;
        all.push_back(retreat(turn ? Retreat::Kind::kTurn : Retreat::Kind::kMove, steady(twist_W, 30)));
        break;
      }
    }
    return all;
  }

 private:
  Eigen::Vector3d direction() { return random_.frameWithZ(Eigen::Vector3d::UnitX()).col(0) * 0 + randomUnit(); }
  Eigen::Vector3d randomUnit() {
    for (;;) {
      const Eigen::Vector3d p(random_.uniform(-1, 1), random_.uniform(-1, 1), random_.uniform(-1, 1));
      if (p.norm() <= 1.0 && p.norm() > 0.1) return p.normalized();
    }
  }
  std::vector<Twist> steady(const Twist& twist_W, size_t cycles) const {
    std::vector<Twist> all;
    for (size_t i = 1; i <= cycles; ++i) {
      const double t = toSeconds(kCommandPeriod) * static_cast<double>(i);
      double share = std::min(1.0, options_.robot.max_acceleration * t / twist_W.v_W.norm());
      if (twist_W.w_W.norm() > 0.0)
        share = std::min(share, options_.robot.max_turn_acceleration * t / twist_W.w_W.norm());
      all.push_back({share * twist_W.v_W, share * twist_W.w_W});
    }
    return all;
  }
  Retreat retreat(Retreat::Kind kind, const std::vector<Twist>& commands_W) {
    Retreat result;
    result.kind = kind;
    ClosedLoop loop = held_.loop;
    const double begin = contact_.separationAt(loop.pose_M()).gap;
    bool all = true;
    for (size_t i = 0; i < commands_W.size(); ++i) {
      const bool nearest = opensNearest(contact_, loop, commands_W[i]);
      if (!nearest) break;
      all = all && opensAll(contact_, loop, balls_, commands_W[i]);
      const auto cycle = loop.run(commands_W[i]);
      if (cycle.contact_speed) { fprintf(stderr, "contact in retreat\n"); }
      const double k = kept(cycle.output_W, commands_W[i]);
      result.kept_near = std::min(result.kept_near, k);
      if (all) {
        if (k < 0.99 && getenv("LOOP_DEBUG")) dump(kind, i, loop, commands_W[i], cycle, k);
        result.kept = std::min(result.kept, k);
      }
      if (cycle.least_gap > begin + 0.01 && !result.time_until_free)
        result.time_until_free = toSeconds(kCommandPeriod) * static_cast<double>(i + 1);
    }
    return result;
  }
  void dump(Retreat::Kind kind, size_t i, const ClosedLoop& loop, const Twist& command_W, const ClosedLoop::Cycle& cycle, double k) {
    const auto apart = contact_.separationAt(loop.pose_M());
    fprintf(stderr, "kind %d cycle %zu gap %.5f kept %.4f v %.3f w %.3f normal angle to square %.1f\n", (int)kind, i, cycle.gap, k,
            command_W.v_W.norm(), command_W.w_W.norm(),
            std::acos(std::min(1.0, std::abs(apart.normal.dot((contact_.corners()[1] - contact_.corners()[0])
                                       .cross(contact_.corners()[3] - contact_.corners()[0])
                                       .normalized())))) * 57.3);
    const auto& c = contact_.corners();
    const Eigen::Vector3d ctr = 0.5 * (c[0] + c[2]);
    const Eigen::Vector3d ax = (c[1] - c[0]).normalized(), ay = (c[3] - c[0]).normalized();
    const double half = 0.5 * (c[1] - c[0]).norm();
    size_t bi = 0;
    for (const auto& ball : loop.guard()->facing()) {
      const size_t index = bi++;
      const double u = closingSpeed(ball, command_W);
      const double limit = closingLimit(ball, command_W.w_W.norm(), options_.guard.braking);
      const bool ex = (index / balls_.size()) % 2 == 1;
      const auto& X = ex ? loop.guard()->dbg_expected : loop.guard()->dbg_pose;
      const Eigen::Vector3d p = X.translation() + ball.center_W;
      struct Point {
        Eigen::Vector3d q;
        Eigen::Vector3d supportPoint(const Eigen::Vector3d&) const { return q; }
      } point{p};
      const auto a2 = separation(point, sweep_guard_core::PointHull(contact_.corners()));
      if (u > limit) fprintf(stderr, "   ball %.4f %.4f %.4f gap %.5f closes %.4f limit %.4f normal.now %.1f deg %s beyond x %.4f y %.4f truly opens %.4f true gap %.4f w2 %.4f\n", ball.center_W.x(), ball.center_W.y(), ball.center_W.z(),
          ball.gap, u, limit, std::acos(std::min(1.0, ball.normal_W.dot(apart.normal))) * 57.3, ex ? "expected" : "pose", std::abs(ax.dot(p - ctr)) - half, std::abs(ay.dot(p - ctr)) - half, a2.normal.dot(command_W.v_W + command_W.w_W.cross(ball.center_W)), a2.gap, 0.0);
    }
  }

  const SweptContact& contact_;
  const ClosedLoopOptions& options_;
  const Held& held_;
  Random random_;
  std::vector<sweep_guard_core::ToolBall> balls_;
};

}  // namespace

ClosedLoopEpisode runEpisode(const DrivenRobot& driven, const ObstaclePlacement& placement,
                             const ClosedLoopOptions& options, bool guarded, std::uint64_t seed) {
  SweptContact contact(options.guard.tool, placement.obstacle);
  const size_t begin = driven.cycleAt(placement.begin);
  ClosedLoop loop(contact, {placement.obstacle}, driven.cycles[begin].robot, guarded ? &options.guard : nullptr,
                  options.guard.braking.standoff);
  for (size_t i = std::max(begin, kWatched) - kWatched; i < begin; ++i) {
    loop.watch(driven.cycles[i].robot, driven.cycles[i].command_W, driven.cycles[begin].time - driven.cycles[i].time);
  }
  ClosedLoopEpisode episode;
  episode.gap_at_begin = contact.separationAt(loop.pose_M()).gap;
  episode.least_gap = episode.gap_at_begin;
  std::optional<Held> held;
  double held_kept = 0.5;
  std::vector<Twist> came_W;
  double commanded = 0.0;
  double carried = 0.0;
  auto time = driven.cycles[begin].time;
  bool out = false;
  for (size_t i = begin; i < driven.cycles.size() && driven.cycles[i].time == time &&
                         time < placement.end + options.after; ++i, time += kCommandPeriod) {
    const Twist& command_W = driven.cycles[i].command_W;
    const auto cycle = loop.run(command_W);
    came_W.push_back(loop.robot().velocity_W());
    out = out || cycle.gap > options.guard.braking.standoff + 1e-4;
    if (out) {
      if (cycle.fastest_at_standoff > 0.001 && cycle.fastest_at_standoff > episode.fastest_at_standoff && guarded && getenv("LOOP_DEBUG"))
        fprintf(stderr, "standoff: gap %.6f least %.6f closing %.5f at %.2f s, began at %.4f\n", cycle.gap, cycle.least_gap, cycle.fastest_at_standoff,
                toSeconds(time - placement.begin), episode.gap_at_begin);
      episode.fastest_at_standoff = std::max(episode.fastest_at_standoff, cycle.fastest_at_standoff);
    }
    episode.least_gap = std::min(episode.least_gap, cycle.least_gap);
    const bool free = cycle.gap > options.guard.reach + 0.1;
    if (free) {
      ++episode.free_cycles;
      if (!sameBits(cycle.output_W, command_W)) ++episode.free_changed;
    }
    const double radius = options.guard.tool.boundingRadius();
    commanded += fastestPoint(command_W, radius);
    carried += fastestPoint(cycle.output_W, radius);
    const double k = kept(cycle.output_W, command_W);
    episode.least_kept = std::min(episode.least_kept, k);
    if (guarded && k < held_kept) {
      held_kept = k;
      held.emplace(Held{loop, {came_W.end() - static_cast<long>(std::min<size_t>(50, came_W.size())), came_W.end()}});
    }
    if (cycle.contact_speed) {
      episode.contact_speed = cycle.contact_speed;
      break;
    }
  }
  if (commanded > 0.0) episode.path_kept = carried / commanded;
  if (held) episode.retreats = Retreats(contact, options, *held, seed).run();
  return episode;
}

}  // namespace sweep_guard_evaluation
