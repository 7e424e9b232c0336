#include "rviz/volume_history.h"

#include <algorithm>
#include <iterator>

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

using sweep_guard::TestedVolume;

// Nearer than half the least width.
bool isNear(const TestedVolume& volume, const TestedVolume& other) {
  const auto& half = volume.half_extents;
  const auto reach = static_cast<float>(std::min({half.x, half.y, half.z}));
  return toOgre(volume.pose.position).distance(toOgre(other.pose.position)) < reach;
}

template <typename Volumes>
bool isNearAny(const TestedVolume& volume, const Volumes& others) {
  return std::any_of(others.begin(), others.end(), [&](const TestedVolume& other) { return isNear(volume, other); });
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

void VolumeHistory::add(const Volumes& volumes, size_t max_count) {
  for (const TestedVolume& volume : volumes) {
    if (!isNearAny(volume, kept_)) kept_.push_back(volume);
  }
  while (kept_.size() > max_count) kept_.pop_front();
}

VolumeHistory::Volumes VolumeHistory::beside(const Volumes& newest) const {
  Volumes shown;
  std::copy_if(kept_.begin(), kept_.end(), std::back_inserter(shown),
               [&](const TestedVolume& volume) { return !isNearAny(volume, newest); });
  return shown;
}

}  // namespace sweep_guard_rviz
