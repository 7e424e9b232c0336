#include "geometry/penetration.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scenes.h"

namespace sweep_guard_core {
namespace {

using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

// An ellipsoid: smooth, with any proportions.
struct Ellipsoid {
  Eigen::Matrix3d axes;  // columns: directions times half lengths [m]
  Vector3d center;

  Vector3d supportPoint(const Vector3d& direction) const {
    return center + axes * (axes.transpose() * direction).normalized();
  }
};

const Proposals kAxes = {Vector3d::UnitX(),  -Vector3d::UnitX(), Vector3d::UnitY(),
                         -Vector3d::UnitY(), Vector3d::UnitZ(),  -Vector3d::UnitZ()};

TEST(MinimumTranslationDirectionTest, IsTheLeastOfManyDirections) {
  Random random(/*seed=*/1);
  int least = 0;
  int overlapping = 0;
  constexpr int kPairs = 500;
  for (int i = 0; i < kPairs; ++i) {
    const Vector3d half(random.uniform(0.1, 1.0), random.uniform(0.1, 1.0), random.uniform(0.1, 1.0));
    const Ellipsoid tool{random.rotation() * half.asDiagonal(), 0.2 * random.direction()};
    Corners corners;
    for (Vector3d& p : corners) p = random.logUniform(0.1, 10.0) * random.direction();
    const Vector3d middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    for (Vector3d& p : corners) p -= middle;
    const PointHull triangle(corners);
    Proposals proposals = kAxes;
    const Vector3d face = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    proposals.push_back(face);
    proposals.push_back(-face);
    const Vector3d normal = minimumTranslationDirection(tool, triangle, proposals, /*neighbors=*/{}, /*size=*/1.0);
    EXPECT_NEAR(normal.norm(), 1.0, 1e-14);
    double sampled = depthAlong(face, tool, triangle);
    for (int k = 0; k < 3000; ++k) sampled = std::min(sampled, depthAlong(random.direction(), tool, triangle));
    const double depth = depthAlong(normal, tool, triangle);
    if (depth <= 0.0) continue;
    ++overlapping;
    EXPECT_LE(depth, depthAlong(face, tool, triangle) + 1e-12) << i;
    EXPECT_LE(depth, 1.1 * sampled + 1e-12) << i;
    least += depth <= sampled + 1e-9 ? 1 : 0;
  }
  EXPECT_GT(overlapping, kPairs / 2);
  EXPECT_GE(least, overlapping * 99 / 100);
}

// Each of a row of triangles through an ellipsoid has the normal of the one before as a neighbor's. Where another side becomes
// the nearer one, only the proposals know.
TEST(MinimumTranslationDirectionTest, IsMostlyAsGoodWithANeighborsNormalInPlaceOfThePolytope) {
  Random random(/*seed=*/2);
  int overlapping = 0;
  int as_good = 0;
  for (int row = 0; row < 100; ++row) {
    const Vector3d half(random.uniform(0.3, 1.0), random.uniform(0.3, 1.0), random.uniform(0.3, 1.0));
    const Eigen::Matrix3d axes = random.rotation();
    const Ellipsoid tool{axes * half.asDiagonal(), Vector3d::Zero()};
    Proposals proposals;
    for (int axis = 0; axis < 3; ++axis) {
      proposals.push_back(axes.col(axis));
      proposals.push_back(-axes.col(axis));
    }
    const Vector3d from = 0.6 * random.direction();
    const Vector3d to = 0.6 * random.direction();
    const Corners corner_offsets = {0.05 * random.direction(), 0.05 * random.direction(), 0.05 * random.direction()};
    NeighborNormals neighbors;
    for (int i = 0; i <= 20; ++i) {
      Corners corners = corner_offsets;
      for (Vector3d& p : corners) p += from + 0.05 * i * (to - from);
      const PointHull triangle(corners);
      const Vector3d alone = minimumTranslationDirection(tool, triangle, proposals, {}, /*size=*/1.0);
      const double depth = depthAlong(alone, tool, triangle);
      if (depth <= 0.0) continue;
      const Vector3d beside = minimumTranslationDirection(tool, triangle, proposals, neighbors, /*size=*/1.0);
      neighbors.assign(1, beside);
      ++overlapping;
      as_good += depthAlong(beside, tool, triangle) <= depth + 1e-6 ? 1 : 0;
      EXPECT_LE(depthAlong(beside, tool, triangle), 1.5 * depth) << row << ", " << i;
    }
  }
  EXPECT_GT(overlapping, 1000);
  EXPECT_GE(as_good, overlapping * 98 / 100);
}

// libccd makes no polytope for flat bodies; the proposals give the result.
TEST(MinimumTranslationDirectionTest, TakesFlatBodies) {
  const PointHull flat(Corners{Vector3d(-1, -1, 0), Vector3d(2, -1, 0), Vector3d(-1, 2, 0)});
  const PointHull cut(Corners{Vector3d(0, 0, -0.1), Vector3d(0.2, 0, 0.3), Vector3d(-0.1, 0, 0.3)});
  const Vector3d out = minimumTranslationDirection(cut, flat, kAxes, {}, /*size=*/1.0);
  EXPECT_NEAR(depthAlong(out, cut, flat), 0.1, 1e-9);
  const PointHull same(Corners{Vector3d(0, 0, 0), Vector3d(0.2, 0, 0), Vector3d(0, 0.2, 0)});
  EXPECT_NEAR(depthAlong(minimumTranslationDirection(same, flat, kAxes, {}, 1.0), same, flat), 0.0, 1e-12);
  const PointHull point(std::array<Vector3d, 1>{Vector3d::Zero()});
  EXPECT_NEAR(depthAlong(minimumTranslationDirection(point, flat, kAxes, {}, 1.0), point, flat), 0.0, 1e-12);
  EXPECT_NEAR(depthAlong(minimumTranslationDirection(point, point, kAxes, {}, 1.0), point, point), 0.0, 1e-12);
}

}  // namespace
}  // namespace sweep_guard_core
