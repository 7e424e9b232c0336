// Recorded hands drive arms whose elbows are among obstacles: doc/motion.md, "The joints of an arm".
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "data_path.h"
#include "motion/arm_loop.h"
#include "motion/random_scenes.h"

namespace sweep_guard_core {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kCycles = 400;        // of an episode
constexpr double kMaxSpeed = 0.5;   // of the hand [m/s]
constexpr double kMaxTurn = 1.0;    // of the hand [rad/s]
constexpr double kMaxJoint = 1.5;   // [rad/s]
constexpr double kDamping = 0.05;   // of the inverse kinematics
constexpr double kAway = 0.01;      // least share of a retreat's speed along the normal
constexpr double kFirstGap = 0.03;  // least gap where an episode begins [m]

struct HandPose {
  double time;
  Vector3d p;
  Eigen::Quaterniond q;
};

std::vector<HandPose> readHand(const std::filesystem::path& path) {
  std::vector<HandPose> poses;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    HandPose pose;
    if (words >> pose.time >> pose.p.x() >> pose.p.y() >> pose.p.z() >> pose.q.x() >> pose.q.y() >> pose.q.z() >>
        pose.q.w())
      poses.push_back(pose);
  }
  return poses;
}

// Velocities of the hand at 100 Hz from a time on; shorter before a gap.
std::vector<Vector6d> twistsOf(const std::vector<HandPose>& hand, double time) {
  std::vector<Vector6d> twists;
  size_t i = 0;
  for (int cycle = 0; cycle < kCycles; ++cycle, time += 0.01) {
    while (i + 1 < hand.size() && hand[i + 1].time <= time) ++i;
    size_t next = i + 1;
    while (next < hand.size() && hand[next].time < hand[i].time + 0.01) ++next;
    if (next >= hand.size() || hand[next].time - hand[i].time > 0.25) break;
    const double interval = hand[next].time - hand[i].time;
    const Eigen::AngleAxisd turn((hand[next].q * hand[i].q.conjugate()).normalized());
    Vector6d twist;
    twist << (hand[next].p - hand[i].p) / interval, turn.angle() / interval * turn.axis();
    twist.head<3>() *= std::min(1.0, kMaxSpeed / std::max(1e-9, twist.head<3>().norm()));
    twist.tail<3>() *= std::min(1.0, kMaxTurn / std::max(1e-9, twist.tail<3>().norm()));
    twists.push_back(twist);
  }
  return twists;
}

VectorXd damped(const Eigen::MatrixXd& J, const VectorXd& wanted) {
  const Eigen::MatrixXd A = J * J.transpose() + kDamping * kDamping * Eigen::MatrixXd::Identity(J.rows(), J.rows());
  VectorXd velocities = J.transpose() * A.ldlt().solve(wanted);
  return velocities * std::min(1.0, kMaxJoint / std::max(1e-9, velocities.cwiseAbs().maxCoeff()));
}

// Of a point fixed to a link.
Eigen::MatrixXd jacobianOf(const ArmScene& scene, const std::vector<double>& positions, size_t link,
                           const Vector3d& p_W) {
  const auto X_WL = scene.linksAt(positions);
  Jacobian J;
  geometricJacobian(*scene.arm().tree, X_WL, link, J);
  const Vector3d r = p_W - X_WL[link].translation();
  for (Eigen::Index i = 0; i < J.cols(); ++i) J.col(i).head<3>() += Vector3d(J.col(i).tail<3>()).cross(r);
  return J;
}

VectorXd commandOf(const ArmScene& scene, const std::vector<double>& positions, const Vector6d& twist) {
  const size_t last = scene.arm().bodies.size() - 1;
  return damped(jacobianOf(scene, positions, last, scene.linksAt(positions)[last] * scene.arm().tip_L), twist);
}

SentSurface globe(double radius) {
  SentSurface globe = cubeSurface(1.0, 4);
  for (Vector3d& vertex : globe.vertices) vertex = radius * vertex.normalized();
  return globe;
}

