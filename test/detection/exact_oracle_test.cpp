#include "detection/exact_oracle.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace sweep_guard_core {
namespace {

// One triangle against the cube [-1, 1]^3.
bool meetsCube(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, double growth = 0.0) {
  SweptVolume cube;
  cube.box.half_extents.setOnes();
  const auto streamed = [&] {
    std::vector<float> positions;
    for (const Eigen::Vector3d& p : {a, b, c}) {
      const Eigen::Vector3f kept = p.cast<float>();
      positions.insert(positions.end(), kept.data(), kept.data() + 3);
    }
    return positions;
  };
  return meetsExactly(deformed({{a, b, c}, {{0, 1, 2}}}, streamed()), 0, cube, growth);
}

TEST(ExactOracleTest, SeesCornersInside) { EXPECT_TRUE(meetsCube({0, 0, 0}, {5, 0, 0}, {0, 5, 0})); }

TEST(ExactOracleTest, SeesATriangleThatEnclosesTheCube) {
  EXPECT_TRUE(meetsCube({-9, -9, 0.5}, {9, -9, 0.5}, {0, 9, 0.5}));
  EXPECT_FALSE(meetsCube({-9, -9, 1.5}, {9, -9, 1.5}, {0, 9, 1.5}));
}

// The line x + y = 2 touches the edge x = y = 1; no corner is near, and no plane of the cube separates.
TEST(ExactOracleTest, SeesAnEdgeThatTouchesAnEdge) {
  EXPECT_TRUE(meetsCube({3, -1, 0}, {-1, 3, 0}, {3, 3, 0}));
  EXPECT_FALSE(meetsCube({3.00001, -1, 0}, {-1, 3.00001, 0}, {3, 3, 0}));
  EXPECT_TRUE(meetsCube({3.00001, -1, 0}, {-1, 3.00001, 0}, {3, 3, 0}, /*growth=*/0.00002));
}

TEST(ExactOracleTest, SeesTheSmallestGapThatAFloatCanMake) {
  const double beyond_one = 1.0 + 0x1p-23;
  EXPECT_TRUE(meetsCube({1, 0, 0}, {2, 0, 0}, {2, 1, 0}));
  EXPECT_FALSE(meetsCube({beyond_one, 0, 0}, {2, 0, 0}, {2, 1, 0}));
  EXPECT_TRUE(meetsCube({beyond_one, 0, 0}, {2, 0, 0}, {2, 1, 0}, /*growth=*/0x1p-23));
}

TEST(ExactOracleTest, SeesPointsAndSegments) {
  EXPECT_TRUE(meetsCube({1, 1, 1}, {1, 1, 1}, {1, 1, 1}));
  EXPECT_FALSE(meetsCube({1, 1, 1.25}, {1, 1, 1.25}, {1, 1, 1.25}));
  EXPECT_TRUE(meetsCube({-5, 0.5, 0}, {5, 0.5, 0}, {5, 0.5, 0}));
  EXPECT_FALSE(meetsCube({-5, 1.5, 0}, {5, 1.5, 0}, {5, 1.5, 0}));
}

}  // namespace
}  // namespace sweep_guard_core
