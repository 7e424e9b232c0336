#pragma once

#include <urdf_model/model.h>

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace sweep_guard_ros {

/// Holds a robot from a URDF, with more checks than urdfdom's: no part of a tool may be lost silently.
class RobotDescription {
 public:
  /// @throws sweep_guard_core::InvalidInput if the text is no XML, is larger than 8 MiB or is refused by urdfdom; if a
  ///     collision has several geometries; if a link has two parents; or if it is not connected to the root link
  explicit RobotDescription(const std::string& urdf);

  const urdf::Link* link(const std::string& name) const;  ///< null if missing
  const urdf::Link& root() const { return *model_->getRoot(); }
  bool hasJoint(const std::string& name) const { return model_->joints_.count(name) != 0; }

  /// Returns the link and all links below it, over joints of any type, in the order of the tree.
  static std::vector<const urdf::Link*> subtree(const urdf::Link& link);

 private:
  friend class LinkPoses;
  std::shared_ptr<const urdf::ModelInterface> model_;
};

/// Computes poses of links. Every moving joint has a position [rad or m]: the given one, or else the one closest to 0
/// within its limits. A joint that mimics another one follows it.
class LinkPoses {
 public:
  /// @throws sweep_guard_core::InvalidInput if a position is not finite, or its joint does not exist
  LinkPoses(const RobotDescription& robot, std::map<std::string, double> positions);

  /// Returns the pose of a link L in the frame of a link F.
  /// @throws sweep_guard_core::InvalidInput naming a joint between them that is beyond its limits, is given although it
  ///     mimics another one, has no axis, or is planar or floating
  Eigen::Isometry3d X_FL(const urdf::Link& frame, const urdf::Link& link);

  /// Returns the positions [rad or m] of the moving joints used by X_FL().
  const std::map<std::string, double>& joints() const { return joints_; }

 private:
  std::vector<const urdf::Joint*> pathToRoot(const urdf::Link& link) const;
  Eigen::Isometry3d X_RL(const std::vector<const urdf::Joint*>& path, size_t above);
  Eigen::Isometry3d X_PC(const urdf::Joint& joint);
  double position(const urdf::Joint& joint, int depth = 0) const;

  const RobotDescription& robot_;
  std::map<std::string, double> positions_;
  std::map<std::string, double> joints_;
};

/// @throws sweep_guard_core::InvalidInput if the pose is not finite
Eigen::Isometry3d fromUrdf(const urdf::Pose& pose);

}  // namespace sweep_guard_ros
