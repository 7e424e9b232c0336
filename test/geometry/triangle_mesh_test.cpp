#include "sweep_guard/geometry/triangle_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "common/floating_point.h"
#include "refusal.h"
#include "scenes.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// One triangle and an unused vertex.
const std::vector<Eigen::Vector3d> kVertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::vector<Triangle> kTriangles = {{0, 1, 2}};

// Returns the error text for a mesh; empty if it is accepted.
std::string complaint(const std::vector<Eigen::Vector3d>& vertices, const std::vector<Triangle>& triangles) {
  return ::refusal([&] { const TriangleMesh mesh(vertices, triangles); });
}

std::string complaintAboutCoordinate(size_t vertex, int axis, double coordinate) {
  std::vector<Eigen::Vector3d> vertices = kVertices;
  vertices[vertex][axis] = coordinate;
  return complaint(vertices, kTriangles);
}

TEST(TriangleMeshTest, KeepsVerticesAndTriangles) {
  const TriangleMesh mesh(kVertices, kTriangles);
  ASSERT_EQ(mesh.triangles(), kTriangles);
  ASSERT_EQ(mesh.vertexCount(), 4U);
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(mesh.vertex(i), kVertices[i]);
  EXPECT_EQ(mesh.rounding(), 0.0);
}

// Vertex 0, the last used vertex and an unused one.
TEST(TriangleMeshTest, RefusesCoordinatesThatAreNotFinite) {
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    for (const size_t vertex : {0U, 2U, 3U}) {
      for (const int axis : {0, 1, 2}) {
        EXPECT_TRUE(has(complaintAboutCoordinate(vertex, axis, bad), "vertex " + std::to_string(vertex) + " "))
            << bad << " on axis " << axis << " of vertex " << vertex;
      }
    }
  }
}

TEST(TriangleMeshTest, AcceptsCoordinatesUpToTheBound) {
  EXPECT_EQ(complaintAboutCoordinate(1, 0, 1e7), "");
  EXPECT_EQ(complaintAboutCoordinate(1, 2, -1e7), "");
  EXPECT_TRUE(has(complaintAboutCoordinate(1, 0, std::nextafter(1e7, 1e8)), "vertex 1 "));
  EXPECT_TRUE(has(complaintAboutCoordinate(3, 2, std::nextafter(-1e7, -1e8)), "vertex 3 "));
}

TEST(TriangleMeshTest, NamesTheIndexThatIsOutOfRange) {
  EXPECT_EQ(complaint(kVertices, {{1, 2, 3}}), "");
  const std::string message = complaint(kVertices, {{0, 1, 2}, {0, 4, 2}});
  EXPECT_TRUE(has(message, "triangle 1 names vertex 4 of 4")) << message;
  EXPECT_TRUE(has(complaint(kVertices, {{4294967295U, 1, 2}}), "4294967295"));
}

TEST(TriangleMeshTest, RefusesAMeshWithoutTriangles) {
  EXPECT_TRUE(has(complaint(kVertices, {}), "no triangles"));
  EXPECT_TRUE(has(complaint({}, {}), "no triangles"));
}

// They may be a wire or a tip.
TEST(TriangleMeshTest, KeepsDegenerateTriangles) {
  const std::vector<Triangle> point_and_needle = {{0, 0, 0}, {0, 1, 1}};
  EXPECT_EQ(TriangleMesh(kVertices, point_and_needle).triangles(), point_and_needle);
}

// A float32 coordinate of 1e6 m would have an error of up to 0.03 m.
TEST(TriangleMeshTest, KeepsPositionsFarOutToWithinItsRounding) {
  const Eigen::Vector3d far(1e6, -1e6, 1e6);
  const std::vector<Eigen::Vector3d> vertices = {far + Eigen::Vector3d(0.1, 0.2, 0.3), far,
                                                 far + Eigen::Vector3d(-0.7, 1.0, 0.0)};
  const TriangleMesh mesh(vertices, {{0, 1, 2}});
  EXPECT_GT(mesh.rounding(), 0.0);
  EXPECT_LT(mesh.rounding(), 1e-7);
  for (size_t i = 0; i < 3; ++i) EXPECT_LE((mesh.vertex(i) - vertices[i]).norm(), mesh.rounding());
}

