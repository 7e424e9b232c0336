#pragma once

#include <urdf_model/model.h>

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

namespace sweep_guard_ros {

/// Holds a robot from a URDF, with more checks than urdfdom's: no part of a tool may be lost silently.
class RobotDescription {
 public:
  /// @param uses_visuals  the tool is made of visual geometry, too
  /// @throws sweep_guard_core::InvalidInput if the text is no XML, is larger than 8 MiB or is refused by urdfdom; if a
  ///     collision, or a visual that may be used, has several geometries; if a link has two parents; or if it is not
  ///     connected to the root link
  explicit RobotDescription(const std::string& urdf, bool uses_visuals = false);

  const urdf::Link* link(const std::string& name) const;    ///< null if missing
  const urdf::Joint* joint(const std::string& name) const;  ///< null if missing
  const urdf::Link& root() const { return *model_->getRoot(); }

  /// Returns the link and all links below it, over joints of any type, in the order of the tree.
  static std::vector<const urdf::Link*> subtree(const urdf::Link& link);

 private:
  std::shared_ptr<const urdf::ModelInterface> model_;
};

/// @throws sweep_guard_core::InvalidInput if the pose is not finite
Eigen::Isometry3d fromUrdf(const urdf::Pose& pose);

}  // namespace sweep_guard_ros
