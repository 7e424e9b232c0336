#include "sweep_guard/geometry/decomposition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "scenes.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/geometry/convex_hull.h"

namespace sweep_guard_core {
namespace {

using Sets = std::vector<std::vector<std::uint32_t>>;

struct Surface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;
  TriangleMesh mesh() const { return TriangleMesh(vertices, triangles); }
};

// Adds a box with sides of `cells` x `cells` squares.
void addBox(Surface& surface, const Eigen::Vector3d& lower, const Eigen::Vector3d& upper, int cells) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double level : {0.0, 1.0}) {
      const auto first = static_cast<std::uint32_t>(surface.vertices.size());
      const auto vertex = [&](int i, int k) { return first + static_cast<std::uint32_t>(i * (cells + 1) + k); };
      for (int i = 0; i <= cells; ++i) {
        for (int k = 0; k <= cells; ++k) {
          Eigen::Vector3d place;
          place[axis] = level;
          place[(axis + 1) % 3] = static_cast<double>(i) / cells;
          place[(axis + 2) % 3] = static_cast<double>(k) / cells;
          surface.vertices.emplace_back(lower + place.cwiseProduct(upper - lower));
          if (i == cells || k == cells) continue;
          surface.triangles.push_back({vertex(i, k), vertex(i + 1, k), vertex(i + 1, k + 1)});
          surface.triangles.push_back({vertex(i, k), vertex(i + 1, k + 1), vertex(i, k + 1)});
        }
      }
    }
  }
}

using Box = std::pair<Eigen::Vector3d, Eigen::Vector3d>;  // its lower and upper corner

Surface boxes(const std::vector<Box>& corners, int cells) {
  Surface surface;
  for (const auto& [lower, upper] : corners) addBox(surface, lower, upper, cells);
  return surface;
}

TriangleMesh boxMesh() {
  Surface surface;
  addBox(surface, {0, 0, 0}, {0.1, 0.03, 0.02}, /*cells=*/6);
  return surface.mesh();
}

// Makes an L of two bars, each 100 mm long and 10 mm thick.
TriangleMesh angleMesh() {
  Surface surface;
  addBox(surface, {0, 0, 0}, {0.1, 0.01, 0.01}, /*cells=*/10);
  addBox(surface, {0, 0.01, 0}, {0.01, 0.1, 0.01}, /*cells=*/10);
  return surface.mesh();
}

TriangleMesh triangleSoup(Random& random, int triangles, double size, const Eigen::Vector3d& place) {
  Surface soup;
  for (int i = 0; i < triangles; ++i) {
    const Eigen::Vector3d middle = place + random.inBox(Eigen::Vector3d::Constant(size));
    const double extent = size * random.logUniform(1e-4, 1.0);
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (int k = 0; k < 3; ++k) soup.vertices.emplace_back(middle + extent * random.direction());
    soup.triangles.push_back({first, first + 1, random.chance(0.9) ? first + 2 : first});
  }
  return soup.mesh();
}

void expectPartition(const TriangleMesh& mesh, const Sets& sets) {
  std::vector<int> uses(mesh.triangles().size(), 0);
  for (const std::vector<std::uint32_t>& set : sets) {
    EXPECT_FALSE(set.empty());
    EXPECT_TRUE(std::is_sorted(set.begin(), set.end()));
    for (const std::uint32_t i : set) ++uses.at(i);
  }
  for (const int count : uses) EXPECT_EQ(count, 1);
}

void expectPartsHold(const TriangleMesh& mesh, const Sets& sets, const std::vector<ConvexShape>& parts,
                     Random& random) {
  ASSERT_EQ(parts.size(), sets.size());
  for (size_t i = 0; i < parts.size(); ++i) {
    for (int k = 0; k < 50; ++k) {
      const Eigen::Vector3d direction = random.direction();
      double corners = -std::numeric_limits<double>::infinity();
      for (const std::uint32_t triangle : sets[i]) {
        for (const std::uint32_t v : mesh.triangles()[triangle]) {
          corners = std::max(corners, direction.dot(mesh.vertex(v)));
        }
      }
      EXPECT_LE(corners, parts[i].support(direction) + 1e-15 * (1.0 + mesh.radius()));
    }
  }
}

