#include "guard/displacements.h"

#include <gtest/gtest.h>

#include "common/xyz.h"
#include "scenes.h"

namespace sweep_guard_core {
namespace {

// As long as it is asked for: a strip.
TriangleMesh strip(size_t vertices, Random& random, double size, const Eigen::Vector3d& place_M) {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Triangle> triangles;
  for (size_t i = 0; i < vertices; ++i) {
    positions.emplace_back(place_M + random.inBox({size, size, size}));
    const auto index = static_cast<std::uint32_t>(i);
    if (i > 1) triangles.push_back({index - 2, index - 1, index});
  }
  return TriangleMesh(positions, triangles);
}

TriangleMesh shaken(const TriangleMesh& mesh, Random& random, double most) {
  std::vector<float> positions;
  for (size_t i = 0; i < mesh.vertexCount(); ++i) {
    const Eigen::Vector3d p = mesh.vertex(i) + random.inBox({most, most, most});
    for (const double x : xyz(p)) positions.push_back(static_cast<float>(x));
  }
  return deformed(mesh, positions);
}

// Every vertex in long double; none is outside, and the box is that of the vertices but for rounding.
void expectTight(const TriangleMesh& from, const TriangleMesh& to, double rounding) {
  const Displacements displacements(from, to);
  Eigen::AlignedBox3d tight;
  double farthest = 0.0;
  double least = kMaxCoordinate;
  for (size_t i = 0; i < from.vertexCount(); ++i) {
    using Exact = Eigen::Matrix<long double, 3, 1>;
    const Exact far = to.origin().cast<long double>() - from.origin().cast<long double>();
    const Exact displacement = far + (to.offset(i).cast<long double>() - from.offset(i).cast<long double>());
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_LE(static_cast<long double>(displacements.box_M().min()[axis]), displacement[axis]) << "vertex " << i;
      ASSERT_GE(static_cast<long double>(displacements.box_M().max()[axis]), displacement[axis]) << "vertex " << i;
    }
    tight.extend(displacement.cast<double>());
    farthest = std::max(farthest, static_cast<double>(displacement.norm()));
    least = std::min(least, static_cast<double>(displacement.norm()));
  }
  EXPECT_LE((displacements.box_M().min() - tight.min()).cwiseAbs().maxCoeff(), rounding);
  EXPECT_LE((displacements.box_M().max() - tight.max()).cwiseAbs().maxCoeff(), rounding);
  EXPECT_GE(displacements.upperBound() * (1.0 + 1e-15), farthest);
  EXPECT_LE(displacements.lowerBound() * (1.0 - 1e-15), least);
}

TEST(DisplacementsTest, HoldThatOfEveryVertexOfAnyMesh) {
  Random random(/*seed=*/1);
  for (size_t vertices = 3; vertices < 100; ++vertices) {
    SCOPED_TRACE(std::to_string(vertices) + " vertices");
    const TriangleMesh sent = strip(vertices, random, random.logUniform(0.01, 100.0), random.inBox({10, 10, 10}));
    const double most = random.logUniform(1e-6, 10.0);
    const TriangleMesh first = shaken(sent, random, most);
    expectTight(first, shaken(first, random, most), 1e-6 * most + 1e-7);
    expectTight(sent, first, 1e-4);
    expectTight(sent, strip(vertices, random, 1.0, random.inBox({1e6, 1e6, 1e6})), 1e-6);
  }
}

// Where the last of eight vertices, and the first and the last of all, are the only ones that move.
TEST(DisplacementsTest, SeeEachVertex) {
  Random random(/*seed=*/2);
  const TriangleMesh mesh = shaken(strip(37, random, 1.0, {0, 0, 0}), random, 0.0);
  std::vector<float> positions = mesh.places();
  for (size_t i = 0; i < positions.size(); ++i) {
    const float before = positions[i];
    positions[i] = 7.0F;
    EXPECT_EQ(Displacements(mesh, deformed(mesh, positions)).box_M().max()[static_cast<int>(i % 3)] > 5.0, true) << i;
    positions[i] = before;
  }
  EXPECT_FALSE(Displacements(mesh, deformed(mesh, positions)).any());
  EXPECT_EQ(Displacements(mesh, mesh).upperBound(), 0.0);
}

TEST(DisplacementsTest, AreBoundedByTheCornersOfTheirBox) {
  const TriangleMesh flat({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const TriangleMesh bent({{0, 0, 3}, {1, 0, 1}, {0, 1, 2}}, {{0, 1, 2}});
  const Displacements displacements(flat, bent);
  EXPECT_TRUE(displacements.any());
  EXPECT_NEAR(displacements.upperBound(), 3.0, 1e-6);
  EXPECT_NEAR(displacements.lowerBound(), 1.0, 1e-6);
}

const TriangleMesh kCorner({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});

std::shared_ptr<Workpiece> sheetAt(float z) {
  auto workpiece = std::make_shared<Workpiece>(Workpiece{"sheet", 0, {}, {}, "table", kCorner});
  std::vector<float> positions = {0, 0, z, 1, 0, z, 0, 1, z};
  workpiece->mesh_M.deform(positions);
  return workpiece;
}

double rise(const Displacements& displacements) { return displacements.box_M().center().z(); }

TEST(DisplacementCacheTest, KnowsEachPairOfDeformations) {
  DisplacementCache cache;
  const auto low = sheetAt(0.0F);
  const auto middle = sheetAt(1.0F);
  const auto high = sheetAt(3.0F);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(rise(cache.between(low, middle)), 1.0, 1e-6);
    EXPECT_NEAR(rise(cache.between(low, high)), 3.0, 1e-6);
    EXPECT_NEAR(rise(cache.between(middle, high)), 2.0, 1e-6);
    EXPECT_FALSE(cache.between(high, high).any());
  }
}

// A snapshot never changes; this one does, so that a second look would show.
TEST(DisplacementCacheTest, LooksOnceAtWhatIsAskedForAgainAndAgain) {
  DisplacementCache cache;
  const auto low = sheetAt(0.0F);
  const auto high = sheetAt(1.0F);
  cache.between(low, high);
  std::vector<float> positions = {0, 0, 2, 1, 0, 2, 0, 1, 2};
  high->mesh_M.deform(positions);
  for (int sweep = 0; sweep < 3; ++sweep) {
    EXPECT_NEAR(rise(cache.between(low, high)), 1.0, 1e-6);
    cache.forgetUnused();
  }
  cache.forgetUnused();
  EXPECT_NEAR(rise(cache.between(low, high)), 2.0, 1e-6);
}

TEST(DisplacementCacheTest, KeepsNoDeformationThatNobodyAsksFor) {
  DisplacementCache cache;
  std::weak_ptr<Workpiece> low;
  {
    const auto from = sheetAt(0.0F);
    low = from;
    cache.between(from, sheetAt(1.0F));
  }
  cache.forgetUnused();
  EXPECT_FALSE(low.expired());
  cache.forgetUnused();
  EXPECT_TRUE(low.expired());
}

}  // namespace
}  // namespace sweep_guard_core
