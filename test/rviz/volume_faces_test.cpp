#include "rviz/volume_history.h"

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

// The plane leaves x + y + z <= 2 of the cube: it cuts a triangle off the corner (1, 1, 1).
TEST(VolumeFacesTest, APlaneAcrossACornerCutsOffATriangle) {
  TestedVolume volume = box(1.0, 1.0, 1.0);
  volume.clips.emplace_back().coef = {std::sqrt(1.0 / 3.0), std::sqrt(1.0 / 3.0), std::sqrt(1.0 / 3.0),
                                      -std::sqrt(4.0 / 3.0)};
  const std::vector<Face> faces = facesOf(volume);
  ASSERT_EQ(faces.size(), 7U);
  ASSERT_EQ(faces.back().size(), 3U);
  for (const Ogre::Vector3& corner : faces.back()) EXPECT_NEAR(corner.x + corner.y + corner.z, 2.0F, 1e-6F);
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
