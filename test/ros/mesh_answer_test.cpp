#include "ros/tool/mesh_answer.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <vector>

#include "ros/tool/mesh_wire.h"

namespace sweep_guard_ros {
namespace {

template <typename Value>
std::string bytesOf(const std::vector<Value>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

std::string answer(const std::vector<double>& coordinates, const std::vector<std::uint32_t>& corners) {
  const MeshWireHeader header{static_cast<std::uint32_t>(coordinates.size() / 3),
                              static_cast<std::uint32_t>(corners.size() / 3)};
  return bytesOf(std::vector<MeshWireHeader>{header}) + bytesOf(coordinates) + bytesOf(corners);
}

const std::vector<double> kCorners = {0, 0, 0, 1, 0, 0, 0, 1, 0};

TEST(MeshAnswerTest, HoldsASurface) {
  const auto surface = surfaceFrom(answer(kCorners, {0, 1, 2}));
  ASSERT_TRUE(surface);
  EXPECT_EQ(surface->vertices[1], Eigen::Vector3d::UnitX());
  EXPECT_EQ(surface->triangles, (std::vector<sweep_guard_core::Triangle>{{0, 1, 2}}));
}

TEST(MeshAnswerTest, IsMalformedWithoutVerticesOrTriangles) {
  EXPECT_FALSE(surfaceFrom(answer({}, {0, 0, 0})));
  EXPECT_FALSE(surfaceFrom(answer(kCorners, {})));
  EXPECT_FALSE(surfaceFrom(""));
}

TEST(MeshAnswerTest, IsMalformedIfItIsCutOffOrTooLong) {
  const std::string whole = answer(kCorners, {0, 1, 2});
  EXPECT_FALSE(surfaceFrom(whole.substr(0, whole.size() - 1)));
  EXPECT_FALSE(surfaceFrom(whole + '\0'));
}

TEST(MeshAnswerTest, IsMalformedWithACornerThatIsNoVertexOrACoordinateThatIsNotFinite) {
  EXPECT_FALSE(surfaceFrom(answer(kCorners, {0, 1, 3})));
  EXPECT_FALSE(surfaceFrom(answer({0, 0, 0, 1, 0, 0, 0, 1, std::numeric_limits<double>::quiet_NaN()}, {0, 1, 2})));
}

}  // namespace
}  // namespace sweep_guard_ros
