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
  const Workpieces workpieces = {wedge("liver", 0.15), wedge("spleen", 0.05)};
  const Distances distances = {{"liver", {0.412, 0.0513}}};
  const auto sizes = workpieceSizes(workpieces, distances);
  ASSERT_EQ(sizes.size(), 2U);
  EXPECT_EQ(sizes[0].first, "liver");
  EXPECT_EQ(sizes[0].second, "0.15 x 0.3 x 0.075 m, at least 0.412 m from the tool, nearest so far 0.0513 m");
  EXPECT_EQ(sizes[1].second, "0.05 x 0.1 x 0.025 m, distance from the tool not known");
  EXPECT_EQ(doubtfulSizes(workpieces, distances), "");
}

TEST(WorkpieceSizesTest, WhereAFrameIsLostNoOldDistanceIsGiven) {
  const Workpieces workpieces = {wedge("bed", 1.0), wedge("lost", 0.1), wedge("new", 0.1), wedge("never", 0.1)};
  const Distances distances = {{"bed", {0.4, 0.3}}, {"lost", {{}, 0.05}}, {"new", {}}};
  const auto sizes = workpieceSizes(workpieces, distances);
  ASSERT_EQ(sizes.size(), 4U);
  EXPECT_EQ(sizes[0].first, "bed");
  EXPECT_EQ(sizes[1].second, "0.1 x 0.2 x 0.05 m, distance from the tool not known, nearest so far 0.05 m");
  for (const size_t i : {2U, 3U}) EXPECT_EQ(sizes[i].second, "0.1 x 0.2 x 0.05 m, distance from the tool not known");
  EXPECT_EQ(doubtfulSizes(workpieces, distances), "");
}

TEST(WorkpieceSizesTest, AMeshInMillimetersIsDoubted) {
  EXPECT_EQ(doubtfulSizes({wedge("liver", 150.0)}, {}), "'liver' is 300 m long: is its mesh in millimeters?");
  EXPECT_EQ(doubtfulSizes({wedge("a", 150.0), wedge("b", 4.9), wedge("c", 200.0)}, {}),
            "'c' is 400 m long: is its mesh in millimeters? (and 1 more)");
  EXPECT_EQ(doubtfulSizes({wedge("hall", 5.0)}, {}), "") << "10 m";
}

TEST(WorkpieceSizesTest, APoseOrATransformInMillimetersIsDoubted) {
  const Workpieces workpieces = {wedge("bed", 1.0), wedge("liver", 0.15)};
  const std::string rest = " m: is its pose, the mesh or a transform between them in millimeters?";
  EXPECT_EQ(doubtfulSizes(workpieces, {{"bed", {700.0, 612.0}}, {"liver", {500.0, 412.0}}}),
            "the tool was never nearer to 'liver' than 412" + rest + " (and 1 more)");
  EXPECT_EQ(doubtfulSizes(workpieces, {{"bed", {700.0, 612.0}}, {"liver", {500.0, 0.2}}}),
            "the tool was never nearer to 'bed' than 612" + rest);
  EXPECT_EQ(doubtfulSizes(workpieces, {{"bed", {700.0, 5.0}}, {"liver", {500.0, 4.0}}}), "") << "it has been near";
}

TEST(WorkpieceSizesTest, BothMayBeDoubted) {
  EXPECT_EQ(
      doubtfulSizes({wedge("liver", 150.0)}, {{"liver", {20.0, 20.0}}}),
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
  const auto sizes = workpieceSizes(workpieces, distances);
  ASSERT_EQ(sizes.size(), 20U);
  EXPECT_EQ(sizes.front().first, std::string(1, 'A' + 29));
  EXPECT_EQ(sizes.back().first, std::string(1, 'A' + 10));
}

}  // namespace
}  // namespace sweep_guard_core
