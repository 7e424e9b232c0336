#include "sweep_guard/geometry/mesh_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "common/xyz.h"
#include "mesh_orders.h"
#include "refusal.h"
#include "scenes.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {
namespace {

class MeshOrderTest : public testing::TestWithParam<MeshOrdering> {
 protected:
  const TriangleMesh hull_ = wavyHull(60, 80, 0.5);
  const TriangleMesh mesh_ = GetParam().of(hull_);
};

TEST_P(MeshOrderTest, RenumbersVerticesOnlyWhereTheyAreShuffled) {
  EXPECT_EQ(mesh_.order().vertex_places.empty(), !GetParam().vertices_shuffled);
}

TEST_P(MeshOrderTest, EveryTriangleHasOnePlaceInOneCluster) {
  std::uint32_t next = 0;
  std::set<std::uint32_t> triangles;
  for (const Cluster& cluster : mesh_.order().clusters) {
    EXPECT_EQ(cluster.first, next);
    EXPECT_GE(cluster.count, 1U);
    EXPECT_LE(cluster.count, simd::kCluster);
    next += cluster.count;
  }
  EXPECT_EQ(next, mesh_.triangles().size());
  for (std::uint32_t place = 0; place < next; ++place) {
    const auto& at = mesh_.order().triangle_at;
    triangles.insert(at.empty() ? place : at[place]);
  }
  EXPECT_EQ(triangles.size(), mesh_.triangles().size());
}

TEST_P(MeshOrderTest, GroupsHoldEveryClusterOnceAndAllOfTheirBlocks) {
  std::uint32_t next = 0;
  for (const ClusterGroup& group : mesh_.order().groups) {
    EXPECT_EQ(group.first, next);
    EXPECT_GE(group.count, 1U);
    for (; next < group.first + group.count; ++next) {
      for (const std::uint32_t block : mesh_.order().clusters[next].blocks) {
        const auto& known = group.block_groups;
        EXPECT_NE(std::find(known.begin(), known.end(), block / kBlocksTogether), known.end());
      }
    }
  }
  EXPECT_EQ(next, mesh_.order().clusters.size());
}

TEST_P(MeshOrderTest, KeepsClustersFew) { EXPECT_LT(mesh_.order().clusters.size(), mesh_.triangles().size() / 16); }

// 400 triangles in seven blocks, each of which reaches across the mesh.
TEST_P(MeshOrderTest, KeepsClustersOfASmallMeshFew) {
  EXPECT_LT(GetParam().of(wavyHull(11, 20, 0.5)).order().clusters.size(), 25U);
}

TEST_P(MeshOrderTest, IndicesStayTheSenders) {
  const TriangleMesh moved = GetParam().of(wavyHull(60, 80, 2.5));
  std::vector<float> positions;
  for (size_t i = 0; i < moved.vertexCount(); ++i) {
    for (const double x : xyz(moved.vertex(i))) positions.push_back(static_cast<float>(x));
  }
  TriangleMesh deformed = mesh_;
  std::vector<float> sent = positions;
  deformed.deform(sent);
  EXPECT_EQ(sent.size(), positions.size());
  for (size_t i = 0; i < deformed.vertexCount(); ++i) {
    EXPECT_EQ(deformed.vertex(i), Eigen::Map<const Eigen::Vector3f>(&positions[3 * i]).cast<double>());
  }
}

TEST_P(MeshOrderTest, ClustersNameTheCornersOfTheirTriangles) {
  const auto& at = mesh_.order().triangle_at;
  for (const Cluster& cluster : mesh_.order().clusters) {
    const auto& places = mesh_.order().corners[cluster.number];
    for (std::uint32_t i = 0; i < cluster.count; ++i) {
      const std::uint32_t place = cluster.first + i;
      const Triangle& corners = mesh_.triangles()[at.empty() ? place : at[place]];
      for (size_t k = 0; k < 3; ++k) {
        const size_t vertex =
            size_t{cluster.blocks[places[k][i] / simd::kBlock]} * simd::kBlock + places[k][i] % simd::kBlock;
        const Eigen::Map<const Eigen::Vector3f> p(&mesh_.places()[3 * vertex]);
        EXPECT_EQ(mesh_.origin() + p.cast<double>(), mesh_.vertex(corners[k]));
      }
    }
  }
}

TEST_P(MeshOrderTest, ABadDeformationChangesNothing) {
  TriangleMesh mesh = mesh_;
  std::vector<float> bad(3 * mesh.vertexCount(), 0.0F);
  bad[3 * 100 + 1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(has(refusal([&] { mesh.deform(bad); }), "vertex 100 "));
  for (size_t i = 0; i < mesh.vertexCount(); ++i) EXPECT_EQ(mesh.vertex(i), mesh_.vertex(i));
  EXPECT_EQ(mesh.bounds_M().min(), mesh_.bounds_M().min());
  EXPECT_EQ(mesh.bounds_M().max(), mesh_.bounds_M().max());
}

INSTANTIATE_TEST_SUITE_P(AllOrders, MeshOrderTest, testing::ValuesIn(meshOrderings()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace sweep_guard_core
