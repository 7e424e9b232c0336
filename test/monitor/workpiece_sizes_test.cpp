#include "monitor/workpiece_sizes.h"

#include <gtest/gtest.h>

namespace sweep_guard_core {
namespace {

using Distances = std::map<std::string, ToolDistances::Distance>;

// Its sides are 1, 2 and 0.5 times a length [m].
std::shared_ptr<const Workpiece> wedge(const std::string& id, double length) {
  const TriangleMesh mesh({{0, 0, 0}, {length, 0, 0}, {0, 2.0 * length, 0}, {0, 0, 0.5 * length}},
                          {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}});
  return std::make_shared<const Workpiece>(Workpiece{id, 1, {}, {}, "table", mesh});
}

TEST(WorkpieceSizesTest, AreGivenWithTheDistanceOfTheTool) {
  const WorkpieceSizes sizes =
      workpieceSizes({wedge("liver", 0.15), wedge("spleen", 0.05)}, {{"liver", {0.412, 0.0513}}});
  ASSERT_EQ(sizes.nearest.size(), 2U);
  EXPECT_EQ(sizes.nearest[0].first, "liver");
  EXPECT_EQ(sizes.nearest[0].second, "0.15 x 0.3 x 0.075 m, 0.412 m from the tool, nearest so far 0.0513 m");
  EXPECT_EQ(sizes.nearest[1].second, "0.05 x 0.1 x 0.025 m, distance from the tool not known");
  EXPECT_EQ(sizes.doubt, "");
}

TEST(WorkpieceSizesTest, WhereAFrameIsLostNoOldDistanceIsGiven) {
  const Workpieces workpieces = {wedge("bed", 1.0), wedge("lost", 0.1), wedge("new", 0.1), wedge("never", 0.1)};
  const WorkpieceSizes sizes = workpieceSizes(workpieces, {{"bed", {0.4, 0.3}}, {"lost", {{}, 0.05}}, {"new", {}}});
  ASSERT_EQ(sizes.nearest.size(), 4U);
  EXPECT_EQ(sizes.nearest[0].first, "bed");
  EXPECT_EQ(sizes.nearest[1].second, "0.1 x 0.2 x 0.05 m, distance from the tool not known, nearest so far 0.05 m");
  for (const size_t i : {2, 3})
    EXPECT_EQ(sizes.nearest[i].second, "0.1 x 0.2 x 0.05 m, distance from the tool not known");
  EXPECT_EQ(sizes.doubt, "");
}

TEST(WorkpieceSizesTest, AMeshInMillimetersIsDoubted) {
  EXPECT_EQ(workpieceSizes({wedge("liver", 150.0)}, {}).doubt, "'liver' is 300 m long: is its mesh in millimeters?");
  EXPECT_EQ(workpieceSizes({wedge("a", 150.0), wedge("b", 4.9), wedge("c", 200.0)}, {}).doubt,
            "'c' is 400 m long: is its mesh in millimeters? (and 1 more)");
  EXPECT_EQ(workpieceSizes({wedge("hall", 5.0)}, {}).doubt, "") << "10 m";
}

TEST(WorkpieceSizesTest, APoseOrATransformInMillimetersIsDoubted) {
  const Workpieces workpieces = {wedge("bed", 1.0), wedge("liver", 0.15)};
  const std::string rest = " m: is its pose, the mesh or a transform between them in millimeters?";
  EXPECT_EQ(workpieceSizes(workpieces, {{"bed", {700.0, 612.0}}, {"liver", {500.0, 412.0}}}).doubt,
            "the tool was never nearer to 'liver' than 412" + rest + " (and 1 more)");
  EXPECT_EQ(workpieceSizes(workpieces, {{"bed", {700.0, 612.0}}, {"liver", {500.0, 0.2}}}).doubt,
            "the tool was never nearer to 'bed' than 612" + rest);
  EXPECT_EQ(workpieceSizes(workpieces, {{"bed", {700.0, 5.0}}, {"liver", {500.0, 4.0}}}).doubt, "")
      << "it has been near";
}

TEST(WorkpieceSizesTest, BothMayBeDoubted) {
  EXPECT_EQ(
      workpieceSizes({wedge("liver", 150.0)}, {{"liver", {20.0, 20.0}}}).doubt,
      "'liver' is 300 m long: is its mesh in millimeters?; the tool was never nearer to 'liver' than 20 m: is its "
      "pose, the mesh or a transform between them in millimeters?");
}

TEST(WorkpieceSizesTest, AreThoseOfTheTwentyNearest) {
  Workpieces workpieces;
  Distances distances;
  for (int i = 0; i < 30; ++i) {
    const std::string id(1, static_cast<char>('A' + i));
    workpieces.push_back(wedge(id, 0.1));
    distances[id] = {3.0 - 0.1 * i, 0.1};
  }
  const WorkpieceSizes sizes = workpieceSizes(workpieces, distances);
  ASSERT_EQ(sizes.nearest.size(), 20U);
  EXPECT_EQ(sizes.nearest.front().first, std::string(1, 'A' + 29));
  EXPECT_EQ(sizes.nearest.back().first, std::string(1, 'A' + 10));
}

}  // namespace
}  // namespace sweep_guard_core