SentSurface obstacleAt(Random& random, const Vector3d& toward, const Vector3d& p_W) {
  const double size = random.uniform(0.02, 0.08);
  SentSurface surface = random.chance(0.5) ? globe(size) : cubeSurface(size);
  Eigen::Affine3d X(random.pose(p_W + 0.5 * size * toward));
  if (random.chance(0.3)) X.scale(Vector3d(1.0, 1.0, random.uniform(0.1, 0.5)));
  return surface.moved(X);
}

using Path = std::vector<std::vector<double>>;

// Without obstacles or a guard, at each command.
Path unguardedPath(const CapsuleArm& arm, const std::vector<double>& home, const std::vector<Vector6d>& twists) {
  ArmScene far(arm, cubeSurface(0.01).movedBy(100.0, 0.0, 0.0));
  ArmLoop loop(far, home, /*guarded=*/false);
  Path path = {home};
  for (const Vector6d& twist : twists) {
    loop.run(commandOf(far, loop.positions(), twist));
    path.push_back(loop.positions());
  }
  return path;
}

// An obstacle that a link, mostly one at the elbow, runs into on this path. Empty: none was found.
std::optional<SentSurface> obstacleOn(const CapsuleArm& arm, const Path& path, Random& random) {
  const ArmScene far(arm, cubeSurface(0.01).movedBy(100.0, 0.0, 0.0));
  for (int tries = 0; tries < 100; ++tries) {
    const size_t cycle = 50 + static_cast<size_t>(random.below(static_cast<int>(path.size()) - 60));
    const auto links = static_cast<int>(arm.bodies.size());
    const auto link = static_cast<size_t>(random.chance(0.8) ? 1 + random.below(3) : random.below(links));
    const Capsule& capsule =
        arm.capsules[link][static_cast<size_t>(random.below(static_cast<int>(arm.capsules[link].size())))];
    const Vector3d p_L = capsule.from + random.uniform(0.0, 1.0) * (capsule.to - capsule.from);
    const Vector3d p_W = far.linksAt(path[cycle])[link] * p_L;
    const Vector3d moved = p_W - far.linksAt(path[cycle - 10])[link] * p_L;
    if (moved.norm() < 0.004) continue;
    const SentSurface obstacle = obstacleAt(random, moved.normalized(), p_W + capsule.radius * moved.normalized());
    if (ArmScene(arm, obstacle).gapAt(path[0]) > kFirstGap) return obstacle;
  }
  return {};
}

// Returns whether a motion leads each axis and each ball of any capsule away from the obstacle, rather than along it.
bool leadsAway(const ArmScene& scene, const std::vector<double>& positions, const VectorXd& velocities) {
  const auto X_WL = scene.linksAt(positions);
  for (size_t link = 0; link < X_WL.size(); ++link) {
    for (const Capsule& capsule_L : scene.arm().capsules[link]) {
      const Capsule capsule = ArmScene::placed(X_WL[link], capsule_L);
      for (const Capsule& of :
           {capsule, Capsule{capsule.from, capsule.from, 0.0}, Capsule{capsule.to, capsule.to, 0.0}}) {
        const NearestPair nearest = scene.nearestOf(of);
        const VectorXd velocity = jacobianOf(scene, positions, link, nearest.on_segment).topRows(3) * velocities;
        const Vector3d normal = (nearest.on_segment - nearest.on_surface).normalized();
        if (normal.dot(Vector3d(velocity)) < kAway * velocity.norm() - 1e-12) return false;
      }
    }
  }
  return true;
}

