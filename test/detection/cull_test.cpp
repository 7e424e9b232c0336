#include "sweep_guard/detection/cull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "detection/exact_oracle.h"
#include "scenes.h"

namespace sweep_guard {
namespace {

// The cube [-1, 1]^3 without what lies beyond x + y = 1.
SweptVolume cutCube() {
  SweptVolume volume;
  volume.box.half_extents.setOnes();
  volume.clips_B.emplace_back(Eigen::Vector3d(1, 1, 0), 1.0 / std::sqrt(2.0));
  return volume;
}

TEST(CullTest, LeavesOutWhatIsWhollyBeyondOnePlane) {
  const TriangleMesh mesh({{0, 0, 0}, {0.5, 0, 0}, {2, 0, 0}, {2, 0, 3}, {2, 3, 0}, {0, 2, 0}, {0.9, 0.9, 0}},
                          {{0, 0, 1},    // inside
                           {0, 2, 3},    // reaches in
                           {2, 3, 4},    // beyond x = 1
                           {2, 5, 5},    // beyond two different sides, and beyond the clip
                           {6, 6, 6}});  // in the corner that the clip takes away
  Cull cull;
  EXPECT_EQ(cull(mesh, cutCube()), (std::vector<std::uint32_t>{0, 1}));
}

TEST(CullTest, KeepsWhatTouches) {
  const TriangleMesh mesh({{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0.5, 0.5, -1}, {3, 3, -3}},
                          {{0, 1, 2}, {3, 4, 4}, {1, 2, 2}});
  Cull cull;
  EXPECT_EQ(cull(mesh, cutCube()), (std::vector<std::uint32_t>{0, 1}));
}

TEST(CullTest, AmongSomeLeavesWhatItLeavesOfAll) {
  Cull of_all;
  Cull of_some;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Scene scene = grazingScene(seed);
    std::vector<std::uint32_t> odd;
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 1; i < scene.mesh_M.triangles().size(); i += 2) odd.push_back(i);
    const std::vector<std::uint32_t>& left = of_all(scene.mesh_M, scene.swept_M);
    std::set_intersection(left.begin(), left.end(), odd.begin(), odd.end(), std::back_inserter(expected));
    EXPECT_EQ(of_some(scene.mesh_M, scene.swept_M, odd), expected) << "seed " << seed;
  }
}

TEST(CullTest, LeavesOutNothingThatMeetsTheVolume) {
  Cull cull;
  size_t left_out = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const Scene scene = grazingScene(seed);
    const std::vector<std::uint32_t>& left = cull(scene.mesh_M, scene.swept_M);
    for (std::uint32_t i = 0; i < scene.mesh_M.triangles().size(); ++i) {
      if (std::binary_search(left.begin(), left.end(), i)) continue;
      ++left_out;
      EXPECT_FALSE(meetsExactly(scene.mesh_M, i, scene.swept_M)) << "seed " << seed << ": " << describe(scene, i);
    }
  }
  EXPECT_GT(left_out, 500U);
}

}  // namespace
}  // namespace sweep_guard
