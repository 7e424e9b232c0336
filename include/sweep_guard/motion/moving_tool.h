#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "sweep_guard/kinematics/robot_motion.h"
#include "sweep_guard/motion/braking.h"
#include "sweep_guard/motion/plane_set.h"

namespace sweep_guard_core {

/// Returns the link of a tree that has the balls of a piece, or TreeLink::kRoot for those in the tool frame.
/// @returns empty if the tree has no such link
std::optional<size_t> linkOf(const ToolBalls& tool, size_t piece, const KinematicTree& tree);

/// Returns whether each piece has a link of the tree.
bool hasLinksOf(const KinematicTree& tree, const ToolBalls& tool);

/// Returns whether joints of the tree place the tool: it has each link, and each joint that the planes name.
bool isPlacedBy(const KinematicTree& tree, const PlaneSet& planes, const ToolBalls& tool);

/// The balls of a tool on the links of a robot, in one state, and how they move with the joints. The root and the tool frame
/// rest. Keeps its buffers between calls.
class MovingTool {
 public:
  /// A convex piece of the tool, in the frame of its link L.
  struct Piece {
    size_t link;  ///< of the tree
    Eigen::Isometry3d X_WL;
    Twist twist_W;      ///< of the origin of L
    size_t first_ball;  ///< index into balls(), in the order of ToolBalls
  };
  /// A ball of ToolBalls in motion.
  struct Ball {
    Eigen::Vector3d center_W;  ///< [m]
    Eigen::Vector3d v_W;       ///< of its center [m/s]
    double radius;             ///< [m]
    double speed;              ///< of its fastest point [m/s]
    double acceleration;       ///< bound on that of its center by boundAccelerations() [m/s^2]; 0 before
  };

  /// @param tree  its root is the tool frame
  explicit MovingTool(std::shared_ptr<const KinematicTree> tree);

  /// Places the tool, and lets the joints move there.
  /// @param tool        each piece has a link of the tree (linkOf())
  /// @param velocities  of each variable [rad/s or m/s]
  void place(const RobotState& state, const ToolBalls& tool, const Eigen::VectorXd& velocities);

  /// Places some pieces again; all others stay where they were.
  /// @param tool    as it was placed
  /// @param pieces  indices
  void placeAgain(const RobotState& state, const ToolBalls& tool, const Eigen::VectorXd& velocities,
                  const std::vector<size_t>& pieces);

  /// Bounds the acceleration of each ball while the joints go on at these velocities for a time.
  /// @param tool, velocities  as they were placed
  /// @param time              [s], >= 0
  void boundAccelerations(const ToolBalls& tool, const Eigen::VectorXd& velocities, double time);

  const std::vector<Piece>& pieces() const { return pieces_; }
  const std::vector<Ball>& balls() const { return balls_; }
  double fastest() const { return fastest_; }  ///< speed of the fastest point [m/s]

  /// Returns an upper bound on the displacement of any tool point from another state [m].
  double largestDisplacement(const MovingTool& from, const ToolBalls& tool) const;

 private:
  void placePiece(size_t piece, const RobotState& state, const std::vector<ToolBall>& balls_L,
                  const Eigen::VectorXd& velocities);
  Twist twistOf(size_t link, const Eigen::Matrix3d& R_WR, const Eigen::VectorXd& velocities);
  double accelerationOf(size_t link, const Eigen::Vector3d& p_L, const Eigen::VectorXd& velocities, double time) const;

  const std::shared_ptr<const KinematicTree> tree_;
  std::vector<Eigen::Isometry3d> X_RL_;
  Jacobian J_R_;
  std::vector<Piece> pieces_;
  std::vector<Ball> balls_;
  double fastest_ = 0.0;
};

}  // namespace sweep_guard_core
