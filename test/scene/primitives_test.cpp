// Surfaces of primitives are closed and convex, contain the shape, and reach hardly beyond it.
#include "scene/primitives.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>

#include "refusal.h"

namespace sweep_guard_core {
namespace {

constexpr double kRounding = 1e-12;  // relative to the size

Eigen::AlignedBox3d boxAround(const TriangleSurface& surface) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : surface.vertices) box.extend(p);
  return box;
}

// Returns how far a point is outside of the planes of the triangles [m]; negative inside of all.
double distanceOutside(const TriangleSurface& convex, const Eigen::Vector3d& p) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : convex.triangles) {
    const Eigen::Vector3d& from = convex.vertices[a];
    const Eigen::Vector3d normal = (convex.vertices[b] - from).cross(convex.vertices[c] - from).normalized();
    largest = std::max(largest, normal.dot(p - from));
  }
  return largest;
}

struct Shape {
  std::string name;
  TriangleSurface surface;
  double radius;                                           ///< or size [m]
  std::function<double(const Eigen::Vector3d&)> distance;  ///< from the shape [m]; <= 0 inside; right at its rims
};

// In a plane through the axis, a cone is the area below a line of normal (height, radius) and above its base.
double distanceToCone(double radius, double height, const Eigen::Vector3d& p) {
  const double r = p.head<2>().norm();
  const double slope = (height * (r - radius) + radius * (p.z() + 0.5 * height)) / std::hypot(radius, height);
  const double past_rim = p.z() <= -0.5 * height ? r - radius : -radius;
  return std::max({slope, past_rim, -0.5 * height - p.z()});
}

std::vector<Shape> shapes() {
  return {{"box", boxPrimitive({0.2, 3, 40}), 40,
           [](const Eigen::Vector3d& p) { return (p.cwiseAbs() - Eigen::Vector3d(0.1, 1.5, 20)).maxCoeff(); }},
          {"floor", floorPrimitive(), 20,
           [](const Eigen::Vector3d& p) {
             return std::max({std::abs(p.x()) - 10, std::abs(p.y()) - 10, p.z(), -1 - p.z()});
           }},
          {"cylinder", cylinderPrimitive(0.1, 3), 0.1,
           [](const Eigen::Vector3d& p) { return std::max(p.head<2>().norm() - 0.1, std::abs(p.z()) - 1.5); }},
          {"cone", conePrimitive(2, 0.5), 2, [](const Eigen::Vector3d& p) { return distanceToCone(2, 0.5, p); }},
          {"sphere", spherePrimitive(0.25), 0.25, [](const Eigen::Vector3d& p) { return p.norm() - 0.25; }}};
}

class PrimitivesTest : public testing::TestWithParam<Shape> {};

TEST_P(PrimitivesTest, EachEdgeHasTwoTrianglesOfOppositeDirections) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& [a, b, c] : GetParam().surface.triangles) {
    for (const auto& edge : {std::pair{a, b}, {b, c}, {c, a}}) ++edges[edge];
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1U);
  }
}

TEST_P(PrimitivesTest, EachVertexIsUsedAndHasAPositionOfItsOwn) {
  const TriangleSurface& surface = GetParam().surface;
  std::map<std::array<double, 3>, int> positions;
  std::vector<int> used(surface.vertices.size());
  for (const Eigen::Vector3d& p : surface.vertices) ++positions[{p.x(), p.y(), p.z()}];
  for (const Triangle& triangle : surface.triangles) {
    for (const std::uint32_t vertex : triangle) ++used[vertex];
  }
  EXPECT_EQ(positions.size(), surface.vertices.size());
  EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);
}

// So the surface is convex, and counter-clockwise seen from outside.
TEST_P(PrimitivesTest, NoVertexIsInFrontOfATriangle) {
  for (const Eigen::Vector3d& p : GetParam().surface.vertices) {
    EXPECT_LE(distanceOutside(GetParam().surface, p), kRounding * GetParam().radius);
  }
}

TEST_P(PrimitivesTest, ContainsTheShape) {
  std::mt19937 random(7);
  const Eigen::AlignedBox3d box = boxAround(GetParam().surface);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int inside = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Eigen::Vector3d p =
        box.min() + box.sizes().cwiseProduct(Eigen::Vector3d(share(random), share(random), share(random)));
    if (GetParam().distance(p) > 0.0) continue;
    ++inside;
    EXPECT_LE(distanceOutside(GetParam().surface, p), kRounding * GetParam().radius);
  }
  EXPECT_GT(inside, 4'000);
}

// A convex surface is farthest from a convex shape at a vertex.
TEST_P(PrimitivesTest, ReachesAtMostTheDeviationBeyondTheShape) {
  double largest = -1.0;
  for (const Eigen::Vector3d& p : GetParam().surface.vertices) largest = std::max(largest, GetParam().distance(p));
  EXPECT_LE(largest, kPrimitiveDeviation * GetParam().radius);
  EXPECT_GE(largest, -kRounding * GetParam().radius);
}

TEST_P(PrimitivesTest, HasItsCenterAtTheOrigin) {
  const Eigen::Vector3d center = GetParam().name == "floor" ? Eigen::Vector3d(0, 0, -0.5) : Eigen::Vector3d(0, 0, 0);
  EXPECT_LT((boxAround(GetParam().surface).center() - center).norm(), kRounding * GetParam().radius);
}

INSTANTIATE_TEST_SUITE_P(Each, PrimitivesTest, testing::ValuesIn(shapes()),
                         [](const auto& test) { return test.param.name; });

// Points on the surface of a round shape lie on tangent planes: rounding alone decides.
TEST(RoundPrimitivesTest, ContainPointsOnTheShape) {
  const TriangleSurface sphere = spherePrimitive(2);
  const TriangleSurface cylinder = cylinderPrimitive(2, 1);
  for (int i = 0; i < 64; ++i) {
    const Eigen::AngleAxisd azimuth(i * M_PI / 32, Eigen::Vector3d::UnitZ());
    EXPECT_LE(distanceOutside(cylinder, azimuth * Eigen::Vector3d(2, 0, 0.5)), kRounding);
    for (int k = 0; k <= 32; ++k) {
      const Eigen::AngleAxisd polar(k * M_PI / 32, Eigen::Vector3d::UnitY());
      EXPECT_LE(distanceOutside(sphere, azimuth * polar * Eigen::Vector3d(0, 0, 2)), kRounding);
    }
  }
}

TEST(ConePrimitiveTest, PointsUp) {
  int tips = 0;
  for (const Eigen::Vector3d& p : conePrimitive(1, 2).vertices) tips += p.z() == 1.0 ? 1 : 0;
  EXPECT_EQ(tips, 1);
}

TEST(PrimitiveSizeTest, ADimensionOutOfRangeIsRefusedByName) {
  const std::string range = " m: must be above 0 and at most 1000 m";
  EXPECT_EQ(refusal([] { boxPrimitive({1, 0, 1}); }), "size y is 0" + range);
  EXPECT_EQ(refusal([] { spherePrimitive(-1); }), "radius is -1" + range);
  EXPECT_EQ(refusal([] { spherePrimitive(1000.5); }), "radius is 1000.5" + range);
  EXPECT_EQ(refusal([] { cylinderPrimitive(1, std::numeric_limits<double>::infinity()); }), "height is inf" + range);
  EXPECT_EQ(refusal([] { conePrimitive(std::nan(""), 1); }), "radius is nan" + range);
  EXPECT_EQ(refusal([] { boxPrimitive({1000, 1, 1}); }), "");
}

}  // namespace
}  // namespace sweep_guard_core