// Along the normal of what is nearest.
VectorXd awayFrom(const ArmScene& scene, const std::vector<double>& positions) {
  const auto X_WL = scene.linksAt(positions);
  NearestPair nearest;
  size_t of = 0;
  for (size_t link = 0; link < X_WL.size(); ++link) {
    for (const Capsule& capsule : scene.arm().capsules[link]) {
      NearestPair one = scene.nearestOf(ArmScene::placed(X_WL[link], capsule));
      one.distance -= capsule.radius;
      if (one.distance >= nearest.distance) continue;
      nearest = one;
      of = link;
    }
  }
  const Vector3d normal = (nearest.on_segment - nearest.on_surface).normalized();
  return damped(jacobianOf(scene, positions, of, nearest.on_segment).topRows(3), VectorXd(0.1 * normal));
}

struct Figures {
  int placements = 0;
  int met = 0;       // without the guard
  int contacts = 0;  // with it
  double least_gap = std::numeric_limits<double>::infinity();
  int retreats = 0;
  int slowed = 0;  // of them, below 99 % of the speed
  double least_kept = 1.0;
  size_t free_commands = 0;
  size_t free_changed = 0;
};

// On the whole way until the arm is at rest: 0.12 s, and braking.
bool leadsAwayUntilRest(const ArmScene& scene, const std::vector<double>& positions, const VectorXd& velocities) {
  const RobotState from{Eigen::Isometry3d::Identity(), positions};
  MovingTool tool(scene.arm().tree);
  tool.place(from, *scene.balls(), velocities);
  const StopOnPath stop{0.12, tool.fastest() / ArmLoop::options().deceleration};
  for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    if (!leadsAway(scene, after(from, velocities, share * stop.way(1.0)).positions, velocities)) return false;
  }
  return true;
}

// Until a command that does not lead away.
void retreat(ArmLoop loop, const std::vector<VectorXd>& commands, Figures& figures) {
  double kept = 1.0;
  int count = 0;
  for (const VectorXd& command : commands) {
    if (!leadsAwayUntilRest(loop.scene(), loop.positions(), command)) break;
    kept = std::min(kept, loop.run(command).scale);
    ++count;
  }
  if (count == 0) return;
  ++figures.retreats;
  figures.least_kept = std::min(figures.least_kept, kept);
  figures.slowed += kept < 0.99 ? 1 : 0;
}

std::vector<VectorXd> speedUp(const VectorXd& velocities) {
  std::vector<VectorXd> commands;
  for (int i = 1; i <= 30; ++i) commands.emplace_back(std::min(1.0, 0.1 * i) * velocities);
  return commands;
}

void retreatFrom(const ArmLoop& held, const std::vector<VectorXd>& came, Random& random, Figures& figures) {
  retreat(held, speedUp(awayFrom(held.scene(), held.positions())), figures);
  std::vector<VectorXd> back;
  for (auto velocity = came.rbegin(); velocity != came.rend() && back.size() < 50; ++velocity)
    back.emplace_back(-*velocity);
  retreat(held, back, figures);
  for (int tries = 0, found = 0; tries < 300 && found < 4; ++tries) {
    const VectorXd velocities = velocitiesOf(*held.scene().arm().tree, random, 0.5);
    if (velocities.isZero() || !leadsAwayUntilRest(held.scene(), held.positions(), velocities)) continue;
    retreat(held, speedUp(velocities), figures);
    ++found;
  }
}

// Returns whether the arm runs into the obstacle.
bool run(ArmScene& scene, const std::vector<double>& home, const std::vector<Vector6d>& twists, bool guarded,
         Random& random, Figures& figures) {
  ArmLoop loop(scene, home, guarded);
  std::optional<ArmLoop> held;
  std::vector<VectorXd> came;
  std::vector<VectorXd> came_to_held;
  double least_scale = 0.5;
  for (const Vector6d& twist : twists) {
    const ArmLoop::Cycle cycle = loop.run(commandOf(scene, loop.positions(), twist));
    came.push_back(loop.velocity());
    if (guarded) figures.least_gap = std::min(figures.least_gap, cycle.least_gap);
    if (cycle.least_gap <= 0.0) return true;
    if (cycle.scale >= least_scale) continue;
    least_scale = cycle.scale;
    held.emplace(loop);
    came_to_held = came;
  }
  if (held) retreatFrom(*held, came_to_held, random, figures);
  return false;
}

