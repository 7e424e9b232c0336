#include "sweep_guard/geometry/link_surface.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scenes.h"

namespace sweep_guard_core {
namespace {

double supportOf(const LinkSurface& surface, const Eigen::Vector3d& direction) {
  double farthest = -1e9;
  for (const Eigen::Vector3d& p : surface.vertices_B) farthest = std::max(farthest, direction.dot(p));
  return farthest;
}

std::vector<ConvexShape> shapesOf(Random& random) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(20);
  for (int i = 0; i < 20; ++i) points.push_back(random.inBox({0.1, 0.05, 0.02}));
  return {ConvexShape::cylinder(0.01, 0.15), ConvexShape::cylinder(0.3, 0.02, 5), ConvexShape::sphere(0.05),
          ConvexShape::box({0.1, 0.02, 0.3}), ConvexShape::hull(points)};
}

// What a polyhedron with its corners on the round body lacks of it, the padding and a hundredth of a millimeter.
double lackOf(const ConvexShape& shape_B) {
  double lack = 0.0;
  Random random(7);
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3d direction = random.direction();
    double farthest = -1e9;
    for (size_t v = 0; v < shape_B.mesh_T().vertexCount(); ++v)
      farthest = std::max(farthest, direction.dot(shape_B.mesh_T().vertex(v)));
    lack = std::max(lack, shape_B.support(direction) - farthest);
  }
  return lack + 1e-5;
}

void expectSurfaceHolds(const LinkSurface& surface, const ConvexShape& shape_B) {
  for (const auto& [a, b, c] : surface.triangles) {
    const Eigen::Vector3d& p = surface.vertices_B[a];
    const Eigen::Vector3d normal = (surface.vertices_B[b] - p).cross(surface.vertices_B[c] - p).normalized();
    EXPECT_LE(shape_B.support(normal), normal.dot(p) + 1e-12) << "no point of the link is in front of a face";
  }
}

void expectLittleElse(const LinkSurface& surface, const ConvexShape& shape_B, Random& random) {
  double farthest = 0.0;
  for (int d = 0; d < 500; ++d) {
    const Eigen::Vector3d direction = random.direction();
    farthest = std::max(farthest, supportOf(surface, direction) - shape_B.support(direction));
  }
  EXPECT_LE(farthest, 1.3 * lackOf(shape_B));
}

TEST(LinkSurfaceTest, HoldsTheLinkAndLittleElse) {
  Random random(5);
  for (int i = 0; i < 10; ++i) {
    for (const ConvexShape& shape : shapesOf(random)) {
      const double padding = random.chance(0.5) ? 0.0 : random.uniform(0.0, 0.02);
      const ConvexShape shape_B = shape.padded(padding).placed(random.pose(random.inBox({1.0, 1.0, 1.0})));
      const std::vector<LinkSurface> surfaces = linkSurfaces(Tool(shape_B));
      ASSERT_EQ(surfaces.size(), 1U);
      expectSurfaceHolds(surfaces[0], shape_B);
      expectLittleElse(surfaces[0], shape_B, random);
    }
  }
}

// As of a ball that the tool carries.
TEST(LinkSurfaceTest, HoldsALinkOfThousandsOfCornersAndLittleElse) {
  Random random(8);
  const TriangleMesh waves = wavyHull(/*rings=*/50, /*sectors=*/50, 0.0);
  std::vector<Eigen::Vector3d> on_ball;
  for (size_t i = 0; i < waves.vertexCount(); ++i) on_ball.emplace_back(0.05 * waves.vertex(i).normalized());
  const ConvexShape shape_B = ConvexShape::hull(on_ball).padded(0.001);
  ASSERT_EQ(shape_B.mesh_T().vertexCount(), on_ball.size());
  const LinkSurface surface = linkSurfaces(Tool(shape_B))[0];
  expectSurfaceHolds(surface, shape_B);
  expectLittleElse(surface, shape_B, random);
  EXPECT_TRUE(TriangleMesh(surface.vertices_B, surface.triangles).closed());
}

TEST(LinkSurfaceTest, IsClosed) {
  Random random(6);
  for (const ConvexShape& shape : shapesOf(random)) {
    const LinkSurface surface = linkSurfaces(Tool(shape))[0];
    const TriangleMesh mesh(surface.vertices_B, surface.triangles);
    EXPECT_TRUE(mesh.closed());
    for (size_t i = 0; i < mesh.triangles().size(); ++i) EXPECT_EQ(mesh.enclosure().role(i), Enclosure::Role::kOutward);
  }
}

TEST(LinkSurfaceTest, HoldsAllPiecesOfALink) {
  const Eigen::Isometry3d aside(Eigen::Translation3d(1.0, 0.0, 0.0));
  const Tool body({{"hand", ConvexShape::box({0.1, 0.1, 0.1})},
                   {"finger", ConvexShape::sphere(0.02)},
                   {"hand", ConvexShape::box({0.1, 0.1, 0.1}).placed(aside)}});
  const std::vector<LinkSurface> surfaces = linkSurfaces(body);
  ASSERT_EQ(surfaces.size(), 2U);
  EXPECT_EQ(surfaces[0].link, "hand");
  const LinkSurface alone = linkSurfaces(Tool(ConvexShape::box({0.1, 0.1, 0.1})))[0];
  EXPECT_EQ(surfaces[0].vertices_B.size(), 2 * alone.vertices_B.size());
  EXPECT_EQ(surfaces[0].triangles.size(), 2 * alone.triangles.size());
  EXPECT_EQ(surfaces[1].link, "finger");
}

}  // namespace
}  // namespace sweep_guard_core
