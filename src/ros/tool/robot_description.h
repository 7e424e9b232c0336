#pragma once

#include <urdf_model/model.h>

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ros/tool/link_geometry.h"

namespace sweep_guard_ros {

/// Holds a robot from a URDF, with more checks than urdfdom's: no part of a tool may be lost silently. Of each link, it reads the
/// geometry that a tool is made of, and passes over the other kind.
class RobotDescription {
 public:
  /// @throws sweep_guard_core::InvalidInput if the text is no XML, is larger than 8 MiB, is for xacro or is refused by urdfdom; if a
  ///     collision or visual that is read has no geometry; if a link has two parents; or if it is not connected to the root link
  explicit RobotDescription(const std::string& urdf, LinkGeometry geometry = LinkGeometry::kCollision);

  const urdf::Link* link(const std::string& name) const;    ///< null if missing
  const urdf::Joint* joint(const std::string& name) const;  ///< null if missing
  const urdf::Link& root() const { return *model_->getRoot(); }

  bool isMadeOfVisuals(const urdf::Link& link) const { return elements_.at(link.name).visual_is_read; }
  /// Returns whether the description has no geometry of the link, of neither kind. Some give links that only join others a
  /// visual box of size 0.
  bool hasNoShape(const urdf::Link& link) const { return !elements_.at(link.name).has_shape; }
  /// @throws sweep_guard_core::InvalidInput if a collision or visual that is read has several geometries: urdfdom takes the
  ///     first one
  void requireOneGeometryEach(const urdf::Link& link) const;

  /// Returns the link and all links below it, over joints of any type, in the order of the tree.
  static std::vector<const urdf::Link*> subtree(const urdf::Link& link);

 private:
  std::map<std::string, LinkElements> elements_;  // by link; before the model, which is read with it
  std::shared_ptr<const urdf::ModelInterface> model_;
};

/// @throws sweep_guard_core::InvalidInput if the pose is not finite
Eigen::Isometry3d fromUrdf(const urdf::Pose& pose);

}  // namespace sweep_guard_ros