TEST(DecompositionTest, PutsEveryTriangleIntoOneSet) {
  Random random(/*seed=*/1);
  for (int i = 0; i < 30; ++i) {
    const double size = random.logUniform(1e-4, 10.0);
    const TriangleMesh mesh =
        triangleSoup(random, 1 + random.below(200), size, random.logUniform(1e-3, 1e3) * random.direction());
    DecompositionOptions options;
    options.max_depth = random.below(8);
    options.least_saving = random.chance(0.5) ? 0.0 : 0.01;
    const Sets sets = decompose(mesh, options);
    SCOPED_TRACE("soup " + std::to_string(i));
    expectPartition(mesh, sets);
    EXPECT_LE(sets.size(), size_t{1} << static_cast<unsigned>(options.max_depth));
  }
}

// Each convex piece reaches in every direction at least as far as the corners of its triangles.
TEST(DecompositionTest, PiecesContainTheirTriangles) {
  Random random(/*seed=*/2);
  for (int i = 0; i < 30; ++i) {
    const double size = random.logUniform(1e-4, 10.0);
    const TriangleMesh mesh = triangleSoup(random, 1 + random.below(200), size, random.direction());
    const DecompositionOptions options{/*max_depth=*/random.below(8), /*step=*/0.002, /*least_saving=*/0.001};
    SCOPED_TRACE("soup " + std::to_string(i));
    expectPartsHold(mesh, decompose(mesh, options), convexPieces(mesh, options), random);
  }
}

TEST(DecompositionTest, LeavesAConvexMeshWhole) {
  for (const double least_saving : {0.0, 0.01}) {
    EXPECT_EQ(decompose(boxMesh(), {/*max_depth=*/6, /*step=*/0.005, least_saving}).size(), 1U);
  }
}

TEST(DecompositionTest, LeavesAFlatConvexMeshWhole) {
  Surface square;
  addBox(square, {0, 0, 0}, {0.1, 0.1, 0.0}, /*cells=*/5);
  EXPECT_EQ(decompose(square.mesh()).size(), 1U);
}

TEST(DecompositionTest, DepthZeroIsOneHull) { EXPECT_EQ(decompose(angleMesh(), {/*max_depth=*/0}).size(), 1U); }

double sumOfHulls(const TriangleMesh& mesh, const Sets& sets) {
  double sum = 0.0;
  for (const std::vector<std::uint32_t>& set : sets) {
    std::vector<Eigen::Vector3d> corners;
    for (const std::uint32_t i : set) {
      for (const std::uint32_t vertex : mesh.triangles()[i]) corners.push_back(mesh.vertex(vertex));
    }
    sum += volume(convexHull(corners));
  }
  return sum;
}

// The bars have 19 cm^3 together; the hull is 10 mm times the 100 mm square minus half a square of 90 mm: 59.5 cm^3.
TEST(DecompositionTest, CutsAnAngleIntoItsBars) {
  const TriangleMesh mesh = angleMesh();
  const Sets sets = decompose(mesh);
  EXPECT_GE(sets.size(), 2U);
  EXPECT_LE(sets.size(), 8U);
  EXPECT_NEAR(sumOfHulls(mesh, {decompose(mesh, {/*max_depth=*/0})}), 59.5e-6, 1e-9);
  EXPECT_LT(sumOfHulls(mesh, sets), 22e-6);
}

// The first cut gains nothing, because each half of the ring has half of the hull; later cuts do.
TEST(DecompositionTest, CutsARing) {
  Surface ring;
  for (const double side : {-1.0, 1.0}) {
    addBox(ring, {-0.05, 0.05 * side - 0.005, 0}, {0.05, 0.05 * side + 0.005, 0.01}, /*cells=*/8);
    addBox(ring, {0.05 * side - 0.005, -0.05, 0}, {0.05 * side + 0.005, 0.05, 0.01}, /*cells=*/8);
  }
  const TriangleMesh mesh = ring.mesh();
  EXPECT_LT(sumOfHulls(mesh, decompose(mesh)), 0.7 * sumOfHulls(mesh, decompose(mesh, {/*max_depth=*/0})));
}

