#include "sweep_guard/geometry/enclosure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "solids.h"

namespace sweep_guard_core {
namespace {

size_t closedCount(const SentSurface& surface) { return surface.mesh().enclosure().closedTriangles().size(); }

double signedVolume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.enclosure().closedTriangles())
    sum += mesh.offset(a).dot(mesh.offset(b).cross(mesh.offset(c))) / 6.0;
  return sum;
}

TEST(EnclosureTest, OfSeparateTrianglesIsThatOfTheSolid) {
  for (const std::uint32_t cells : {1U, 3U, 40U}) {
    const TriangleMesh mesh = cubeSurface(0.2, cells).separate().mesh();
    EXPECT_TRUE(mesh.closed());
    EXPECT_EQ(mesh.enclosure().closedTriangles().size(), 12 * cells * cells);
    EXPECT_NEAR(signedVolume(mesh), 0.4 * 0.4 * 0.4, 1e-8);
  }
}

TEST(EnclosureTest, WeldsCornersThatDifferByLittle) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> jitter(-2e-7, 2e-7);
  SentSurface surface = cubeSurface(0.5, 5).separate();
  for (Eigen::Vector3d& vertex : surface.vertices)
    vertex += Eigen::Vector3d(jitter(random), jitter(random), jitter(random));
  EXPECT_TRUE(surface.mesh().closed());
  for (Eigen::Vector3d& vertex : surface.vertices)
    vertex += 100.0 * Eigen::Vector3d(jitter(random), jitter(random), 0.0);
  EXPECT_FALSE(surface.mesh().closed());
}

TEST(EnclosureTest, TurnsTrianglesOutwardsHoweverTheyWereSent) {
  std::mt19937 random(2);
  SentSurface surface = cubeSurface(0.5, 4);
  for (Triangle& triangle : surface.triangles) {
    if (random() % 2 == 0) std::swap(triangle[0], triangle[1]);
  }
  const TriangleMesh mesh = surface.mesh();
  EXPECT_NEAR(signedVolume(mesh), 1.0, 1e-6);
  EXPECT_NEAR(signedVolume(cubeSurface(0.5, 4).reversed().mesh()), 1.0, 1e-6);
  for (size_t i = 0; i < surface.triangles.size(); ++i) {
    const bool is_turned = surface.triangles[i] != cubeSurface(0.5, 4).triangles[i];
    EXPECT_EQ(mesh.enclosure().role(i), is_turned ? Enclosure::Role::kReversed : Enclosure::Role::kOutward);
  }
}

TEST(EnclosureTest, KeepsOneOfFacesThatAreThereSeveralTimes) {
  const SentSurface cube = cubeSurface(0.5, 2);
  SentSurface same = cube;
  SentSurface reversed = cube;
  SentSurface some = cube;
  same.add(cube).add(cube);
  reversed.add(cube.reversed());
  some.add(cube.reversed().without(3).without(20));
  for (const SentSurface& surface : {same, reversed, some}) {
    EXPECT_TRUE(surface.mesh().closed());
    EXPECT_EQ(closedCount(surface), cube.triangles.size());
    EXPECT_NEAR(signedVolume(surface.mesh()), 1.0, 1e-6);
    EXPECT_EQ(surface.mesh().enclosure().role(cube.triangles.size()), Enclosure::Role::kLeftOut);
  }
}

TEST(EnclosureTest, OfAShellReversedWithinAnotherIsACavity) {
  SentSurface hollow = cubeSurface(0.5, 3);
  hollow.add(cubeSurface(0.25, 2).reversed());
  EXPECT_NEAR(signedVolume(hollow.mesh()), 1.0 - 0.125, 1e-6);
  EXPECT_NEAR(signedVolume(hollow.reversed().mesh()), 1.0 - 0.125, 1e-6);
  EXPECT_NEAR(signedVolume(hollow.separate().mesh()), 1.0 - 0.125, 1e-6);
  SentSurface solid = cubeSurface(0.5, 3);
  solid.add(cubeSurface(0.25, 2));
  EXPECT_NEAR(signedVolume(solid.mesh()), 1.0 + 0.125, 1e-6);
}

SentSurface bar(double length_x, double length_y, double length_z) {
  return cubeSurface(0.5).moved(Eigen::Affine3d(Eigen::Scaling(length_x, length_y, length_z)));
}

