#include "sweep_guard/kinematics/robot_motion.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "kinematics/travel.h"
#include "sweep_guard/geometry/motion.h"

namespace sweep_guard_core {
namespace {

// A distance that is known at both ends, and changes by at most `path` in between.
double largestBetween(double start, double end, double path) { return 0.5 * (start + end + path); }

}  // namespace

RobotMotion::RobotMotion(const KinematicTree& tree, const std::vector<RobotBody>& bodies, const RobotState& from,
                         const RobotState& to)
    : tree_(tree), from_(from), to_(to) {
  tree_.poses(from_.positions, X_RL_start_);
  tree_.poses(to_.positions, X_RL_end_);
  for (const RobotBody& body : bodies) deviations_.push_back(deviationInOnePart(body));
}

double RobotMotion::deviationInOnePart(const RobotBody& body) const {
  const Eigen::Vector3d start = poseOf(body.link, X_RL_start_).translation();
  const Eigen::Vector3d end = poseOf(body.link, X_RL_end_).translation();
  Travel travel;
  for (size_t i = body.link; i != TreeLink::kRoot; i = tree_.links()[i].parent) {
    const TreeLink& link = tree_.links()[i];
    if (!link.moves()) continue;
    const double moved = std::abs(link.at(to_.positions) - link.at(from_.positions));
    if (link.type == JointType::kPrismatic) {
      travel.addSlide(moved);
      continue;
    }
    // The joint turns about an axis that it does not move: the pose of its link serves for that of the joint.
    const double at_start = distanceFromAxis(start, X_RL_start_[i], link.axis_J);
    const double at_end = distanceFromAxis(end, X_RL_end_[i], link.axis_J);
    travel.addTurn(moved, largestBetween(at_start, at_end, travel.path) + body.radius);
  }
  const double root_turn = Motion{from_.X_WR, to_.X_WR}.angle();
  travel.addTurn(root_turn, largestBetween(start.norm(), end.norm(), travel.path) + body.radius);
  return travel.curvature / 8.0 + chordError(body.radius, travel.turn);
}

double RobotMotion::deviationBound(size_t body, size_t parts) const {
  assert(parts >= 1);
  const auto divisor = static_cast<double>(parts);
  return deviations_[body] / (divisor * divisor);
}

size_t RobotMotion::partsFor(double max_deviation, size_t most) const {
  assert(max_deviation > 0.0);
  double largest = 0.0;
  for (const double deviation : deviations_) largest = std::max(largest, deviation);
  const double parts = std::ceil(std::sqrt(largest / max_deviation));
  return parts >= static_cast<double>(most) ? most : std::max<size_t>(1, static_cast<size_t>(parts));
}

RobotState RobotMotion::at(double fraction) const {
  RobotState state{Motion{from_.X_WR, to_.X_WR}.at(fraction), from_.positions};
  for (size_t i = 0; i < state.positions.size(); ++i) {
    state.positions[i] += fraction * (to_.positions[i] - from_.positions[i]);
  }
  return state;
}

void bodyPoses(const KinematicTree& tree, const std::vector<RobotBody>& bodies, const RobotState& state,
               std::vector<Eigen::Isometry3d>& X_WB) {
  std::vector<Eigen::Isometry3d> X_RL;
  tree.poses(state.positions, X_RL);
  X_WB.clear();
  for (const RobotBody& body : bodies) {
    X_WB.push_back(state.X_WR * poseOf(body.link, X_RL));
  }
}

}  // namespace sweep_guard_core
