#include "sweep_guard/motion/moving_tool.h"

#include <algorithm>
#include <utility>

#include "kinematics/travel.h"
#include "sweep_guard/common/stamped_pose.h"

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
    pieces_.push_back({linkOf(tool, i, *tree_).value(), {}, {}, balls_.size()});
    balls_.resize(balls_.size() + tool.pieces[i].size());
    placePiece(i, state, tool.pieces[i], velocities);
  }
  for (const Ball& ball : balls_) fastest_ = std::max(fastest_, ball.speed);
}

void MovingTool::placeAgain(const RobotState& state, const ToolBalls& tool, const Eigen::VectorXd& velocities,
                            const std::vector<size_t>& pieces) {
  tree_->poses(state.positions, X_RL_);
  for (const size_t piece : pieces) placePiece(piece, state, tool.pieces[piece], velocities);
}

void MovingTool::placePiece(size_t piece, const RobotState& state, const std::vector<ToolBall>& balls_L,
                            const Eigen::VectorXd& velocities) {
  Piece& placed = pieces_[piece];
  placed.X_WL = state.X_WR * poseOf(placed.link, X_RL_);
  placed.twist_W = twistOf(placed.link, state.X_WR.linear(), velocities);
  for (size_t i = 0; i < balls_L.size(); ++i) {
    const Eigen::Vector3d from_origin_W = placed.X_WL.linear() * balls_L[i].center_T;
    const Eigen::Vector3d v_W = atPoint(placed.twist_W, from_origin_W).v_W;
    const double speed = v_W.norm() + placed.twist_W.w_W.norm() * balls_L[i].radius;
    balls_[placed.first_ball + i] = {placed.X_WL.translation() + from_origin_W, v_W, balls_L[i].radius, speed, 0.0};
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
