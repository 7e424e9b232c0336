#pragma once

#include <OgreQuaternion.h>
#include <OgreVector.h>
#include <geometry_msgs/Pose.h>

namespace sweep_guard_rviz {

/// Points and vectors alike.
template <typename Vector>
Ogre::Vector3 toOgre(const Vector& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// A message whose quaternion is all zero turns nothing.
inline Ogre::Quaternion toOgre(const geometry_msgs::Quaternion& q) {
  Ogre::Quaternion rotation(static_cast<float>(q.w), static_cast<float>(q.x), static_cast<float>(q.y),
                            static_cast<float>(q.z));
  return rotation.normalise() > 0.0F ? rotation : Ogre::Quaternion::IDENTITY;
}

}  // namespace sweep_guard_rviz
