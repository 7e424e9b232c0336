#include "sweep_guard/geometry/vertex_blocks.h"

#include <gtest/gtest.h>

#include <limits>

#include "scenes.h"

namespace sweep_guard_core {
namespace {

std::vector<float> randomPositions(Random& random, size_t vertices) {
  std::vector<float> positions(3 * vertices);
  for (float& x : positions)
    x = static_cast<float>(random.uniform(1.0, 2.0));  // away from 0: filling with zeros would show
  return positions;
}

Eigen::AlignedBox3f boxOf(const std::vector<float>& positions, size_t first, size_t count) {
  Eigen::AlignedBox3f box;
  for (size_t i = first; i < std::min(first + count, positions.size() / 3); ++i) {
    box.extend(Eigen::Map<const Eigen::Vector3f>(&positions[3 * i]));
  }
  return box;
}

Eigen::AlignedBox3f boxAt(const simd::BoxArrays<const float>& boxes, size_t i) {
  return {Eigen::Vector3f(boxes.lower[0][i], boxes.lower[1][i], boxes.lower[2][i]),
          Eigen::Vector3f(boxes.upper[0][i], boxes.upper[1][i], boxes.upper[2][i])};
}

TEST(VertexBlocksTest, HaveTheTightestBoxesForAnyNumberOfVertices) {
  Random random(1);
  for (const size_t vertices : {1U, 2U, 31U, 32U, 33U, 37U, 64U, 511U, 512U, 513U, 519U, 1030U, 5000U}) {
    const std::vector<float> positions = randomPositions(random, vertices);
    VertexBlocks blocks;
    ASSERT_TRUE(blocks.measure(positions));
    ASSERT_EQ(blocks.count(), (vertices + 31) / 32);
    for (size_t i = 0; i < blocks.count(); ++i) {
      EXPECT_EQ(boxAt(blocks.arrays(), i).min(), boxOf(positions, 32 * i, 32).min()) << vertices;
      EXPECT_EQ(boxAt(blocks.arrays(), i).max(), boxOf(positions, 32 * i, 32).max()) << vertices;
    }
    EXPECT_EQ(blocks.bounds().min(), boxOf(positions, 0, vertices).min().cast<double>());
    EXPECT_EQ(blocks.bounds().max(), boxOf(positions, 0, vertices).max().cast<double>());
  }
}

TEST(VertexBlocksTest, ReportsEveryCoordinateThatIsNotFinite) {
  Random random(2);
  for (const size_t vertices : {1U, 33U, 100U}) {
    for (size_t i = 0; i < 3 * vertices; ++i) {
      std::vector<float> positions = randomPositions(random, vertices);
      positions[i] = i % 2 == 0 ? std::numeric_limits<float>::quiet_NaN() : std::numeric_limits<float>::infinity();
      VertexBlocks blocks;
      EXPECT_FALSE(blocks.measure(positions)) << i << " of " << vertices;
    }
  }
}

TEST(VertexBlocksTest, AreMeasuredAgainEachTime) {
  Random random(3);
  VertexBlocks blocks;
  for (const size_t vertices : {1000U, 40U, 3000U}) {
    const std::vector<float> positions = randomPositions(random, vertices);
    blocks.measure(positions);
    EXPECT_EQ(blocks.bounds().min(), boxOf(positions, 0, vertices).min().cast<double>());
    EXPECT_EQ(boxAt(blocks.arrays(), blocks.count() - 1).min(), boxOf(positions, 32 * (blocks.count() - 1), 32).min());
  }
}

}  // namespace
}  // namespace sweep_guard_core
