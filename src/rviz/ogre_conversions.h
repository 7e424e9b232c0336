#pragma once

#include <OgreQuaternion.h>
#include <geometry_msgs/Pose.h>
#include <shape_msgs/MeshTriangle.h>

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "rviz/ogre_vector.h"

namespace sweep_guard_rviz {

/// Converts a point or a vector message.
template <typename Vector>
Ogre::Vector3 toOgre(const Vector& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

inline Ogre::Vector3 toOgre(const Eigen::Vector3d& v) { return Ogre::Vector3(v.cast<float>().eval().data()); }

/// Converts a rotation; a quaternion of four zeros becomes the identity.
inline Ogre::Quaternion toOgre(const geometry_msgs::Quaternion& q) {
  Ogre::Quaternion rotation(static_cast<float>(q.w), static_cast<float>(q.x), static_cast<float>(q.y),
                            static_cast<float>(q.z));
  return rotation.normalise() > 0.0F ? rotation : Ogre::Quaternion::IDENTITY;
}

/// Returns whether all vertex indices are below the number of vertices.
inline bool indicesInRange(const std::vector<shape_msgs::MeshTriangle>& triangles, size_t vertices) {
  return std::all_of(triangles.begin(), triangles.end(), [&](const shape_msgs::MeshTriangle& triangle) {
    const auto& corners = triangle.vertex_indices;
    return std::all_of(corners.begin(), corners.end(), [&](auto corner) { return corner < vertices; });
  });
}

}  // namespace sweep_guard_rviz
