#include "ros/scene/scene_file.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>

#include "refusal.h"

namespace sweep_guard_ros {
namespace {

std::string refusalOf(const std::string& scene) {
  return refusal([&] { readScene(scene); });
}

Eigen::AlignedBox3d boundsOf(const sweep_guard_core::SceneObject& object) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : object.surface_M.vertices) box.extend(vertex);
  return box;
}

TEST(SceneFileTest, AnObjectHasItsShapeItsPlaceAndItsFrame) {
  const Scene scene = readScene("{table: {box: [2, 4, 6], position: [1, 2, 3], frame: base, open: true}}");
  ASSERT_EQ(scene.objects.size(), 1U);
  EXPECT_EQ(scene.objects[0].id, "table");
  EXPECT_EQ(scene.objects[0].frame, "base");
  EXPECT_TRUE(scene.objects[0].open);
  EXPECT_TRUE(
      boundsOf(scene.objects[0]).isApprox(Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(2, 4, 6))));
}

// As in a URDF: first about x, then about the fixed y and z.
TEST(SceneFileTest, RollPitchAndYawTurnAboutFixedAxes) {
  const Scene scene = readScene("{a: {box: [2, 4, 6], rpy: [1.5707963267948966, 0, 1.5707963267948966]}}");
  EXPECT_TRUE(boundsOf(scene.objects[0]).sizes().isApprox(Eigen::Vector3d(6, 2, 4), 1e-9));
  EXPECT_EQ(scene.objects[0].frame, "world");
}

TEST(SceneFileTest, ATopicHasWhatTheSceneSaysOfIt) {
  const Scene scene = readScene(
      "{environment: [{topic: /a}, {topic: b, id: wall, frame: map, namespaces: [x, y], hold: true, service: /s}, "
      "{topic: /c, stream: true}]}");
  ASSERT_EQ(scene.topics.size(), 3U);
  EXPECT_EQ(scene.topics[0].topic, "/a");
  EXPECT_FALSE(scene.topics[0].holds);
  EXPECT_EQ(scene.topics[1].id, "wall");
  EXPECT_EQ(scene.topics[1].frame, "map");
  EXPECT_EQ(scene.topics[1].namespaces, (std::set<std::string>{"x", "y"}));
  EXPECT_TRUE(scene.topics[1].holds);
  EXPECT_EQ(scene.topics[1].service, "/s");
  EXPECT_FALSE(scene.topics[1].streams);
  EXPECT_TRUE(scene.topics[2].streams);
  EXPECT_TRUE(scene.objects.empty());
}

TEST(SceneFileTest, AMeshIsSoughtFromTheFolderOfTheScene) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "sweep_guard_scene_file_test";
  std::filesystem::create_directories(folder);
  std::filesystem::copy_file(SWEEP_GUARD_SOURCE_DIR "/test/ros/block.stl", folder / "block.stl",
                             std::filesystem::copy_options::overwrite_existing);
  std::ofstream(folder / "scene.yaml") << "block: {mesh: block.stl, scale: [0.001, 0.002, 0.003]}\n";
  const Scene scene = readScene((folder / "scene.yaml").string());
  EXPECT_TRUE(boundsOf(scene.objects.at(0)).sizes().isApprox(Eigen::Vector3d(0.1, 0.2, 0.3), 1e-9));
  EXPECT_EQ(scene.objects[0].surface_M.vertices.size(), 8U);
  std::filesystem::remove_all(folder);
}

TEST(SceneFileTest, WhatIsWrongIsRefusedWithItsLineAndWhatIsWanted) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"{a: {box: [1, 2]}}", "'a': line 1: must be [x, y, z]"},
      {"{a: {sphere: 1, position: [1, 1]}}", "'a': line 1: must be a position [x, y, z]"},
      {"{a: {sphere: 1, rpy: [0, 0, 90]}}", "'a': line 1: must be the angles [roll, pitch, yaw] [rad]"},
      {"{a: {box: [1, 2, .nan]}}", "each within +-1e6"},
      {"{a: {box: [1, 2, -1]}}", "'a': "},
      {"{a: {frame: world}}", "has no shape: give it a box"},
      {"{a: {sphere: 1, box: [1, 1, 1]}}", "has two shapes"},
      {"{a: {sphere: 1, postion: [1, 1, 1]}}", "'postion' is unknown"},
      {"{a: {sphere: 1, scale: 2}}", "only a mesh has a scale"},
      {"{a: {mesh: " SWEEP_GUARD_SOURCE_DIR "/test/ros/block.stl, scale: 0}}",
       "a scale, or [x, y, z], within 1e-6 and"},
      {"{a: {mesh: " SWEEP_GUARD_SOURCE_DIR "/test/ros/block.stl, scale: [1, .nan, 1]}}", "must be a scale"},
      {"{a: {mesh: /none.stl}}", "cannot be opened"},
      {"{a: {mesh: package://none/a.stl}}", "no package 'none'"},
      {"{a: {sphere: 1}, a: {sphere: 2}}", "this id was there before"},
      {"{a: 3}", "must be a group"},
      {"{environment: {topic: /a}}", "must be a list of topics"},
      {"{environment: [{topic: /a}, {topic: /a}]}", "this topic was there before"},
      {"{environment: [{topic: 'a b'}]}", "names no topic"},
      {"{environment: [{topic: /a, holds: true}]}", "'holds' is unknown"},
      {"{a: ", "scene: "},
      {"none.yaml", "none.yaml: No such file or directory: give an absolute path"}};
  for (const auto& [scene, words] : cases)
    EXPECT_TRUE(has(refusalOf(scene), words)) << scene << ": " << refusalOf(scene);
}

TEST(SceneFileTest, ASceneHasAThousandWorkpiecesAtMost) {
  std::string scene = "{";
  for (int i = 1; i <= 1000; ++i) scene += std::to_string(i) + ": {sphere: 1}, ";
  EXPECT_EQ(readScene(scene + "}").objects.size(), 1000U);
  EXPECT_TRUE(has(refusalOf(scene + "more: {sphere: 1}}"), "must be a group of 1 to 1000 workpieces"));
}

TEST(SceneFileTest, AFileOfMoreThanOneMebibyteIsRefused) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "sweep_guard_large_scene.yaml";
  std::ofstream(file) << "{a: {sphere: 1}}\n#" << std::string(1U << 20U, ' ');
  EXPECT_TRUE(has(refusalOf(file.string()), "larger than 1 MiB"));
  std::filesystem::resize_file(file, 1U << 20U);
  EXPECT_EQ(refusalOf(file.string()), "");
  std::filesystem::remove(file);
}

TEST(SceneFileTest, AnEmptySceneIsOne) { EXPECT_TRUE(readScene("{}").objects.empty()); }

}  // namespace
}  // namespace sweep_guard_ros
