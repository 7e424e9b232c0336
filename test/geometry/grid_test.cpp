#include "sweep_guard/geometry/grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "refusal.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {
namespace {

std::set<std::uint32_t> cornersOf(const Triangle& triangle) { return {triangle.begin(), triangle.end()}; }

class GridTest : public testing::TestWithParam<std::pair<std::uint32_t, std::uint32_t>> {
 protected:
  const Grid grid_{GetParam().first, GetParam().second};
  const std::vector<Triangle> triangles_ = grid_.triangles();
};

TEST_P(GridTest, EachPixelHasAPlaceOfItsOwn) {
  std::set<std::uint32_t> places;
  for (std::uint32_t row = 0; row < grid_.height(); ++row) {
    for (std::uint32_t column = 0; column < grid_.width(); ++column) places.insert(grid_.place(column, row));
  }
  EXPECT_EQ(places.size(), size_t{grid_.width()} * grid_.height());
  EXPECT_LT(*places.rbegin(), grid_.places());
}

TEST_P(GridTest, TwoTrianglesLieBetweenEachFourPixels) {
  for (std::uint32_t row = 0; row + 1 < grid_.height(); ++row) {
    for (std::uint32_t column = 0; column + 1 < grid_.width(); ++column) {
      const std::uint32_t corner = grid_.place(column, row);
      const std::uint32_t right = grid_.place(column + 1, row);
      const std::uint32_t below = grid_.place(column, row + 1);
      EXPECT_EQ(cornersOf(triangles_[2 * corner]), (std::set{corner, right, below}));
      EXPECT_EQ(cornersOf(triangles_[2 * corner + 1]), (std::set{right, below, grid_.place(column + 1, row + 1)}));
    }
  }
}

TEST_P(GridTest, EachTileIsABlockAndAClusterOfAllItsTriangles) {
  const TriangleMesh mesh(grid_);
  EXPECT_TRUE(mesh.order().vertex_places.empty());
  EXPECT_TRUE(mesh.order().triangle_at.empty());
  ASSERT_EQ(mesh.order().clusters.size(), grid_.tiles());
  ASSERT_EQ(mesh.blocks().count(), grid_.tiles());
  for (std::uint32_t tile = 0; tile < grid_.tiles(); ++tile) {
    const Cluster& cluster = mesh.order().clusters[tile];
    EXPECT_EQ(cluster.number, tile);
    EXPECT_EQ(cluster.first, tile * simd::kCluster);
    EXPECT_EQ(cluster.count, simd::kCluster);
    EXPECT_EQ(cluster.blocks[0], tile);
    EXPECT_EQ(mesh.existing(cluster), 0U);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, GridTest,
                         testing::Values(std::pair(2U, 2U), std::pair(8U, 4U), std::pair(9U, 5U), std::pair(7U, 64U),
                                         std::pair(64U, 48U), std::pair(101U, 37U)));

TEST(GridSizeTest, OfNoImageIsRefused) {
  EXPECT_TRUE(has(refusal([] { Grid(1, 480); }), "an image of 1 x 480 pixels: must be at least 2 x 2"));
  EXPECT_TRUE(has(refusal([] { Grid(640, 0); }), "an image of 640 x 0 pixels"));
  EXPECT_TRUE(has(refusal([] { Grid(65536, 65536); }), "at most 8388608 pixels"));
}

}  // namespace
}  // namespace sweep_guard_core
