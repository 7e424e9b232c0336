#include "detection/culler.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "detection/exact_oracle.h"
#include "detection/float_planes.h"
#include "detection/reference_detector.h"
#include "mesh_orders.h"
#include "scenes.h"

namespace sweep_guard_core {
namespace {

// The cube [-1, 1]^3 without what lies beyond x + y = 1.
SweptVolume cutCube() {
  SweptVolume volume;
  volume.box.half_extents.setOnes();
  volume.clips_B.emplace_back(Eigen::Vector3d(1, 1, 0), 1.0 / std::sqrt(2.0));
  return volume;
}

using Triangles = std::vector<std::uint32_t>;

Triangles left(Culler& culler, const TriangleMesh& mesh_M, const SweptVolume& swept_M, bool met_only = false) {
  Triangles triangles;
  for (const RemainingTriangle& candidate : culler.cull(mesh_M, floatPlanes(mesh_M, swept_M))) {
    if (candidate.met || !met_only) triangles.push_back(candidate.triangle);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

TEST(CullerTest, LeavesOutWhatIsWhollyBeyondOnePlane) {
  const TriangleMesh mesh({{0, 0, 0}, {0.5, 0, 0}, {2, 0, 0}, {2, 0, 3}, {2, 3, 0}, {0, 2, 0}, {0.9, 0.9, 0}},
                          {{0, 0, 1},    // inside
                           {0, 2, 3},    // reaches in
                           {2, 3, 4},    // beyond x = 1
                           {2, 5, 5},    // beyond two different sides, and beyond the clip
                           {6, 6, 6}});  // in the corner that the clip takes away
  Culler culler;
  EXPECT_EQ(left(culler, mesh, cutCube()), (Triangles{0, 1}));
}

TEST(CullerTest, KeepsWhatTouches) {
  const TriangleMesh mesh({{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0.5, 0.5, -1}, {3, 3, -3}},
                          {{0, 1, 2}, {3, 4, 4}, {1, 2, 2}});
  Culler culler;
  EXPECT_EQ(left(culler, mesh, cutCube()), (Triangles{0, 1}));
}

TEST(CullerTest, KnowsWhatIsMetByACornerInside) {
  const TriangleMesh mesh({{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {-3, 0, 0.5}, {3, 0.5, 0.5}, {0, -1, 0}},
                          {{0, 1, 2},    // one corner inside
                           {3, 4, 4},    // passes through: it remains to be seen
                           {5, 2, 2}});  // a corner on the surface: it remains to be seen
  Culler culler;
  EXPECT_EQ(left(culler, mesh, cutCube()), (Triangles{0, 1, 2}));
  EXPECT_EQ(left(culler, mesh, cutCube(), /*met_only=*/true), Triangles{0});
}

// What was known of the larger one's blocks is still in the buffers.
TEST(CullerTest, TakesASmallerMeshAfterALargerOne) {
  std::vector<Eigen::Vector3d> vertices(kBlocksTogether * simd::kBlock, Eigen::Vector3d(5, 0, 0));
  const auto near = static_cast<std::uint32_t>(vertices.size());
  vertices.insert(vertices.end(), {{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}});
  const TriangleMesh large(vertices, {{0, 100, 200}, {near, near + 1, near + 2}});
  const TriangleMesh small({{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}}, {{0, 1, 2}});
  Culler culler;
  EXPECT_EQ(left(culler, large, cutCube()), Triangles{1});
  EXPECT_EQ(left(culler, small, cutCube()), Triangles{0});
}

TEST(CullerTest, LeavesOutNothingThatMeetsTheVolumeAndKnowsOnlyWhatDoes) {
  Culler culler;
  size_t left_out = 0;
  size_t known = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const Scene scene = seed % 2 == 0 ? grazingScene(seed) : randomScene(seed);
    const Triangles kept = left(culler, scene.mesh_M, scene.swept_M);
    const Triangles met = left(culler, scene.mesh_M, scene.swept_M, /*met_only=*/true);
    for (std::uint32_t i = 0; i < scene.mesh_M.triangles().size(); ++i) {
      if (std::binary_search(met.begin(), met.end(), i)) {
        ++known;
        EXPECT_TRUE(meetsExactly(scene.mesh_M, i, scene.swept_M)) << "seed " << seed << ": " << describe(scene, i);
      } else if (!std::binary_search(kept.begin(), kept.end(), i)) {
        ++left_out;
        EXPECT_FALSE(meetsExactly(scene.mesh_M, i, scene.swept_M)) << "seed " << seed << ": " << describe(scene, i);
      }
    }
  }
  EXPECT_GT(left_out, 1000U);
  EXPECT_GT(known, 1000U);
}

// Blocks, clusters and the last, incomplete ones of both; in any order.
class LargeMeshTest : public testing::TestWithParam<MeshOrdering> {};

TEST_P(LargeMeshTest, CullKeepsWhatTheReferenceFindsAndLittleMore) {
  Culler culler;
  SubmeshFinder finder;
  ReferenceDetector reference;
  Random random(/*seed=*/3);
  size_t kept = 0;
  size_t met = 0;
  for (int i = 0; i < 40; ++i) {
    const TriangleMesh hull = GetParam().of(wavyHull(30 + i, 40, random.uniform(0.0, 6.0)));
    const ConvexShape tool = ConvexShape::cylinder(/*radius=*/0.01, /*length=*/0.1);
    Motion motion = handMotion(random);
    const Eigen::Vector3d place = 0.1 * random.direction();
    motion.X_MT_start.pretranslate(place);
    motion.X_MT_end.pretranslate(place);
    const SweptVolume swept_M = sweptVolume(tool, motion, VolumeKind::kObbPlanes);
    const Triangles expected = reference.detect(hull, swept_M).triangles;
    const Triangles of_all = left(culler, hull, swept_M);
    EXPECT_TRUE(std::includes(of_all.begin(), of_all.end(), expected.begin(), expected.end()));

    const simd::Planes planes = floatPlanes(hull, swept_M);
    Triangles of_part;
    EXPECT_EQ(culler.leavesAny(hull, planes), !culler.cull(hull, planes).empty());
    for (const RemainingTriangle& candidate : culler.cull(finder.find(hull, planes), planes))
      of_part.push_back(candidate.triangle);
    std::sort(of_part.begin(), of_part.end());
    EXPECT_EQ(of_part, of_all);
    for (const simd::Kernels& kernels : simd::availableKernels()) {
      Culler same(kernels);
      EXPECT_EQ(left(same, hull, swept_M), of_all) << kernels.name;
    }
    kept += of_all.size();
    met += expected.size();
  }
  EXPECT_GT(met, 500U);
  EXPECT_LT(kept, met + met / 5);
}

INSTANTIATE_TEST_SUITE_P(AllOrders, LargeMeshTest, testing::ValuesIn(meshOrderings()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace sweep_guard_core
