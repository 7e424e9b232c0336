#include "evaluation/closed_loop_episode.h"

#include <algorithm>
#include <cstring>

namespace sweep_guard_evaluation {

using sweep_guard_core::Time;
using sweep_guard_core::Twist;

namespace {

constexpr size_t kWatched = 400;  // cycles before a placement in which its episode may begin
// Cycles before the begin in which a guard changes nothing: more than is in flight.
constexpr size_t kUntouchedCycles = 20;
constexpr size_t kUntilPlanes = 3;    // cycles until a guard has its first planes
constexpr size_t kReachedLater = 20;  // cycles for which a surface within reach counts: planes and poses are late
constexpr size_t kCame = 50;          // cycles of the approach that are retraced
constexpr double kHeld = 0.5;         // share of the speed below which the tool is held
constexpr sweep_guard_core::Duration kAfterPlacement = std::chrono::seconds(2);
constexpr double kMinApproach = 0.05;  // [m/s] of a surface
constexpr double kMaxApproach = 0.3;   // [m/s]

bool areSame(const Twist& a, const Twist& b) {
  const auto same = [](const Eigen::Vector3d& x, const Eigen::Vector3d& y) {
    // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): bit for bit
    return std::memcmp(x.data(), y.data(), sizeof(double) * 3) == 0;
  };
  return same(a.v_W, b.v_W) && same(a.w_W, b.w_W);
}

double keptShareOf(const Twist& output_W, const Twist& command_W, double radius) {
  const double speed = fastestPoint(command_W, radius);
  return speed > 0.0 ? fastestPoint(output_W, radius) / speed : 1.0;
}

DelayedGuardOptions guardOf(const ClosedLoopOptions& options) {
  DelayedGuardOptions guard = options.guard;
  guard.motion.dead_time = options.robot.dead_time;
  guard.motion.time_constant = options.robot.lag;
  return guard;
}

bool followsAt(const DrivenRobot& driven, size_t cycle) {
  return cycle + 1 < driven.cycles.size() &&
         driven.cycles[cycle + 1].time == driven.cycles[cycle].time + kCommandPeriod;
}

// Of the cycles without a gap before a cycle, at most `count`.
size_t cyclesBefore(const DrivenRobot& driven, size_t cycle, size_t count) {
  size_t first = cycle;
  while (first > 0 && cycle - first < count && followsAt(driven, first - 1)) --first;
  return first;
}

ClosedLoop loopAt(LoopScene& scene, const DrivenRobot& driven, size_t cycle, const SurfaceVelocity& surface,
                  const ClosedLoopOptions& options) {
  return {scene, surface, driven.cycles[cycle], options.guard.motion.standoff};
}

// Lets a guard look on during one cycle. Returns whether it passes the command on.
bool watch(ClosedLoop& loop, const DrivenRobot& driven, size_t cycle) {
  const Twist& command_W = driven.cycles[cycle].command_W;
  return areSame(loop.watch(command_W, driven.cycles[cycle + 1]), command_W);
}

// Adds up what the guard did to the commands.
class Account {
 public:
  Account(const ClosedLoopOptions& options, ClosedLoopEpisode& episode) : options_(options), episode_(episode) {}

  void add(const LoopCycle& cycle) {
    const bool same = areSame(cycle.output_W, cycle.command_W);
    since_reached_ = cycle.gap > options_.guard.reach ? since_reached_ + 1 : 0;
    if (since_reached_ > kReachedLater) {
      ++episode_.free_commands;
      if (!same) ++episode_.free_changed;
    }
    episode_.slowed = episode_.slowed || !same;
    const double radius = options_.tool.boundingRadius();
    commanded_ += fastestPoint(cycle.command_W, radius);
    carried_ += fastestPoint(cycle.output_W, radius);
    if (commanded_ > 0.0) episode_.path_kept = carried_ / commanded_;
    episode_.standoff_speed = std::max(episode_.standoff_speed, cycle.standoff_speed);
    episode_.contact = cycle.contact;
  }

