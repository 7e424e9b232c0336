#include "rviz/volume_faces.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sweep_guard_rviz {
namespace {

using sweep_guard::TestedVolume;

TestedVolume box(double x, double y, double z) {
  TestedVolume volume;
  volume.half_extents.x = x;
  volume.half_extents.y = y;
  volume.half_extents.z = z;
  volume.pose.orientation.w = 1.0;
  return volume;
}

void clip(TestedVolume& volume, double x, double y, double z, double offset) {
  const double length = std::hypot(x, y, z);
  volume.clips.emplace_back().coef = {x / length, y / length, z / length, -offset};
}

// Of a closed convex body with outward faces: the sum of pyramids from an inner point.
float volumeOf(const std::vector<Face>& faces, const Ogre::Vector3& inside) {
  float sum = 0.0F;
  for (const Face& face : faces) {
    for (size_t i = 2; i < face.size(); ++i) {
      const Ogre::Vector3 a = face[0] - inside;
      sum += std::abs(a.dotProduct((face[i - 1] - inside).crossProduct(face[i] - inside))) / 6.0F;
    }
  }
  return sum;
}

TEST(VolumeFacesTest, ABoxHasSixFacesOfFourCorners) {
  const std::vector<Face> faces = facesOf(box(0.1, 0.2, 0.3));
  ASSERT_EQ(faces.size(), 6U);
  for (const Face& face : faces) EXPECT_EQ(face.size(), 4U);
  EXPECT_NEAR(volumeOf(faces, Ogre::Vector3::ZERO), 0.2F * 0.4F * 0.6F, 1e-6F);
}

// The corner beyond x + y + z = 2 of the cube with half side 1 is a tetrahedron with three edges of 1.
TEST(VolumeFacesTest, APlaneAcrossACornerCutsOffATriangle) {
  TestedVolume volume = box(1.0, 1.0, 1.0);
  clip(volume, 1.0, 1.0, 1.0, 2.0 / std::sqrt(3.0));
  const std::vector<Face> faces = facesOf(volume);
  ASSERT_EQ(faces.size(), 7U);
  EXPECT_EQ(faces.back().size(), 3U);
  EXPECT_NEAR(volumeOf(faces, Ogre::Vector3::ZERO), 8.0F - 1.0F / 6.0F, 1e-5F);
}

TEST(VolumeFacesTest, APlaneThatCutsNothingOffHasNoFace) {
  TestedVolume volume = box(1.0, 1.0, 1.0);
  clip(volume, 1.0, 1.0, 1.0, 5.0);
  EXPECT_EQ(facesOf(volume).size(), 6U);
}

TEST(VolumeFacesTest, NothingIsLeftBeyondAPlaneThatCutsEverythingOff) {
  TestedVolume volume = box(1.0, 1.0, 1.0);
  clip(volume, 1.0, 0.0, 0.0, -2.0);
  EXPECT_TRUE(facesOf(volume).empty());
}

TEST(VolumeFacesTest, FacesAreWhereTheBoxIs) {
  TestedVolume volume = box(0.1, 0.1, 0.1);
  volume.pose.position.x = 5.0;
  volume.pose.orientation.w = volume.pose.orientation.z = std::sqrt(0.5);
  for (const Face& face : facesOf(volume)) {
    for (const Ogre::Vector3& corner : face) EXPECT_NEAR(corner.x, 5.0F, 0.1001F);
  }
}

}  // namespace
}  // namespace sweep_guard_rviz
