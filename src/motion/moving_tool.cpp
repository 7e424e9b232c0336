#include "sweep_guard/motion/moving_tool.h"

#include <algorithm>
#include <utility>

#include "kinematics/travel.h"
#include "sweep_guard/common/stamped_pose.h"
#include "sweep_guard/motion/motion_guard.h"

namespace sweep_guard_core {

std::optional<size_t> linkOf(const ToolBalls& tool, size_t piece, const KinematicTree& tree) {
  if (piece >= tool.frames.size() || tool.frames[piece].empty()) return TreeLink::kRoot;
  for (size_t link = 0; link < tree.links().size(); ++link) {
    if (tree.links()[link].name == tool.frames[piece]) return link;
  }
  return {};
}

bool hasLinksOf(const KinematicTree& tree, const ToolBalls& tool) {
  size_t piece = 0;
  while (piece < tool.pieces.size() && linkOf(tool, piece, tree)) ++piece;
  return piece == tool.pieces.size();
}

bool isPlacedBy(const KinematicTree& tree, const PlaneSet& planes, const ToolBalls& tool) {
  const auto& variables = tree.variables();
  const auto is_ours = [&](const std::string& name) {
    return std::any_of(variables.begin(), variables.end(), [&](const auto& joint) { return joint.name == name; });
  };
  const auto& joints = planes.joints;
  return !joints.empty() && std::all_of(joints.begin(), joints.end(), is_ours) && hasLinksOf(tree, tool);
}

MovingTool::MovingTool(std::shared_ptr<const KinematicTree> tree) : tree_(std::move(tree)) {}

void MovingTool::place(const RobotState& state, const ToolBalls& tool, const Eigen::VectorXd& velocities) {
  tree_->poses(state.positions, X_RL_);
  pieces_.clear();
  balls_.clear();
  fastest_ = 0.0;
  for (size_t i = 0; i < tool.pieces.size(); ++i) {
    const size_t link = linkOf(tool, i, *tree_).value();
    const Eigen::Isometry3d X_WL = state.X_WR * poseOf(link, X_RL_);
    pieces_.push_back({link, X_WL, twistOf(link, state.X_WR.linear(), velocities), balls_.size()});
    for (const ToolBall& ball : tool.pieces[i]) {
      const Twist center_W = atPoint(pieces_.back().twist_W, X_WL.linear() * ball.center_T);
      balls_.push_back({X_WL * ball.center_T, center_W.v_W.norm() + center_W.w_W.norm() * ball.radius, 0.0});
      fastest_ = std::max(fastest_, balls_.back().speed);
    }
  }
}

void MovingTool::boundAccelerations(const ToolBalls& tool, const Eigen::VectorXd& velocities, double time) {
  for (size_t i = 0; i < pieces_.size(); ++i) {
    for (size_t j = 0; j < tool.pieces[i].size(); ++j)
      balls_[pieces_[i].first_ball + j].acceleration =
          accelerationOf(pieces_[i].link, tool.pieces[i][j].center_T, velocities, time);
  }
}

Twist MovingTool::twistOf(size_t link, const Eigen::Matrix3d& R_WR, const Eigen::VectorXd& velocities) {
  geometricJacobian(*tree_, X_RL_, link, J_R_);
  const Vector6d velocity_R = J_R_.lazyProduct(velocities);
  return {R_WR * velocity_R.head<3>(), R_WR * velocity_R.tail<3>()};
}

// Within the time, the ball comes farther from the axis of a joint by its way seen from there, at most.
double MovingTool::accelerationOf(size_t link, const Eigen::Vector3d& p_L, const Eigen::VectorXd& velocities,
                                  double time) const {
  const Eigen::Vector3d p_R = poseOf(link, X_RL_) * p_L;
  Travel travel;
  for (size_t i = link; i != TreeLink::kRoot; i = tree_->links()[i].parent) {
    const TreeLink& joint = tree_->links()[i];
    if (!joint.moves()) continue;
    const double speed = std::abs(joint.multiplier * velocities[static_cast<Eigen::Index>(joint.variable)]);
    if (joint.type == JointType::kPrismatic) {
      travel.addSlide(speed);
    } else {
      travel.addTurn(speed, distanceFromAxis(p_R, X_RL_[i], joint.axis_J) + time * travel.path);
    }
  }
  return travel.curvature;
}

double MovingTool::largestDisplacement(const MovingTool& from, const ToolBalls& tool) const {
  double largest = 0.0;
  for (size_t i = 0; i < pieces_.size(); ++i) {
    const double turned = (pieces_[i].X_WL.linear() - from.pieces_[i].X_WL.linear()).norm();
    for (size_t j = 0; j < tool.pieces[i].size(); ++j) {
      const size_t ball = pieces_[i].first_ball + j;
      const double moved = (balls_[ball].center_W - from.balls_[ball].center_W).norm();
      largest = std::max(largest, moved + turned * tool.pieces[i][j].radius);
    }
  }
  return largest;
}

}  // namespace sweep_guard_core