TEST(EnclosureTest, SaysWhereClosedPartsOverlap) {
  SentSurface corner_in_face = cubeSurface(0.5, 3);
  corner_in_face.add(cubeSurface(0.25, 2).movedBy(0.6, 0.1, 0.0));
  SentSurface crossing_bars = bar(1.0, 0.1, 0.1);  // no corner of one lies in the other
  crossing_bars.add(bar(0.07, 1.0, 0.07));
  SentSurface crossing_flush = bar(1.0, 0.1, 0.1);
  crossing_flush.add(bar(0.1, 1.0, 0.1));
  SentSurface nested = cubeSurface(0.5, 3);
  nested.add(cubeSurface(0.25, 2));
  SentSurface of_three = cubeSurface(0.5).movedBy(-5.0, 0.0, 0.0);
  of_three.add(corner_in_face);
  SentSurface flush_inside = cubeSurface(0.5);
  flush_inside.add(cubeSurface(0.1).movedBy(-0.25, 0.2, -0.4));
  for (const SentSurface& surface : {corner_in_face, crossing_bars, crossing_flush, nested, of_three, flush_inside}) {
    EXPECT_TRUE(surface.mesh().enclosure().partsOverlap());
    EXPECT_TRUE(surface.separate().mesh().enclosure().partsOverlap());
    EXPECT_TRUE(surface.reversed().mesh().enclosure().partsOverlap());
  }
}

TEST(EnclosureTest, ClosedPartsThatOnlyTouchOrLieInCavitiesDoNotOverlap) {
  SentSurface hollow = cubeSurface(0.5, 3);
  hollow.add(cubeSurface(0.25, 2).reversed());
  SentSurface island = hollow;
  island.add(cubeSurface(0.1));
  SentSurface on_a_table = bar(2.0, 2.0, 0.1);
  on_a_table.add(cubeSurface(0.2, 2).movedBy(0.1, 0.2, 0.25));
  SentSurface apart = cubeSurface(0.5, 3);
  apart.add(cubeSurface(0.25, 2).movedBy(0.76, 0.0, 0.0));
  SentSurface around_a_bar = bar(3.0, 0.1, 0.1);  // in its box, and beside it
  around_a_bar.add(cubeSurface(0.2).movedBy(0.0, 0.3, 0.0));
  SentSurface side_by_side = cubeSurface(0.5, 2);
  side_by_side.add(cubeSurface(0.5, 2).movedBy(1.0, 0.0, 0.0));
  for (const SentSurface& surface :
       {cubeSurface(0.5, 3), hollow, island, on_a_table, apart, around_a_bar, side_by_side, plate(1.0)}) {
    EXPECT_FALSE(surface.mesh().enclosure().partsOverlap());
    EXPECT_FALSE(surface.separate().mesh().enclosure().partsOverlap());
  }
}

// 120 000 triangles of two shells that are 1 cm apart, and small parts that one of them has around it.
TEST(EnclosureTest, LargeClosedPartsThatDoNotOverlapAreKnownNotTo) {
  SentSurface surface = cubeSurface(0.5, 100);
  surface.add(cubeSurface(0.49, 100).reversed());
  for (int i = 0; i < 100; ++i)
    surface.add(cubeSurface(0.01).movedBy(0.04 * (i % 10) - 0.2, 0.04 * (i / 10) - 0.2, 0.0));
  EXPECT_FALSE(surface.mesh().enclosure().partsOverlap());
  surface.add(cubeSurface(0.01).movedBy(0.5, 0.1, 0.2));
  EXPECT_TRUE(surface.mesh().enclosure().partsOverlap());
}

TEST(EnclosureTest, MoreClosedPartsThanAreLookedAtMayOverlap) {
  SentSurface heap;
  for (int i = 0; i < 1001; ++i) heap.add(cubeSurface(0.1).movedBy(i, 0.0, 0.0));
  EXPECT_TRUE(heap.mesh().enclosure().partsOverlap());
  EXPECT_EQ(closedCount(heap), 12U * 1001U);
}

TEST(EnclosureTest, OfAReversedSolidThatIsNotWithinTheOtherIsASolid) {
  for (const double x : {0.4, 0.7, 3.0}) {
    SentSurface two = cubeSurface(0.5, 3);
    two.add(cubeSurface(0.25, 2).reversed().movedBy(x, 0.0, 0.0));
    EXPECT_NEAR(signedVolume(two.mesh()), 1.0 + 0.125, 1e-6) << x;
  }
  SentSurface in_the_box_of_a_frame = cubeSurface(0.1).reversed().movedBy(0.55, 0.55, 0.55);
  const double tetrahedron[4][3] = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
  for (const auto& corner : tetrahedron)
    in_the_box_of_a_frame.vertices.emplace_back(-Eigen::Vector3d(corner[0], corner[1], corner[2]));
  in_the_box_of_a_frame.triangles.insert(in_the_box_of_a_frame.triangles.end(),
                                         {{24, 25, 26}, {24, 27, 25}, {24, 26, 27}, {25, 27, 26}});
  EXPECT_NEAR(signedVolume(in_the_box_of_a_frame.mesh()), 8.0 / 3.0 + 0.008, 1e-6);
}

