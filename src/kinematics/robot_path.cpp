#include "sweep_guard/kinematics/robot_path.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <utility>

namespace sweep_guard_core {
namespace {

constexpr size_t kMaxParts = 1000;
constexpr size_t kMaxSweeps = 8192;

void add(const Robot& robot, const RobotState& state, RobotPath& path) {
  std::vector<Eigen::Isometry3d> X_WB;
  bodyPoses(robot.tree, robot.bodies, state, X_WB);
  for (size_t i = 0; i < X_WB.size(); ++i) path.bodies[i].X_WB.push_back(X_WB[i]);
}

}  // namespace

Robot robotOf(KinematicTree tree, const std::vector<std::pair<size_t, std::vector<ConvexPiece>>>& pieces) {
  std::vector<Eigen::Isometry3d> X_RL;
  tree.poses(tree.nearestToZero(), X_RL);
  std::map<size_t, std::vector<ConvexPiece>> pieces_of_bodies;
  for (const auto& [link, of_link] : pieces) {
    const size_t body = link == TreeLink::kRoot ? link : tree.bodyOf(link);
    const Eigen::Isometry3d X_BL = poseOf(body, X_RL).inverse() * poseOf(link, X_RL);
    for (const auto& [name, shape_L] : of_link) pieces_of_bodies[body].push_back({name, shape_L.placed(X_BL)});
  }
  Robot robot{std::move(tree), {}, {}};
  for (auto& [body, of_body] : pieces_of_bodies) {
    robot.tools.emplace_back(std::move(of_body));
    robot.bodies.push_back({body, robot.tools.back().boundingRadius()});
  }
  return robot;
}

double RobotPath::deviationBound() const {
  double largest = 0.0;
  for (const BodyPath& body : bodies) {
    for (const double bound : body.deviation_bounds) largest = std::max(largest, bound);
  }
  return largest;
}

RobotPath robotPath(const Robot& robot, const std::vector<RobotState>& states, double max_deviation) {
  assert(!states.empty());
  RobotPath path;
  path.bodies.resize(robot.bodies.size());
  add(robot, states.front(), path);
  const size_t max_parts = std::clamp<size_t>(kMaxSweeps / states.size(), 1, kMaxParts);
  for (size_t segment = 0; segment + 1 < states.size(); ++segment) {
    const RobotMotion motion(robot.tree, robot.bodies, states[segment], states[segment + 1]);
    const size_t parts = motion.partsFor(max_deviation, max_parts);
    const auto count = static_cast<double>(parts);
    for (size_t part = 1; part <= parts; ++part) {
      const double to = static_cast<double>(part) / count;
      path.places.push_back({segment, static_cast<double>(part - 1) / count, to});
      add(robot, part == parts ? states[segment + 1] : motion.at(to), path);
      for (size_t i = 0; i < robot.bodies.size(); ++i) {
        path.bodies[i].deviation_bounds.push_back(motion.deviationBound(i, parts));
      }
    }
  }
  return path;
}

}  // namespace sweep_guard_core
