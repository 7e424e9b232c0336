#include "simulation/elastic/mesh_bars.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <set>

#include "meshes.h"
#include "refusal.h"
#include "simulation/elastic/bar_model.h"

namespace sweep_guard_simulation {
namespace {

using Eigen::MatrixX3d;
using Eigen::RowVector3d;
using sweep_guard_core::TriangleMesh;

TEST(MeshBarsTest, AClosedMeshHasTheMassOfItsVolumeAndSkin) {
  const TriangleMesh mesh = cubeMesh(0.2, 10);
  ElasticMaterial material;
  material.density = 500.0;
  material.skin = 0.001;
  EXPECT_NEAR(barsOf(mesh, material).masses.sum(), 500.0 * (0.008 + 0.001 * 0.24), 1e-4);
}

TEST(MeshBarsTest, AClosedMeshHasAboutAsManyPointsInsideAsAskedFor) {
  const TriangleMesh mesh = cubeMesh(0.2, 10);
  ElasticMaterial material;
  material.inner_points = 1000;
  const BarStructure structure = barsOf(mesh, material);
  EXPECT_NEAR(static_cast<double>(structure.rest.rows()) - static_cast<double>(mesh.vertexCount()), 1000.0, 200.0);
  for (Eigen::Index i = 0; i < structure.rest.rows(); ++i) {
    EXPECT_LE(structure.rest.row(i).cwiseAbs().maxCoeff(), 0.1 + 1e-6);
  }
}

// The edges of tetrahedra are not the same in all directions, and their nodes move otherwise than in a lattice.
TEST(MeshBarsTest, ACubeIsAboutAsStiffAsItsYoungsModulus) {
  const TriangleMesh mesh = cubeMesh(0.2, 10);
  ElasticMaterial material;
  material.skin = 1e-9;
  material.inner_points = 1000;
  BarStructure structure = barsOf(mesh, material);
  Eigen::Index middle = 0;
  structure.rest.rowwise().squaredNorm().minCoeff(&middle);
  structure.fixed[static_cast<size_t>(middle)] = true;
  BarModel::Options options;
  options.step = std::numeric_limits<double>::infinity();
  options.iterations = 300;
  const double stress = 1.0;  // [Pa]
  const Eigen::VectorXd areas = vertexAreas(mesh);
  MatrixX3d loads = MatrixX3d::Zero(structure.rest.rows(), 3);
  for (Eigen::Index i = 0; i < areas.size(); ++i) {
    const double x = structure.rest(i, 0);
    if (std::abs(x) > 0.0999) loads(i, 0) = std::copysign(stress * 0.04 * faceShare(structure.rest.row(i), 0.2, 10), x);
  }
  BarModel model(structure, options);
  model.advance(loads);
  const Eigen::VectorXd moved = model.positions().col(0) - structure.rest.col(0);
  const double strain = moved.dot(structure.rest.col(0)) / structure.rest.col(0).squaredNorm();
  EXPECT_NEAR(stress / strain / material.youngs_modulus, 0.9, 0.15);
}

TEST(MeshBarsTest, NoBarPassesThroughTheHoleOfATorus) {
  const double ring = 0.1;
  const double tube = 0.03;
  const BarStructure structure = barsOf(torusMesh(ring, tube, 40, 16), {});
  for (const auto& [nodes, stiffness] : structure.bars) {
    const RowVector3d p = 0.5 * (structure.rest.row(nodes[0]) + structure.rest.row(nodes[1]));
    EXPECT_LT(std::hypot(std::hypot(p.x(), p.y()) - ring, p.z()), 1.1 * tube);
  }
}

TEST(MeshBarsTest, AnOpenMeshHasBarsAlongItsEdgesAndIsHeldInItsShape) {
  const TriangleMesh mesh = sheetMesh(0.1, 4);
  ElasticMaterial material;
  material.bedding = 1e5;
  const BarStructure structure = barsOf(mesh, material);
  EXPECT_EQ(structure.rest.rows(), 25);
  EXPECT_EQ(structure.bars.size(), 2U * 4U * 5U + 16U);
  EXPECT_NEAR(structure.foundation.sum(), 1e5 * 0.01, 1e-3);
  EXPECT_NEAR(structure.masses.sum(), 1000.0 * 0.003 * 0.01, 1e-9);
}

TEST(MeshBarsTest, AVertexWithoutATriangleIsFixed) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}}, {{0, 1, 2}});
  EXPECT_EQ(barsOf(mesh, {}).fixed, (std::vector<bool>{false, false, false, true}));
}

TEST(MeshBarsTest, RefusesAMaterialOutOfRange) {
  ElasticMaterial material;
  material.youngs_modulus = 0.0;
  EXPECT_TRUE(has(refusal([&] { barsOf(sheetMesh(1.0, 1), material); }), "Young's modulus"));
  material = {};
  material.inner_points = -1;
  EXPECT_TRUE(has(refusal([&] { barsOf(sheetMesh(1.0, 1), material); }), "inner_points"));
}

}  // namespace
}  // namespace sweep_guard_simulation
