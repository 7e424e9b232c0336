// Triangles that are sent corner by corner get their shared vertices back, and stay the same while the corners agree.
#include "scene/welding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "refusal.h"
#include "solids.h"

namespace sweep_guard_core {
namespace {

using Corners = std::vector<Eigen::Vector3d>;

const Eigen::Vector3d kA(0, 0, 0), kB(1, 0, 0), kC(0, 1, 0), kD(1, 1, 0);
const Corners kSquare = {kA, kB, kC, kC, kB, kD};
const std::vector<Triangle> kSquareTriangles = {{0, 1, 2}, {2, 1, 3}};

TEST(WeldingTest, CornersAtTheSamePositionShareAVertexInOrderOfAppearance) {
  const TriangleSurface surface = Welding().weld(kSquare);
  EXPECT_EQ(surface.vertices, (Corners{kA, kB, kC, kD}));
  EXPECT_EQ(surface.triangles, kSquareTriangles);
}

TEST(WeldingTest, AClosedMeshIsClosedAgain) {
  const SentSurface cube = cubeSurface(0.5, 4);
  const TriangleSurface surface = Welding().weld(cube.separate().vertices);
  EXPECT_EQ(surface.vertices.size(), 6U * 4U * 4U + 2U);
  EXPECT_TRUE(TriangleMesh(surface.vertices, surface.triangles).closed());
  for (size_t i = 0; i < cube.triangles.size(); ++i) {
    for (const size_t k : {0U, 1U, 2U}) {
      EXPECT_EQ(surface.vertices[surface.triangles[i][k]], cube.vertices[cube.triangles[i][k]]);
    }
  }
}

TEST(WeldingTest, MovedVerticesKeepTheTriangles) {
  Welding welding;
  welding.weld(kSquare);
  Corners moved;
  for (const Eigen::Vector3d& p : kSquare) moved.emplace_back(2.0 * p + Eigen::Vector3d(0, 0, p.x() * p.y()));
  const TriangleSurface surface = welding.weld(moved);
  EXPECT_EQ(surface.vertices, (Corners{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 1}}));
  EXPECT_EQ(surface.triangles, kSquareTriangles);
}

TEST(WeldingTest, AVertexWhoseCornersPartBecomesTwo) {
  Welding welding;
  welding.weld(kSquare);
  Corners torn = kSquare;
  torn[3].z() = 0.1;
  EXPECT_EQ(welding.weld(torn).triangles, (std::vector<Triangle>{{0, 1, 2}, {3, 1, 4}}));
  EXPECT_EQ(welding.weld(kSquare).triangles, (std::vector<Triangle>{{0, 1, 2}, {3, 1, 4}}));
}

TEST(WeldingTest, VerticesThatMeetLaterRemainTwo) {
  Welding welding;
  welding.weld(kSquare);
  Corners folded = kSquare;
  folded[5] = kA;
  const TriangleSurface surface = welding.weld(folded);
  EXPECT_EQ(surface.vertices, (Corners{kA, kB, kC, kA}));
  EXPECT_EQ(surface.triangles, kSquareTriangles);
}

TEST(WeldingTest, AnotherNumberOfCornersIsSearchedAnew) {
  Welding welding;
  welding.weld(kSquare);
  EXPECT_EQ(welding.weld({kB, kC, kD}).triangles, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_TRUE(welding.weld({}).triangles.empty());
}

TEST(WeldingTest, NegativeZeroIsZero) {
  const Eigen::Vector3d negative(-0.0, -0.0, -0.0);
  EXPECT_EQ(Welding().weld({kA, kB, kC, kC, kB, negative}).triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 0}}));
}

TEST(WeldingTest, TheSmallestDifferenceKeepsCornersApart) {
  const Eigen::Vector3d near(std::nextafter(1.0, 2.0), 0, 0);
  EXPECT_EQ(Welding().weld({kA, kB, near}).vertices.size(), 3U);
}

TEST(WeldingTest, ACornerThatIsNotFiniteIsRefusedAndChangesNothing) {
  Welding welding;
  welding.weld(kSquare);
  for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Corners corners = kSquare;
    corners[4].y() = wrong;
    EXPECT_EQ(refusal([&] { welding.weld(corners); }), "corner 4 of the triangles is not finite");
    EXPECT_EQ(welding.weld(kSquare).triangles, kSquareTriangles);
  }
}

TEST(WeldingTest, ANumberOfCornersThatIsNotAMultipleOfThreeIsRefused) {
  EXPECT_EQ(refusal([] { Welding().weld({kA, kB, kC, kD}); }), "triangles have 4 corners: send three for each");
}

}  // namespace
}  // namespace sweep_guard_core
