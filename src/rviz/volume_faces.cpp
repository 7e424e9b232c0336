#include "rviz/volume_faces.h"

#include <OgreQuaternion.h>

#include "rviz/ogre_conversions.h"

namespace sweep_guard_rviz {
namespace {

using Ogre::Vector3;

// {p : normal . p <= offset}, in the frame of the box.
struct Bound {
  Vector3 normal;
  float offset;

  float distance(const Vector3& p) const { return normal.dotProduct(p) - offset; }
};

std::vector<Bound> boundsOf(const sweep_guard::TestedVolume& volume) {
  const Vector3 half = toOgre(volume.half_extents);
  std::vector<Bound> bounds;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) {
      Vector3 normal = Vector3::ZERO;
      normal[static_cast<size_t>(axis)] = side;
      bounds.push_back({normal, half[static_cast<size_t>(axis)]});
    }
  }
  for (const shape_msgs::Plane& plane : volume.clips) {
    const Vector3 normal(static_cast<float>(plane.coef[0]), static_cast<float>(plane.coef[1]),
                         static_cast<float>(plane.coef[2]));
    bounds.push_back({normal, static_cast<float>(-plane.coef[3])});
  }
  return bounds;
}

Face squareOn(const Bound& bound, float half_side) {
  const Vector3 u = half_side * bound.normal.perpendicular();
  const Vector3 v = bound.normal.crossProduct(u);
  const Vector3 center = bound.offset * bound.normal;
  return {center - u - v, center + u - v, center + u + v, center - u + v};
}

Face cut(const Face& face, const Bound& bound) {
  Face kept;
  for (size_t i = 0; i < face.size(); ++i) {
    const Vector3& from = face[i];
    const Vector3& to = face[(i + 1) % face.size()];
    const float a = bound.distance(from);
    const float b = bound.distance(to);
    if (a <= 0.0F) kept.push_back(from);
    if ((a < 0.0F && b > 0.0F) || (a > 0.0F && b < 0.0F)) kept.push_back(from + a / (a - b) * (to - from));
  }
  return kept;
}

}  // namespace

std::vector<Face> facesOf(const sweep_guard::TestedVolume& volume) {
  const std::vector<Bound> bounds = boundsOf(volume);
  const float reach = 2.0F * toOgre(volume.half_extents).length();
  const Vector3 center = toOgre(volume.pose.position);
  const Ogre::Quaternion rotation = toOgre(volume.pose.orientation);
  std::vector<Face> faces;
  for (size_t i = 0; i < bounds.size(); ++i) {
    Face face = squareOn(bounds[i], reach);
    for (size_t j = 0; j < bounds.size() && !face.empty(); ++j) {
      if (j != i) face = cut(face, bounds[j]);
    }
    if (face.size() < 3) continue;
    for (Vector3& corner : face) corner = center + rotation * corner;
    faces.push_back(std::move(face));
  }
  return faces;
}

}  // namespace sweep_guard_rviz
