#pragma once

#include <urdf_model/model.h>

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace sweep_guard_ros {

/// A robot as its URDF describes it, checked beyond what urdfdom checks: a tool must not lose a part in silence.
class RobotDescription {
 public:
  /// @throws sweep_guard_core::InvalidInput saying what is wrong where: no XML, larger than 8 MiB, refused by urdfdom, a
  ///     collision of several geometries, a link with two parents
  explicit RobotDescription(const std::string& urdf);

  const urdf::Link* link(const std::string& name) const;  ///< null: there is none
  const urdf::Link& root() const { return *model_->getRoot(); }
  bool hasJoint(const std::string& name) const { return model_->joints_.count(name) != 0; }

  /// The link and all links that hang on it, through joints of any kind, in the order of the description's tree.
  static std::vector<const urdf::Link*> below(const urdf::Link& link);

 private:
  friend class LinkPoses;
  std::shared_ptr<const urdf::ModelInterface> model_;
};

/// Where links are when every moving joint stands at a position [rad or m]: the one given, or else the one nearest to 0
/// that its limits allow. A joint that mimics another follows that.
class LinkPoses {
 public:
  /// @throws sweep_guard_core::InvalidInput if a position is not finite, or of a joint that there is not
  LinkPoses(const RobotDescription& robot, std::map<std::string, double> positions);

  /// Pose of a link L in the frame of a link F.
  /// @throws sweep_guard_core::InvalidInput naming the joint if one between them is beyond its limits, is given although it
  ///     mimics another, has no axis, or is of a kind that has no one position (planar, floating)
  Eigen::Isometry3d X_FL(const urdf::Link& frame, const urdf::Link& link);

  /// The moving joints that have been passed so far, and where they stand [rad or m].
  const std::map<std::string, double>& held() const { return held_; }

 private:
  std::vector<const urdf::Joint*> pathToRoot(const urdf::Link& link) const;
  Eigen::Isometry3d X_RL(const std::vector<const urdf::Joint*>& path, size_t above);
  Eigen::Isometry3d X_PC(const urdf::Joint& joint);
  double position(const urdf::Joint& joint, int depth = 0) const;

  const RobotDescription& robot_;
  std::map<std::string, double> positions_;
  std::map<std::string, double> held_;
};

/// @throws sweep_guard_core::InvalidInput if it is not finite
Eigen::Isometry3d fromUrdf(const urdf::Pose& pose);

}  // namespace sweep_guard_ros
