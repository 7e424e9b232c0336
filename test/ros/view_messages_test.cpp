#include "ros/output/view_messages.h"

#include <gtest/gtest.h>

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::WarningLevel;

const sweep_guard_core::Tool kTool = sweep_guard_core::Tool::cylinder(0.01, 0.1, 8);

std::shared_ptr<const sweep_guard_core::Workpiece> square() {
  const sweep_guard_core::TriangleMesh mesh_M({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}});
  return std::make_shared<const sweep_guard_core::Workpiece>(
      sweep_guard_core::Workpiece{"square", /*revision=*/7, {}, {}, "table", mesh_M});
}

MarkerScene touching() {
  auto report = std::make_shared<sweep_guard_core::SweepReport>();
  sweep_guard_core::SweptObject& object = report->objects.emplace_back();
  object.workpiece = square();
  object.result.not_ruled_out = {1};
  sweep_guard_core::SweptVolume& volume = object.result.volumes_M.emplace_back();
  volume.box.half_extents = {0.1, 0.2, 0.3};
  volume.clips_B.push_back(sweep_guard_core::HalfSpace(Eigen::Vector3d(0.0, 0.6, 0.8), 0.25));

  auto prediction = std::make_shared<sweep_guard_core::Prediction>();
  sweep_guard_core::PredictedObject& expected = prediction->objects.emplace_back();
  expected.workpiece = object.workpiece;
  expected.considered = {0};

  MarkerScene scene;
  scene.tool = std::make_shared<const sweep_guard_core::Tool>(kTool);
  scene.newest = report;
  scene.contact = report;
  scene.prediction = prediction;
  scene.warning.level = WarningLevel::kContact;
  return scene;
}

TEST(ViewTest, ShowsSweepsContactsAndPrediction) {
  const sweep_guard::View view = toMsg(touching());
  ASSERT_EQ(view.objects.size(), 1U);
  const sweep_guard::ObjectView& object = view.objects[0];
  EXPECT_EQ(object.mesh_id, "square");
  EXPECT_EQ(object.revision, 7U);
  EXPECT_EQ(object.frame_id, "table");
  EXPECT_EQ(object.touched, std::vector<std::uint32_t>{1});
  EXPECT_EQ(object.considered, std::vector<std::uint32_t>{0});
  EXPECT_EQ(view.level, static_cast<std::uint8_t>(WarningLevel::kContact));
}

TEST(ViewTest, AContactThatTheWarningDoesNotSpeakOfIsNotDrawn) {
  constexpr auto kHold = std::chrono::milliseconds(500);
  sweep_guard_core::WarningLimits limits{};
  limits.hold_time = kHold;
  MarkerScene scene = touching();
  scene.warning.mesh_id = "square";
  EXPECT_TRUE(isOfWarning(scene, limits));
  scene.warning.mesh_id = "spleen";
  EXPECT_FALSE(isOfWarning(scene, limits));

  scene.warning.mesh_id = "square";
  auto later = std::make_shared<sweep_guard_core::SweepReport>();
  later->end = scene.contact->end + kHold;
  scene.newest = later;
  EXPECT_TRUE(isOfWarning(scene, limits));
  later->end += std::chrono::milliseconds(101);
  EXPECT_FALSE(isOfWarning(scene, limits));
  scene.contact.reset();
  EXPECT_FALSE(isOfWarning(scene, limits));
}

TEST(ViewTest, AClipIsNegativeInside) {
  const sweep_guard::View view = toMsg(touching());
  ASSERT_EQ(view.objects[0].measured.size(), 1U);
  const sweep_guard::TestedVolume& volume = view.objects[0].measured[0];
  EXPECT_EQ(volume.half_extents.z, 0.3);
  ASSERT_EQ(volume.clips.size(), 1U);
  EXPECT_NEAR(volume.clips[0].coef[2], 0.8, 1e-12);
  EXPECT_EQ(volume.clips[0].coef[3], -0.25);
}

TEST(ViewTest, ShowsNoContactThatIsOver) {
  MarkerScene scene = touching();
  scene.warning.level = WarningLevel::kClear;
  EXPECT_TRUE(toMsg(scene).objects[0].touched.empty());
}

TEST(ViewTest, SaysWhatIsHeldAndSinceWhenAndWhatIsAcknowledged) {
  MarkerScene scene = touching();
  EXPECT_FALSE(toMsg(scene).held || toMsg(scene).acknowledged);
  scene.warning.held_since = sweep_guard_core::Time(std::chrono::seconds(7));
  scene.warning.acknowledged = true;
  const sweep_guard::View view = toMsg(scene);
  EXPECT_TRUE(view.held && view.acknowledged);
  EXPECT_EQ(view.held_since, ros::Time(7.0));
}

TEST(ViewTest, IsEmptyBeforeTheFirstSweep) {
  const sweep_guard::View view = toMsg(MarkerScene());
  EXPECT_TRUE(view.header.stamp.isZero());
  EXPECT_TRUE(view.objects.empty());
  EXPECT_TRUE(view.path.empty());
  EXPECT_EQ(view.level, static_cast<std::uint8_t>(WarningLevel::kUnknown));
}

TEST(ToolShapeTest, HasTheSurfaceOfEveryPiece) {
  const sweep_guard::ToolShape shape = toMsg(std::vector<sweep_guard_core::Tool>{kTool});
  ASSERT_EQ(shape.parts.size(), 1U);
  EXPECT_EQ(shape.parts[0].triangles.size(), kTool.pieces()[0].shape_T.mesh_T().triangles().size());
  EXPECT_EQ(shape.links, std::vector<std::string>{""});
}

}  // namespace
}  // namespace sweep_guard_ros
