// Real meshes from files: open meshes, slivers, several components, halved quads.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "data_path.h"
#include "scenes.h"
#include "sweep_guard/geometry/decomposition.h"
#include "sweep_guard/ros/tool/mesh_file.h"

namespace sweep_guard_core {
namespace {

namespace fs = std::filesystem;

// Returns how far a triangle lies outside of a convex piece along any of the directions [m].
double outside(const ConvexShape& part, const TriangleMesh& mesh, const std::vector<std::uint32_t>& set,
               const Eigen::Vector3d& direction) {
  double reach = -std::numeric_limits<double>::infinity();
  for (const std::uint32_t i : set) {
    for (const std::uint32_t vertex : mesh.triangles()[i]) reach = std::max(reach, direction.dot(mesh.vertex(vertex)));
  }
  return reach - part.support(direction);
}

class DecompositionDataTest : public testing::TestWithParam<const char*> {};

TEST_P(DecompositionDataTest, PiecesContainEveryTriangle) {
  const fs::path path = dataPath(GetParam());
  if (!fs::exists(path)) GTEST_SKIP() << missing(path);
  const sweep_guard_ros::MeshSurface surface = sweep_guard_ros::readMesh(path);
  const TriangleMesh mesh(surface.vertices, surface.triangles);
  const auto sets = decompose(mesh);
  const std::vector<ConvexShape> parts = convexPieces(mesh);
  ASSERT_EQ(parts.size(), sets.size());
  Random random(/*seed=*/1);
  std::vector<int> held(mesh.triangles().size(), 0);
  for (size_t i = 0; i < parts.size(); ++i) {
    for (const std::uint32_t triangle : sets[i]) ++held[triangle];
    for (int k = 0; k < 100; ++k) {
      EXPECT_LE(outside(parts[i], mesh, sets[i], random.direction()), 1e-15 * (mesh.origin().norm() + mesh.radius()));
    }
  }
  EXPECT_TRUE(std::all_of(held.begin(), held.end(), [](int sets_with_it) { return sets_with_it == 1; }));
  RecordProperty("parts", static_cast<int>(parts.size()));
}

INSTANTIATE_TEST_SUITE_P(Meshes, DecompositionDataTest,
                         testing::Values("mesh/sofa_pliers_binary.stl", "mesh/sofa_dental_instrument_light.obj",
                                         "mesh/sofa_stylus.obj", "mesh/sofa_torus.obj", "mesh/sofa_dragon.stl",
                                         "mesh/sofa_raptor_8kp.obj",
                                         "urdf/franka_description/meshes/collision/hand.stl",
                                         "urdf/franka_description/meshes/visual/finger.dae",
                                         "urdf/costar_simulation/urdf/drill/drill.stl",
                                         "urdf/dvrk_model/meshes/instruments/housing/Classic/housing_Classic.dae",
                                         "urdf/dvrk_model/meshes/instruments/tip/006/Classic/tip_006.dae"));

}  // namespace
}  // namespace sweep_guard_core