// The obstacle is moved away from all of the path.
void runFree(const CapsuleArm& arm, const SentSurface& obstacle, const Path& path, const std::vector<Vector6d>& twists,
             Figures& figures) {
  ArmScene scene(arm, obstacle.movedBy(0.0, 0.0, 1.3));
  for (const auto& positions : path) {
    if (scene.gapAt(positions) <= ArmScene::kReach) return;
  }
  ArmLoop loop(scene, path[0], /*guarded=*/true);
  for (const Vector6d& twist : twists) {
    const double scale = loop.run(commandOf(scene, loop.positions(), twist)).scale;
    ++figures.free_commands;
    figures.free_changed += scale == 1.0 ? 0 : 1;
  }
}

void runPlacement(const CapsuleArm& arm, const std::vector<HandPose>& hand, Random& random, Figures& figures) {
  const double last = hand.back().time - 1e-2 * kCycles;
  const std::vector<Vector6d> twists = twistsOf(hand, random.uniform(hand.front().time, last));
  if (twists.size() < 200) return;
  std::vector<double> home = arm.home;
  for (double& position : home) position += random.uniform(-0.3, 0.3);
  const Path path = unguardedPath(arm, home, twists);
  const auto obstacle = obstacleOn(arm, path, random);
  if (!obstacle) return;
  ++figures.placements;
  ArmScene scene(arm, *obstacle);
  figures.met += run(scene, home, twists, /*guarded=*/false, random, figures) ? 1 : 0;
  figures.contacts += run(scene, home, twists, /*guarded=*/true, random, figures) ? 1 : 0;
  runFree(arm, *obstacle, path, twists, figures);
}

// 320 cases are those of doc/motion.md, and the most.
TEST(ArmClosedLoopTest, NoLinkRunsIntoWhatItRunsIntoWithoutTheGuard) {
  const std::filesystem::path data = dataPath("motion");
  if (!std::filesystem::exists(data)) GTEST_SKIP() << missing(data);
  std::vector<std::vector<HandPose>> hands;
  for (const char* name : {"handheld_vicon.txt", "robot_arm.txt", "handheld_stylus_15hz.txt",
                           "handheld_camera_fr2_desk.txt", "handheld_rig_room1.txt"})
    hands.push_back(readHand(data / name));
  const std::vector<CapsuleArm> arms = {ur5(), panda()};
  Figures figures;
  const std::uint64_t cases = std::min<std::uint64_t>(caseCount(4), 320);
  for (std::uint64_t i = 0; i < cases; ++i) {
    SCOPED_TRACE(i);
    Random random(1000 + i);
    runPlacement(arms[i % 2], hands[i / 2 % hands.size()], random, figures);
    EXPECT_EQ(figures.contacts, 0);
  }
  RecordProperty("placements", figures.placements);
  RecordProperty("met_without", figures.met);
  RecordProperty("contacts", figures.contacts);
  RecordProperty("least_gap_um", static_cast<int>(1e6 * figures.least_gap));
  RecordProperty("retreats", figures.retreats);
  RecordProperty("slowed_retreats", figures.slowed);
  RecordProperty("least_kept_ppm", static_cast<int>(1e6 * figures.least_kept));
  RecordProperty("free_commands", static_cast<int>(figures.free_commands));
  RecordProperty("free_changed", static_cast<int>(figures.free_changed));
  EXPECT_GT(figures.met, figures.placements / 2);
  EXPECT_GT(figures.least_gap, ArmLoop::options().standoff - 1e-4);
  EXPECT_LE(figures.slowed, figures.retreats / 500);
  EXPECT_GT(figures.least_kept, 0.75);
  EXPECT_GT(figures.free_commands, 0U);
  EXPECT_EQ(figures.free_changed, 0U);
}

}  // namespace
}  // namespace sweep_guard_core
