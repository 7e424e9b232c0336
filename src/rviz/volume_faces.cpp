#include "rviz/volume_faces.h"

#include "rviz/ogre_conversions.h"
#include "sweep_guard/geometry/half_space.h"

namespace sweep_guard_rviz {
namespace {

using sweep_guard_core::HalfSpace;

std::vector<HalfSpace> halfSpaces_B(const sweep_guard::TestedVolume& volume) {
  const Eigen::Vector3d half_extents(volume.half_extents.x, volume.half_extents.y, volume.half_extents.z);
  std::vector<HalfSpace> half_spaces;
  for (int axis = 0; axis < 3; ++axis) {
    half_spaces.emplace_back(Eigen::Vector3d::Unit(axis), half_extents[axis]);
    half_spaces.emplace_back(-Eigen::Vector3d::Unit(axis), half_extents[axis]);
  }
  for (const shape_msgs::Plane& plane : volume.clips) {
    const Eigen::Vector3d normal(plane.coef[0], plane.coef[1], plane.coef[2]);
    if (normal.norm() > 1e-9) half_spaces.emplace_back(normal, -plane.coef[3] / normal.norm());
  }
  return half_spaces;
}

}  // namespace

std::vector<Face> facesOf(const sweep_guard::TestedVolume& volume) {
  const Ogre::Vector3 center = toOgre(volume.pose.position);
  const Ogre::Quaternion rotation = toOgre(volume.pose.orientation);
  const double radius = static_cast<double>(toOgre(volume.half_extents).length());
  std::vector<Face> faces;
  for (const sweep_guard_core::Polygon& polygon_B : sweep_guard_core::polytopeFaces(halfSpaces_B(volume), radius)) {
    Face& face = faces.emplace_back();
    for (const Eigen::Vector3d& corner_B : polygon_B) face.push_back(center + rotation * toOgre(corner_B));
  }
  return faces;
}

}  // namespace sweep_guard_rviz