TEST(TriangleMeshTest, MeasuresItsRadiusFromItsOrigin) {
  const TriangleMesh mesh({{10, 0, 0}, {16, 8, 0}, {10, 8, 0}}, {{0, 1, 2}});
  EXPECT_EQ(mesh.origin(), Eigen::Vector3d(13, 4, 0));
  EXPECT_DOUBLE_EQ(mesh.radius(), 5.0);
}

TEST(TriangleMeshTest, DeformsToTheGivenPositions) {
  const TriangleMesh mesh = deformed({kVertices, kTriangles}, {0.1F, 0, 0, 1, 0, 0, 0, 1, 0, 1e6F, 0, 0.3F});
  EXPECT_EQ(mesh.vertex(0), Eigen::Vector3d(0.1F, 0, 0));
  EXPECT_EQ(mesh.vertex(3), Eigen::Vector3d(1e6F, 0, 0.3F));
  EXPECT_DOUBLE_EQ(mesh.radius(), Eigen::Vector3d(1e6F, 1.0, 0.3F).norm());
}

// Its sender has rounded each coordinate by up to half a step of float32.
TEST(TriangleMeshTest, IsAfterADeformationAsFarOffAsItsSenderMayHaveRounded) {
  const auto roundingOf = [](const Eigen::Vector3f& largest) {
    std::vector<float> positions(12, 0.0F);
    for (const int axis : {0, 1, 2}) positions[4 * static_cast<size_t>(axis)] = -largest[axis];
    return deformed({kVertices, kTriangles}, positions).rounding();
  };
  EXPECT_NEAR(roundingOf({1.5F, 1.0F, 1.99F}), std::sqrt(3.0) * 0x1p-24, 1e-15);
  EXPECT_NEAR(roundingOf({0.25F, 0.1F, 0.0F}), std::hypot(0x1p-26, 0x1p-28), 1e-15);
  EXPECT_NEAR(roundingOf({30e3F, 0.0F, 0.0F}), 0.977e-3, 1e-6);
  EXPECT_NEAR(roundingOf({130e3F, 130e3F, 1.0F}), 5.52e-3, 1e-5);
  EXPECT_NEAR(roundingOf({500e3F, 4000e3F, 100.0F}), 0.126, 1e-3);
}

TEST(TriangleMeshTest, AddsWhatThePositionsWereRoundedByBefore) {
  const TriangleMesh mesh(kVertices, kTriangles, /*is_sheet=*/false, 0.002);
  EXPECT_EQ(mesh.rounding(), 0.002);
}

TEST(TriangleMeshTest, ItsPaddingIsPartOfItsMarginAlsoAfterADeformation) {
  TriangleMesh mesh(kVertices, kTriangles);
  EXPECT_EQ(mesh.margin(), mesh.rounding());
  mesh.pad(0.25);
  EXPECT_EQ(mesh.margin(), 0.25);
  const TriangleMesh later = deformed(mesh, std::vector<float>(12, 1.0F));
  EXPECT_EQ(later.padding(), 0.25);
  EXPECT_EQ(later.margin(), 0.25 + later.rounding());
}

// The list of triangles is not copied at 60 Hz.
TEST(TriangleMeshTest, SharesItsTrianglesWithItsDeformations) {
  const TriangleMesh mesh(kVertices, kTriangles);
  EXPECT_EQ(&deformed(mesh, std::vector<float>(12, 0.0F)).triangles(), &mesh.triangles());
}

TEST(TriangleMeshTest, RefusesADeformationOfAnotherSize) {
  const TriangleMesh mesh(kVertices, kTriangles);
  EXPECT_THROW(deformed(mesh, std::vector<float>(11)), InvalidInput);
  EXPECT_THROW(deformed(mesh, std::vector<float>(15)), InvalidInput);
  EXPECT_THROW(deformed(mesh, {}), InvalidInput);
}

TEST(TriangleMeshTest, RefusesADeformationThatIsNotFinite) {
  const TriangleMesh mesh(kVertices, kTriangles);
  constexpr float kTooFar = 1.1e7F;
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -kTooFar}) {
    for (const size_t i : {0U, 8U, 11U}) {
      std::vector<float> positions(12, 0.0F);
      positions[i] = bad;
      EXPECT_TRUE(has(refusal([&] { deformed(mesh, positions); }), "vertex " + std::to_string(i / 3) + " ")) << bad;
    }
  }
}

}  // namespace
}  // namespace sweep_guard_core
