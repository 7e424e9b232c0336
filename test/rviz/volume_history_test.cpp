#include "rviz/volume_history.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sweep_guard_rviz {
namespace {

using Volumes = VolumeHistory::Volumes;

// Boxes of 4 x 2 x 2 with centers on the x axis.
Volumes boxesAt(const std::vector<double>& positions) {
  Volumes boxes(positions.size());
  for (size_t i = 0; i < boxes.size(); ++i) {
    boxes[i].pose.position.x = positions[i];
    boxes[i].half_extents.x = 2.0;
    boxes[i].half_extents.y = boxes[i].half_extents.z = 1.0;
  }
  return boxes;
}

std::vector<double> kept(const VolumeHistory& history) {
  std::vector<double> positions;
  for (const sweep_guard::TestedVolume& box : history.beside({})) positions.push_back(box.pose.position.x);
  return positions;
}

TEST(VolumeHistoryTest, KeepsAllVolumesOfOneSweep) {
  VolumeHistory history;
  history.add(boxesAt({0.0, 3.0, 6.0}), 10);
  EXPECT_EQ(kept(history), (std::vector<double>{0.0, 3.0, 6.0}));
}

TEST(VolumeHistoryTest, KeepsAllVolumesOfAFastTool) {
  VolumeHistory history;
  for (const double x : {0.0, 50.0, -50.0, 100.0}) history.add(boxesAt({x}), 10);
  EXPECT_EQ(kept(history), (std::vector<double>{0.0, 50.0, -50.0, 100.0}));
}

// A tool at rest has the same volumes again and again.
TEST(VolumeHistoryTest, KeepsEachVolumeOnce) {
  VolumeHistory history;
  for (int times = 0; times < 5; ++times) history.add(boxesAt({0.0, 3.0, 0.01}), 10);
  EXPECT_EQ(kept(history), (std::vector<double>{0.0, 3.0}));
}

TEST(VolumeHistoryTest, LeavesNoGapsForASlowTool) {
  VolumeHistory history;
  for (int i = 0; i <= 40; ++i) history.add(boxesAt({0.1 * i}), 100);
  const std::vector<double> positions = kept(history);
  ASSERT_GT(positions.size(), 2U);
  for (size_t i = 1; i < positions.size(); ++i) {
    EXPECT_GE(positions[i] - positions[i - 1], 1.0 - 1e-6);
    EXPECT_LE(positions[i] - positions[i - 1], 2.0);
  }
}

TEST(VolumeHistoryTest, KeepsTheNewestUpToTheLimit) {
  VolumeHistory history;
  for (const double x : {0.0, 10.0, 20.0, 30.0, 40.0}) history.add(boxesAt({x}), 3);
  EXPECT_EQ(kept(history), (std::vector<double>{20.0, 30.0, 40.0}));
  history.add({}, 1);
  EXPECT_EQ(kept(history), std::vector<double>{40.0});
  history.add(boxesAt({50.0}), 0);
  EXPECT_TRUE(kept(history).empty());
}

TEST(VolumeHistoryTest, TheNewestIsNotDrawnTwice) {
  VolumeHistory history;
  history.add(boxesAt({0.0, 3.0}), 10);
  const Volumes shown = history.beside(boxesAt({3.01}));
  ASSERT_EQ(shown.size(), 1U);
  EXPECT_EQ(shown[0].pose.position.x, 0.0);
}

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