TEST(EnclosureTest, LeavesOutFinsAndPlatesInside) {
  const SentSurface cube = cubeSurface(0.5, 2);
  SentSurface with_plate = cube;
  with_plate.add(plate(0.5, 2));  // its border lies on edges of the cube
  SentSurface with_fin = cube;
  with_fin.vertices.emplace_back(0.0, 0.0, 2.0);
  with_fin.triangles.push_back({0, 1, static_cast<std::uint32_t>(with_fin.vertices.size() - 1)});
  SentSurface glued = cube.movedBy(-0.5, 0.0, 0.0);
  glued.add(cube.movedBy(0.5, 0.0, 0.0));
  for (const SentSurface& surface : {with_plate, with_fin, with_plate.separate()}) {
    EXPECT_EQ(surface.mesh().openEdges(), 0U);
    EXPECT_NEAR(signedVolume(surface.mesh()), 1.0, 1e-6);
  }
  EXPECT_EQ(glued.mesh().openEdges(), 0U);
  EXPECT_NEAR(signedVolume(glued.mesh()), 2.0, 1e-6);
}

TEST(EnclosureTest, SolidsThatShareAnEdgeOrACornerAreTwoSolids) {
  for (const Eigen::Vector3d& shift : {Eigen::Vector3d(1.0, 1.0, 0.0), Eigen::Vector3d(1.0, 1.0, 1.0)}) {
    SentSurface two = cubeSurface(0.5, 2);
    two.add(cubeSurface(0.5, 2).reversed().movedBy(shift.x(), shift.y(), shift.z()));
    EXPECT_EQ(two.mesh().openEdges(), 0U);
    EXPECT_NEAR(signedVolume(two.mesh()), 2.0, 1e-6);
  }
}

TEST(EnclosureTest, CountsTheEdgesAtBorders) {
  EXPECT_EQ(cubeSurface(0.2).without(5).mesh().openEdges(), 3U);
  EXPECT_EQ(cubeSurface(0.2).without(5).separate().mesh().openEdges(), 3U);
  EXPECT_EQ(plate(1.0, 3).mesh().openEdges(), 12U);
  SentSurface beside = cubeSurface(0.2);
  beside.add(plate(1.0).movedBy(0.0, 0.0, 2.0));
  EXPECT_EQ(beside.mesh().openEdges(), 4U);
  EXPECT_EQ(closedCount(beside), 12U);
  EXPECT_EQ(plate(1.0).mesh(/*is_sheet=*/true).openEdges(), 0U);
}

TEST(EnclosureTest, HoldsNoMoreThanSixteenBytesATriangle) {
  for (const SentSurface& surface : {cubeSurface(0.5, 30), cubeSurface(0.5, 30).separate(), plate(1.0, 60)}) {
    const TriangleMesh mesh = surface.mesh();
    const Enclosure& enclosure = mesh.enclosure();
    const size_t bytes =
        (enclosure.closedTriangles().capacity() + enclosure.openTriangles().capacity()) * sizeof(Triangle) +
        enclosure.openParts().capacity() * sizeof(Enclosure::OpenPart) + surface.triangles.size();
    EXPECT_LE(bytes, 16 * surface.triangles.size());
  }
}

TEST(EnclosureTest, OfAMoebiusStripAndOfSingleTrianglesIsNothing) {
  SentSurface strip;
  for (std::uint32_t i = 0; i < 12; ++i) {
    const double angle = 2.0 * M_PI * i / 12.0;
    for (const double side : {-0.3, 0.3}) {
      const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0.0);
      strip.vertices.emplace_back((1.0 + side * std::cos(angle / 2.0)) * out +
                                  Eigen::Vector3d(0.0, 0.0, side * std::sin(angle / 2.0)));
    }
  }
  for (std::uint32_t i = 0; i < 12; ++i) {
    const std::uint32_t a = 2 * i;
    const std::uint32_t c = i == 11 ? 1 : a + 2;
    const std::uint32_t d = i == 11 ? 0 : a + 3;
    strip.triangles.push_back({a, a + 1, c});
    strip.triangles.push_back({a + 1, d, c});
  }
  EXPECT_GE(strip.mesh().openEdges(), 24U);
  EXPECT_EQ(closedCount(strip), 0U);
  SentSurface heap;
  for (int i = 0; i < 20; ++i) heap.add(plate(0.1).without(0).movedBy(i, 0.0, 0.0));
  EXPECT_EQ(heap.mesh().openEdges(), 60U);
  EXPECT_EQ(closedCount(heap), 0U);
}

TEST(EnclosureTest, IsTheSameInAnyOrderOfTriangles) {
  std::mt19937 random(3);
  SentSurface hollow = cubeSurface(0.5, 3);
  hollow.add(cubeSurface(0.25, 2).reversed()).add(plate(0.5, 3).movedBy(0.0, 0.0, 0.5 / 3.0));
  for (int i = 0; i < 20; ++i) {
    std::shuffle(hollow.triangles.begin(), hollow.triangles.end(), random);
    EXPECT_NEAR(signedVolume(hollow.mesh()), 1.0 - 0.125, 1e-6);
    EXPECT_EQ(hollow.mesh().openEdges(), 0U);
  }
}

}  // namespace
}  // namespace sweep_guard_core
