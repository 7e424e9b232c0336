#include "ros/output/marker_shapes.h"

#include <gtest/gtest.h>

#include <set>

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::ConvexShape;
using sweep_guard_core::Tool;
using visualization_msgs::Marker;

Marker drawingOf(int index) {
  Marker drawing = marker("tool", index, Marker::CYLINDER, "world", {});
  drawing.color = color(0.4, 0.5, 0.9, 0.8);
  return drawing;
}

std::vector<Marker> draw(const Tool& tool, int index, const Eigen::Isometry3d& X_WT = Eigen::Isometry3d::Identity()) {
  visualization_msgs::MarkerArray array;
  addTool(array, drawingOf(index), {tool}, {X_WT});
  return array.markers;
}

TEST(ToolDrawingTest, ShowsACylinderAsACylinder) {
  const Eigen::Isometry3d X_WT(Eigen::Translation3d(1.0, 2.0, 3.0));
  const std::vector<Marker> markers = draw(Tool::cylinder(0.01, 0.2), 3, X_WT);
  ASSERT_EQ(markers.size(), 1U);
  EXPECT_EQ(markers[0].type, Marker::CYLINDER);
  EXPECT_EQ(markers[0].id, 3);
  EXPECT_EQ(markers[0].scale.x, 0.02);
  EXPECT_EQ(markers[0].scale.z, 0.2);
  EXPECT_NEAR(markers[0].pose.position.z, 2.9, 1e-12);
}

TEST(ToolDrawingTest, ShowsAllOtherPiecesAsTriangles) {
  const Eigen::Isometry3d aside(Eigen::Translation3d(0.5, 0.0, 0.0));
  const Tool tool({{"a", ConvexShape::box({0.1, 0.1, 0.1})},
                   {"b", ConvexShape::cylinder(0.01, 0.2).placed(aside)},
                   {"c", ConvexShape::hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})}});
  std::set<int> ids;
  for (const int index : {0, 1}) {
    const std::vector<Marker> markers = draw(tool, index);
    ASSERT_EQ(markers.size(), 2U);
    EXPECT_EQ(markers[0].type, Marker::CYLINDER);
    EXPECT_NEAR(markers[0].pose.position.x, 0.5, 1e-12);
    EXPECT_EQ(markers[1].type, Marker::TRIANGLE_LIST);
    EXPECT_EQ(markers[1].points.size(), 3U * (12 + 4));
    EXPECT_EQ(markers[1].colors.size(), markers[1].points.size());
    for (const std_msgs::ColorRGBA& drawn : markers[1].colors) EXPECT_EQ(drawn.a, 0.8F);
    for (const Marker& drawn : markers) ids.insert(drawn.id);
  }
  EXPECT_EQ(ids, (std::set<int>{0, 1, 2, 3}));
}

TEST(ToolDrawingTest, EachBodyIsWhereItIsUnderIdsOfItsOwn) {
  const Tool body({{"a", ConvexShape::box({0.1, 0.1, 0.1})}, {"b", ConvexShape::cylinder(0.01, 0.2)}});
  const Eigen::Isometry3d aside(Eigen::Translation3d(0.5, 0.0, 0.0));
  visualization_msgs::MarkerArray array;
  addTool(array, drawingOf(1), {body, body}, {Eigen::Isometry3d::Identity(), aside});
  ASSERT_EQ(array.markers.size(), 4U);
  for (size_t i = 0; i < array.markers.size(); ++i) {
    EXPECT_EQ(array.markers[i].id, static_cast<int>(4 + i));
    EXPECT_EQ(array.markers[i].pose.position.x, i < 2 ? 0.0 : 0.5);
  }
}

}  // namespace
}  // namespace sweep_guard_ros
