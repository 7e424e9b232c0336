#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace sweep_guard_core {

enum class JointType { kFixed, kRevolute, kPrismatic };

/// The position of a joint, which others may mimic.
struct JointVariable {
  std::string name;                                         ///< of the joint
  double lower = -std::numeric_limits<double>::infinity();  ///< [rad or m]
  double upper = std::numeric_limits<double>::infinity();   ///< [rad or m], >= lower
  bool continuous = false;                                  ///< turns without end: positions a turn apart are the same
  double velocity = 0.0;  ///< largest by the robot description [rad/s or m/s]; 0: not known
  bool turns =
      true;  ///< its positions are angles; a KinematicTree finds that out. Joints that mimic it may move otherwise
};

/// A joint that follows a variable, which may be its own: it is at multiplier * variable + offset [rad or m].
struct MimicJoint {
  size_t variable = 0;
  double multiplier = 1.0;
  double offset = 0.0;

  /// Returns the position of the joint [rad or m].
  double at(const std::vector<double>& positions) const { return multiplier * positions[variable] + offset; }
};

/// A link L of a robot, and the joint that joins it to its parent P: L is where the joint frame J is, moved by the joint.
/// A fixed joint follows nothing.
struct TreeLink : MimicJoint {
  static constexpr size_t kRoot = std::numeric_limits<size_t>::max();

  std::string name;
  std::string joint;                                       ///< name
  size_t parent = kRoot;                                   ///< index, lower than that of this link; kRoot: the root R
  Eigen::Isometry3d X_PJ = Eigen::Isometry3d::Identity();  ///< translation [m]
  JointType type = JointType::kFixed;
  Eigen::Vector3d axis_J = Eigen::Vector3d::UnitZ();  ///< unit; of the rotation or the translation

  bool moves() const { return type != JointType::kFixed && multiplier != 0.0; }
};

/// The links of a robot that matter, and how its joints move them.
class KinematicTree {
 public:
  /// @param mimics  joints that mimic a variable and move no link, by name; those that move one may be left out
  /// @throws InvalidInput if a link comes before its parent, a joint has no variable, an axis is not unit, a number is not
  ///     finite, or limits are the wrong way round
  KinematicTree(std::vector<JointVariable> variables, std::vector<TreeLink> links,
                std::map<std::string, MimicJoint> mimics = {});

  const std::vector<JointVariable>& variables() const { return variables_; }
  const std::vector<TreeLink>& links() const { return links_; }
  /// Returns the joints that mimic a variable, by name, whether they move a link or not.
  const std::map<std::string, MimicJoint>& mimics() const { return mimics_; }

  /// Returns the index of the topmost link of the body of a link: joints within a body do not move. TreeLink::kRoot: the
  /// link moves with the root.
  size_t bodyOf(size_t link) const { return bodies_[link]; }

  /// Returns the position of each variable closest to 0 within its limits [rad or m].
  std::vector<double> nearestToZero() const;

  /// Returns the position of each moving joint by its name [rad or m], of those that mimic others, too.
  /// @param positions  one of each variable
  std::map<std::string, double> jointPositions(const std::vector<double>& positions) const;

  /// Computes the pose of each link in the root frame.
  /// @param positions   one of each variable [rad or m]; beyond the limits, too
  /// @param[out] X_RL   overwritten; its buffer is used again
  void poses(const std::vector<double>& positions, std::vector<Eigen::Isometry3d>& X_RL) const;

 private:
  std::vector<JointVariable> variables_;
  std::vector<TreeLink> links_;
  std::map<std::string, MimicJoint> mimics_;
  std::vector<size_t> bodies_;
};

/// Returns the pose of a link, or of the root, in the root frame.
/// @param X_RL  from KinematicTree::poses()
inline Eigen::Isometry3d poseOf(size_t link, const std::vector<Eigen::Isometry3d>& X_RL) {
  return link == TreeLink::kRoot ? Eigen::Isometry3d::Identity() : X_RL[link];
}

/// Of a link: velocity of its origin, then its angular velocity, both along the axes of the root frame R, per unit speed of
/// each variable. One column per variable: [m/rad or m/m], [rad/rad or rad/m].
using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Computes the geometric Jacobian of a link, or of the root, whose Jacobian is 0. Joints that mimic a variable count in its
/// column.
/// @param X_RL             from KinematicTree::poses()
/// @param[out] J_R         overwritten; its buffer is used again
void geometricJacobian(const KinematicTree& tree, const std::vector<Eigen::Isometry3d>& X_RL, size_t link,
                       Jacobian& J_R);

}  // namespace sweep_guard_core
