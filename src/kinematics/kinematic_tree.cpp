#include "sweep_guard/kinematics/kinematic_tree.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr double kUnitTolerance = 1e-9;

void check(const JointVariable& variable) {
  if (variable.lower <= variable.upper) return;  // false for NaN
  throw InvalidInput("joint '" + variable.name + "': its lower limit must not be above the upper one");
}

void check(const TreeLink& link, size_t index, size_t variables) {
  const auto refuse = [&](const std::string& reason) { throw InvalidInput("link '" + link.name + "': " + reason); };
  if (link.parent != TreeLink::kRoot && link.parent >= index) refuse("its parent must come before it");
  if (!link.X_PJ.matrix().allFinite()) refuse("the pose of its joint is not finite");
  if (link.type == JointType::kFixed) return;
  if (link.variable >= variables) refuse("its joint has no variable");
  if (!std::isfinite(link.multiplier) || !std::isfinite(link.offset)) refuse("how its joint follows is not finite");
  if (!(std::abs(link.axis_J.norm() - 1.0) <= kUnitTolerance)) refuse("the axis of its joint is not unit");
}

void check(const std::string& joint, const MimicJoint& mimic, size_t variables) {
  const auto refuse = [&](const std::string& reason) { throw InvalidInput("joint '" + joint + "': " + reason); };
  if (mimic.variable >= variables) refuse("it mimics no variable");
  if (!std::isfinite(mimic.multiplier) || !std::isfinite(mimic.offset)) refuse("how it follows is not finite");
}

bool slides(size_t variable, const JointVariable& joint, const std::vector<TreeLink>& links) {
  return std::any_of(links.begin(), links.end(), [&](const TreeLink& link) {
    return link.type == JointType::kPrismatic && link.variable == variable && link.joint == joint.name;
  });
}

Eigen::Isometry3d X_JL(const TreeLink& link, double position) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  if (link.type == JointType::kRevolute) X.linear() = Eigen::AngleAxisd(position, link.axis_J).toRotationMatrix();
  if (link.type == JointType::kPrismatic) X.translation() = position * link.axis_J;
  return X;
}

}  // namespace

KinematicTree::KinematicTree(std::vector<JointVariable> variables, std::vector<TreeLink> links,
                             std::map<std::string, MimicJoint> mimics)
    : variables_(std::move(variables)), links_(std::move(links)), mimics_(std::move(mimics)) {
  for (const JointVariable& variable : variables_) check(variable);
  for (const auto& [joint, mimic] : mimics_) check(joint, mimic, variables_.size());
  for (size_t i = 0; i < links_.size(); ++i) {
    const TreeLink& link = links_[i];
    check(link, i, variables_.size());
    const size_t body_above = link.parent == TreeLink::kRoot ? TreeLink::kRoot : bodies_[link.parent];
    bodies_.push_back(link.moves() ? i : body_above);
    if (link.type == JointType::kFixed || link.joint == variables_[link.variable].name) continue;
    mimics_[link.joint] = link;
  }
  for (size_t i = 0; i < variables_.size(); ++i) variables_[i].turns = !slides(i, variables_[i], links_);
}

std::vector<double> KinematicTree::nearestToZero() const {
  std::vector<double> positions;
  for (const JointVariable& variable : variables_) {
    positions.push_back(std::clamp(0.0, variable.lower, variable.upper));
  }
  return positions;
}

std::map<std::string, double> KinematicTree::jointPositions(const std::vector<double>& positions) const {
  std::map<std::string, double> joints;
  for (const TreeLink& link : links_) {
    if (link.type != JointType::kFixed) joints[link.joint] = link.at(positions);
  }
  return joints;
}

void KinematicTree::poses(const std::vector<double>& positions, std::vector<Eigen::Isometry3d>& X_RL) const {
  assert(positions.size() == variables_.size());
  X_RL.clear();
  for (const TreeLink& link : links_) {
    const Eigen::Isometry3d X_RJ = link.parent == TreeLink::kRoot ? link.X_PJ : X_RL[link.parent] * link.X_PJ;
    if (link.type == JointType::kFixed) {
      X_RL.push_back(X_RJ);
    } else {
      X_RL.push_back(X_RJ * X_JL(link, link.at(positions)));
    }
  }
}

void geometricJacobian(const KinematicTree& tree, const std::vector<Eigen::Isometry3d>& X_RL, size_t link,
                       Jacobian& J_R) {
  J_R.setZero(6, static_cast<Eigen::Index>(tree.variables().size()));
  const Eigen::Vector3d p_R = poseOf(link, X_RL).translation();
  for (size_t i = link; i != TreeLink::kRoot; i = tree.links()[i].parent) {
    const TreeLink& above = tree.links()[i];
    if (!above.moves()) continue;
    // The joint does not move its own axis: the pose of its link serves for that of the joint.
    const Eigen::Vector3d axis_R = above.multiplier * (X_RL[i].linear() * above.axis_J);
    auto column = J_R.col(static_cast<Eigen::Index>(above.variable));
    if (above.type == JointType::kPrismatic) {
      column.head<3>() += axis_R;
    } else {
      column.head<3>() += axis_R.cross(p_R - X_RL[i].translation());
      column.tail<3>() += axis_R;
    }
  }
}

}  // namespace sweep_guard_core