 private:
  const ClosedLoopOptions& options_;
  ClosedLoopEpisode& episode_;
  size_t since_reached_ = kReachedLater;
  double commanded_ = 0.0;
  double carried_ = 0.0;
};

// Of a surface that comes to a robot that begins at a cycle.
SurfaceVelocity velocityOf(const LoopScene& scene, const DrivenRobot::Cycle& begin, Time end, Random& random) {
  const Eigen::Isometry3d X_MT = begin.robot.pose();
  const double side = scene.separationAt(X_MT).normal.dot(scene.normal_M()) >= 0.0 ? 1.0 : -1.0;
  return {side * random.uniform(kMinApproach, kMaxApproach) * scene.normal_M(), end};
}

// A robot that rests where the placement has its contact, from the begin of the episode to its end.
DrivenRobot resting(const DrivenRobot& driven, const ObstaclePlacement& placement, const ClosedLoopOptions& options) {
  const size_t end = std::min(driven.cycleAt(placement.end), driven.cycles.size() - 1);
  const SimulatedRobot robot(driven.cycles[end].robot.pose(), options.robot);
  DrivenRobot at_rest;
  for (Time time = placement.begin; time < placement.end + kAfterPlacement; time += kCommandPeriod)
    at_rest.cycles.push_back({time, {}, robot});
  return at_rest;
}

std::vector<Twist> newest(const std::vector<Twist>& twists, size_t count) {
  return {twists.end() - static_cast<std::ptrdiff_t>(std::min(count, twists.size())), twists.end()};
}

}  // namespace

sweep_guard_core::Tool inPieces(const sweep_guard_core::ConvexShape& cylinder, size_t count) {
  const double length = cylinder.length() / static_cast<double>(count);
  std::vector<sweep_guard_core::ConvexPiece> pieces;
  for (size_t i = 0; i < count; ++i) {
    Eigen::Isometry3d X_TP = Eigen::Isometry3d::Identity();
    X_TP.translation().z() = -length * static_cast<double>(i);
    pieces.push_back({"", sweep_guard_core::ConvexShape::cylinder(cylinder.radius(), length).placed(X_TP)});
  }
  return sweep_guard_core::Tool(pieces);
}

std::optional<Time> beginOf(const DrivenRobot& driven, const ObstaclePlacement& placement,
                            const ClosedLoopOptions& options) {
  LoopScene scene(options.tool, placement.obstacle);
  const size_t latest = driven.cycleAt(placement.begin);
  std::optional<Time> found;
  std::optional<ClosedLoop> loop;
  size_t watched = 0;
  size_t passed = 0;
  for (size_t cycle = cyclesBefore(driven, latest, kWatched); cycle < latest; ++cycle) {
    if (!loop) {
      scene.startAgain();
      loop.emplace(loopAt(scene, driven, cycle, {}, options)).addGuard(guardOf(options));
      watched = 0;
    }
    passed = watch(*loop, driven, cycle) ? passed + 1 : 0;
    if (++watched > kUntilPlanes && passed == 0) loop.reset();  // it would go on from what was not sent
    const bool apart = scene.separationAt(driven.cycles[cycle + 1].robot.pose()).gap > options.guard.motion.standoff;
    if (passed >= kUntouchedCycles && apart) found = driven.cycles[cycle + 1].time;
  }
  return found;
}

ClosedLoopEpisode runEpisode(const DrivenRobot& driven, const ObstaclePlacement& placement,
                             const ClosedLoopOptions& options, const EpisodeKind& kind) {
  Random random(kind.seed);
  LoopScene scene(options.tool, placement.obstacle);
  const size_t begin = driven.cycleAt(placement.begin);
  SurfaceVelocity surface;
  if (kind.surface_comes) surface = velocityOf(scene, driven.cycles[begin], placement.end, random);
  size_t cycle = cyclesBefore(driven, begin, kUntouchedCycles + kUntilPlanes);
  ClosedLoop loop = loopAt(scene, driven, cycle, surface, options);
  if (kind.guarded) loop.addGuard(guardOf(options));
  for (; cycle < begin; ++cycle) watch(loop, driven, cycle);

  ClosedLoopEpisode episode;
  Account account(options, episode);
  std::optional<ClosedLoop> held;
  double least_kept = kHeld;
  std::vector<Twist> came_W;
  std::vector<Twist> came_to_held_W;
  const Time end = placement.end + kAfterPlacement;
  for (; driven.cycles[cycle].time < end && !episode.contact; ++cycle) {
    const LoopCycle ran = loop.run(driven.cycles[cycle].command_W);
    account.add(ran);
    came_W.push_back(loop.robot().velocity_W());
    const double kept = keptShareOf(ran.output_W, ran.command_W, options.tool.boundingRadius());
    if (kept < least_kept) {
      least_kept = kept;
      held.emplace(loop);
      came_to_held_W = newest(came_W, kCame);
    }
    if (!followsAt(driven, cycle)) break;
  }
  if (held && !kind.surface_comes) {
    scene.startAgain();
    episode.retreats = retreatFrom(*held, came_to_held_W, options.robot, options.random_retreats, random);
  }
  return episode;
}

ClosedLoopEpisode runEpisodeAtRest(const DrivenRobot& driven, const ObstaclePlacement& placement,
                                   const ClosedLoopOptions& options, const EpisodeKind& kind) {
  return runEpisode(resting(driven, placement, options), placement, options, kind);
}

}  // namespace sweep_guard_evaluation
