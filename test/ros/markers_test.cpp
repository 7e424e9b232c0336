#include "ros/output/markers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_ros {
namespace {

using std::chrono::milliseconds;
using sweep_guard_core::SteadyTime;
using sweep_guard_core::Workpiece;
using visualization_msgs::Marker;

const SteadyTime kBegin(std::chrono::seconds(100));

// Of triangles that are all the same one.
Workpiece workpieceOf(const std::string& id, size_t triangles) {
  sweep_guard_core::TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}},
                                      std::vector<sweep_guard_core::Triangle>(triangles, {0, 1, 2}), /*is_sheet=*/true);
  Workpiece workpiece{id, 0, {}, kBegin, "table", std::move(mesh)};
  workpiece.stamp = sweep_guard_core::Time(std::chrono::seconds(7));
  return workpiece;
}

class WorkpieceMarkersTest : public testing::Test {
 protected:
  WorkpieceMarkersTest() { scene_.namespaces = {"workpieces"}; }

  void show(std::vector<Workpiece> workpieces) {
    scene_.workpieces.clear();
    for (Workpiece& workpiece : workpieces)
      scene_.workpieces.push_back(std::make_shared<const Workpiece>(std::move(workpiece)));
  }

  std::vector<Marker> drawAfter(milliseconds time) { return markers_.draw(scene_, kBegin + time).markers; }

  Markers markers_{"world"};
  MarkerScene scene_;
};

TEST_F(WorkpieceMarkersTest, AWorkpieceIsDrawnInItsFrame) {
  show({workpieceOf("liver", 2)});
  const std::vector<Marker> drawn = drawAfter(milliseconds(0));
  ASSERT_EQ(drawn.size(), 1U);
  EXPECT_EQ(drawn[0].ns, "workpieces");
  EXPECT_EQ(drawn[0].type, Marker::TRIANGLE_LIST);
  EXPECT_EQ(drawn[0].action, Marker::ADD);
  EXPECT_EQ(drawn[0].header.frame_id, "table");
  EXPECT_EQ(drawn[0].header.stamp, ros::Time(7.0));
  EXPECT_TRUE(drawn[0].frame_locked);
  EXPECT_EQ(drawn[0].lifetime, ros::Duration(0.5));
  ASSERT_EQ(drawn[0].points.size(), 6U);
  EXPECT_EQ(drawn[0].points[1].x, 1.0);
  EXPECT_EQ(drawn[0].points[5].y, 2.0);
}

TEST_F(WorkpieceMarkersTest, AWorkpieceIsDrawnAnewWhenItHasChangedAndBeforeItsMarkerEnds) {
  show({workpieceOf("liver", 1)});
  EXPECT_EQ(drawAfter(milliseconds(0)).size(), 1U);
  EXPECT_EQ(drawAfter(milliseconds(249)).size(), 0U);
  EXPECT_EQ(drawAfter(milliseconds(250)).size(), 1U);
  Workpiece deformed = workpieceOf("liver", 1);
  deformed.received += milliseconds(1);
  show({deformed});
  EXPECT_EQ(drawAfter(milliseconds(251)).size(), 1U);
  EXPECT_EQ(drawAfter(milliseconds(252)).size(), 0U);
}

TEST_F(WorkpieceMarkersTest, AWorkpieceThatIsGoneIsDeletedOnce) {
  show({workpieceOf("liver", 1), workpieceOf("table", 1)});
  const std::vector<Marker> both = drawAfter(milliseconds(0));
  ASSERT_EQ(both.size(), 2U);
  EXPECT_NE(both[0].id, both[1].id);
  show({workpieceOf("table", 1)});
  const std::vector<Marker> deleted = drawAfter(milliseconds(10));
  ASSERT_EQ(deleted.size(), 1U);
  EXPECT_EQ(deleted[0].action, Marker::DELETE);
  EXPECT_EQ(deleted[0].ns, "workpieces");
  EXPECT_EQ(deleted[0].id, both[0].id);
  EXPECT_EQ(drawAfter(milliseconds(20)).size(), 0U);
  EXPECT_EQ(drawAfter(milliseconds(250)).at(0).id, both[1].id);
}

TEST_F(WorkpieceMarkersTest, BeyondTheBoundATextIsInPlaceOfAWorkpiece) {
  show({workpieceOf("bed", kMaxMarkedTriangles - 1), workpieceOf("liver", 2), workpieceOf("table", 1)});
  const std::vector<Marker> drawn = drawAfter(milliseconds(0));
  ASSERT_EQ(drawn.size(), 3U);
  EXPECT_EQ(drawn[0].points.size(), 3 * (kMaxMarkedTriangles - 1));
  EXPECT_EQ(drawn[1].type, Marker::TEXT_VIEW_FACING);
  EXPECT_EQ(drawn[1].text, "'liver' is not drawn:\nmore than 50000 triangles in all");
  EXPECT_EQ(drawn[1].header.frame_id, "table");
  EXPECT_EQ(drawn[1].pose.position.y, 1.0);
  EXPECT_EQ(drawn[2].points.size(), 3U);
}

// So rviz knows its frame there.
TEST_F(WorkpieceMarkersTest, AWorkpieceIsDrawnAtTheNewestPoseUnlessItIsNewer) {
  auto bodies = std::vector<sweep_guard_core::Tool>{sweep_guard_core::Tool::cylinder(0.01, 0.1)};
  scene_.tool = std::make_shared<const sweep_guard_core::Tool>(bodies.front());
  scene_.bodies = std::make_shared<const std::vector<sweep_guard_core::Tool>>(std::move(bodies));
  for (const int end : {9, 5}) {
    auto report = std::make_shared<sweep_guard_core::SweepReport>();
    report->end = sweep_guard_core::Time(std::chrono::seconds(end));
    scene_.newest = report;
    show({workpieceOf("liver", 1)});
    EXPECT_EQ(drawAfter(milliseconds(10000 - 1000 * end)).at(0).header.stamp, ros::Time(std::max(end, 7)));
  }
}

TEST_F(WorkpieceMarkersTest, LinksOfOtherToolsAreNotDrawn) {
  Workpiece link = workpieceOf("/left/sweep_guard/tip", 1);
  link.of_other_tool = true;
  show({link});
  EXPECT_EQ(drawAfter(milliseconds(0)).size(), 0U);
}

}  // namespace
}  // namespace sweep_guard_ros
