#include "interaction/outline.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes.h"

namespace sweep_guard_core {
namespace {

using Corners2d = std::vector<Eigen::Vector2d>;
using Triangle3d = std::array<Eigen::Vector3d, 3>;

// Irregular, and longer than wide; its corners are on an ellipse about a point that is not its center.
Corners2d ovalWithCorners(int count, Random& random) {
  Corners2d corners;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * M_PI * (i + random.uniform(0.0, 0.9)) / count;
    corners.emplace_back(0.3 + 2.0 * std::cos(angle), 0.2 + std::sin(angle));
  }
  return corners;
}

Triangle3d randomTriangle(double size, Random& random) {
  const Eigen::Vector3d at = random.inBox({3.0, 2.0, 1.0});
  return {at + size * random.direction(), at + size * random.direction(), at + size * random.direction()};
}

Eigen::Vector3d areaOf(const Polygon& polygon) {
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (size_t i = 2; i < polygon.size(); ++i) {
    area += 0.5 * (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  }
  return area;
}

Polygon cutByEveryWall(const Corners2d& corners, const Triangle3d& triangle) {
  Polygon part(triangle.begin(), triangle.end());
  for (size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d along = corners[(i + 1) % corners.size()] - corners[i];
    const Eigen::Vector3d normal = Eigen::Vector3d(along.y(), -along.x(), 0.0).normalized();
    part = clip(part, HalfSpace(normal, normal.head<2>().dot(corners[i])));
  }
  return part;
}

TEST(OutlineTest, LeavesOfATriangleWhatEveryWallLeaves) {
  Random random(/*seed=*/1);
  int whole = 0;
  int partly = 0;
  PolygonCutter part;
  for (const int count : {3, 4, 7, 32, 100}) {
    const Corners2d corners = ovalWithCorners(count, random);
    const Outline outline(corners);
    for (const double size : {0.01, 0.1, 1.0, 10.0, 1000.0}) {
      for (int i = 0; i < 400; ++i) {
        const Triangle3d triangle = randomTriangle(size, random);
        const bool left = outline.cut(triangle, part);
        EXPECT_EQ(left, !part.corners().empty());
        const Eigen::Vector3d area = areaOf(part.corners());
        EXPECT_LT((area - areaOf(cutByEveryWall(corners, triangle))).norm(), 1e-13 * std::max(1.0, size * size));
        if (left) ++(part.corners().size() == 3 ? whole : partly);
      }
    }
  }
  EXPECT_GT(whole, 1000);
  EXPECT_GT(partly, 1000);
}

// Where the center or a corner of the outline lies exactly on a corner of the triangle, or on the axes of the frame.
TEST(OutlineTest, LeavesASquareOfATriangleAroundIt) {
  const Outline square({{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}});
  PolygonCutter part;
  EXPECT_TRUE(square.cut({Eigen::Vector3d(-3.0, -1.0, 0.0), {3.0, -1.0, 0.0}, {0.0, 5.0, 0.0}}, part));
  EXPECT_NEAR(areaOf(part.corners()).z(), 4.0, 1e-15);
  EXPECT_TRUE(square.cut({Eigen::Vector3d(0.0, 0.0, 0.0), {2.0, 0.0, 2.0}, {0.0, 2.0, 0.0}}, part));
  EXPECT_NEAR(areaOf(part.corners()).z(), 1.0, 1e-15);
  EXPECT_TRUE(square.cut({Eigen::Vector3d(1.0, 1.0, 0.0), {-1.0, 1.0, 0.0}, {-1.0, -1.0, 0.0}}, part));
  EXPECT_NEAR(areaOf(part.corners()).z(), 2.0, 1e-15);
  EXPECT_FALSE(square.cut({Eigen::Vector3d(2.0, 2.0, 0.0), {3.0, 2.0, 0.0}, {2.0, 3.0, 0.0}}, part));
  EXPECT_FALSE(square.cut({Eigen::Vector3d(3.0, 0.0, 0.0), {0.0, 3.0, 0.0}, {3.0, 3.0, 0.0}}, part));
}

TEST(OutlineTest, KnowsItsCorners) {
  const Corners2d corners = {{0.0, 0.0}, {2.0, 0.0}, {0.0, 1.0}};
  const Outline outline(corners);
  EXPECT_TRUE(outline.hasCorners({{2.0, 0.0}, {0.0, 1.0}, {1e-9, 0.0}}, 1e-8));
  EXPECT_FALSE(outline.hasCorners({{2.0, 0.0}, {0.0, 1.0}, {1e-7, 0.0}}, 1e-8));
  EXPECT_FALSE(outline.hasCorners({{2.0, 0.0}, {0.0, 1.0}}, 1e-8));
}

}  // namespace
}  // namespace sweep_guard_core