TEST(DecompositionTest, LeavesABallWhole) {
  Surface ball;
  addBox(ball, {-1, -1, -1}, {1, 1, 1}, /*cells=*/12);
  for (Eigen::Vector3d& p : ball.vertices) p *= 0.1 / p.norm();
  EXPECT_EQ(decompose(ball.mesh()).size(), 1U);
}

// Separating a casing from its contents gains nothing.
TEST(DecompositionTest, DoesNotSeparateACasingFromItsContents) {
  const Surface casing = boxes({{{0, 0, 0}, {0.1, 0.06, 0.04}}, {{0.02, 0.01, 0.01}, {0.03, 0.05, 0.02}}}, /*cells=*/6);
  EXPECT_EQ(decompose(casing.mesh()).size(), 1U);
}

// A hand and two fingers: a cut across the hand would join each finger to half of the hand.
TEST(DecompositionTest, SeparatesComponents) {
  Surface hand;
  addBox(hand, {-0.1, -0.03, -0.06}, {0.1, 0.03, 0}, /*cells=*/6);
  addBox(hand, {-0.05, -0.01, 0.001}, {-0.03, 0.01, 0.05}, /*cells=*/6);
  addBox(hand, {0.03, -0.01, 0.001}, {0.05, 0.01, 0.05}, /*cells=*/6);
  for (Triangle& triangle : hand.triangles) {  // each triangle has vertices of its own, as in STL files
    for (std::uint32_t& vertex : triangle) {
      hand.vertices.push_back(hand.vertices[vertex]);
      vertex = static_cast<std::uint32_t>(hand.vertices.size() - 1);
    }
  }
  EXPECT_EQ(decompose(hand.mesh()).size(), 3U);
}

// Two squares in one plane have no volume, but their common hull sweeps more than both squares.
TEST(DecompositionTest, SeparatesFlatSquares) {
  const Surface squares = boxes({{{0, 0, 0}, {0.01, 0.01, 0}}, {{0.09, 0, 0}, {0.1, 0.01, 0}}}, /*cells=*/3);
  EXPECT_EQ(decompose(squares.mesh()).size(), 2U);
}

TEST(DecompositionTest, IsNoLooserWithMoreDepth) {
  size_t before = 1;
  for (const int depth : {0, 1, 2, 3, 4, 5, 6}) {
    const size_t sets = decompose(angleMesh(), {depth, /*step=*/0.005, /*least_saving=*/0.001}).size();
    EXPECT_GE(sets, before);
    before = sets;
  }
}

// No cut separates copies of one triangle.
TEST(DecompositionTest, EndsWhereNothingCanBeCut) {
  const std::vector<Eigen::Vector3d> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 1}};
  const TriangleMesh mesh(corners, std::vector<Triangle>(50, {0, 1, 2}));
  EXPECT_EQ(decompose(mesh, {/*max_depth=*/16, /*step=*/0.0, /*least_saving=*/0.0}).size(), 1U);
}

TEST(DecompositionTest, RefusesOptionsOutOfRange) {
  const TriangleMesh mesh = boxMesh();
  EXPECT_THROW(decompose(mesh, {/*max_depth=*/-1}), InvalidInput);
  EXPECT_THROW(decompose(mesh, {/*max_depth=*/17}), InvalidInput);
  EXPECT_THROW(decompose(mesh, {/*max_depth=*/6, /*step=*/-1e-9}), InvalidInput);
  EXPECT_THROW(decompose(mesh, {/*max_depth=*/6, /*step=*/std::nan("")}), InvalidInput);
  EXPECT_THROW(decompose(mesh, {/*max_depth=*/6, /*step=*/0.005, /*least_saving=*/-0.1}), InvalidInput);
  EXPECT_THROW(decompose(mesh, {/*max_depth=*/6, /*step=*/0.005, /*least_saving=*/std::nan("")}), InvalidInput);
}

}  // namespace
}  // namespace sweep_guard_core
