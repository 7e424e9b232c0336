#include "sweep_guard/geometry/convex_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "geometry/round_tool.h"
#include "scenes.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {
namespace {

TEST(ConvexShapeTest, FillsTheCylinderBehindItsTip) {
  const ConvexShape drill = ConvexShape::cylinder(/*radius=*/0.5, /*length=*/2.0);
  EXPECT_EQ(drill.support(Eigen::Vector3d::UnitZ()), 0.0);
  EXPECT_EQ(drill.support(-Eigen::Vector3d::UnitZ()), 2.0);
  EXPECT_EQ(drill.support(Eigen::Vector3d::UnitX()), 0.5);
  EXPECT_NEAR(drill.support({0.0, 0.6, -0.8}), 0.5 * 0.6 + 2.0 * 0.8, 1e-15);
  EXPECT_NEAR(drill.support({0.0, 0.6, 0.8}), 0.5 * 0.6, 1e-15);
}

TEST(ConvexShapeTest, SupportIsThatOfTheRoundToolSampledDensely) {
  Random random(/*seed=*/1);
  constexpr int kPoints = 720;
  for (int i = 0; i < 1000; ++i) {
    const ConvexShape tool = randomTool(random, 1.0);
    const Eigen::Vector3d direction = random.direction();
    double farthest = -std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& p : roundToolPoints_T(tool, kPoints)) farthest = std::max(farthest, direction.dot(p));
    EXPECT_NEAR(tool.support(direction), farthest, 1e-5 * tool.radius() + 1e-15) << "tool " << i;
    EXPECT_GE(tool.support(direction), farthest - 1e-15) << "tool " << i;
  }
}

TEST(ConvexShapeTest, SupportAtAPoseFollowsThePose) {
  const ConvexShape drill = ConvexShape::cylinder(0.5, 2.0);
  Eigen::Isometry3d X_MT = Eigen::Isometry3d::Identity();
  X_MT.linear() = Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitY()).toRotationMatrix();  // z_T along x_M
  X_MT.translation() = Eigen::Vector3d(10, 20, 30);
  EXPECT_NEAR(support(drill, X_MT, Eigen::Vector3d::UnitX()), 10.0, 1e-12);
  EXPECT_NEAR(support(drill, X_MT, -Eigen::Vector3d::UnitX()), -8.0, 1e-12);
  EXPECT_NEAR(support(drill, X_MT, Eigen::Vector3d::UnitZ()), 30.5, 1e-12);

  const Motion motion{X_MT, Eigen::Translation3d(1, 0, 0) * X_MT};
  EXPECT_NEAR(support(drill, motion, Eigen::Vector3d::UnitX()), 11.0, 1e-12);
  EXPECT_NEAR(support(drill, motion, -Eigen::Vector3d::UnitX()), -8.0, 1e-12);
}

TEST(ConvexShapeTest, RadiusAboutBoundsTheDistanceFromAnyAxisThroughTheTip) {
  Random random(/*seed=*/2);
  for (int i = 0; i < 1000; ++i) {
    const ConvexShape tool = randomTool(random, 1.0);
    const Eigen::Vector3d axis = random.direction();
    double farthest = 0.0;
    for (const Eigen::Vector3d& p : roundToolPoints_T(tool, 64)) farthest = std::max(farthest, axis.cross(p).norm());
    EXPECT_GE(tool.radiusAbout(axis), farthest - 1e-15) << "tool " << i;
    EXPECT_LE(tool.radiusAbout(axis), 1.5 * farthest) << "tool " << i;
  }
}

// A point of a drill that spins about its own axis moves within its radius.
TEST(ConvexShapeTest, RadiusAboutItsOwnAxisIsItsRadius) {
  EXPECT_EQ(ConvexShape::cylinder(0.5, 2.0).radiusAbout(Eigen::Vector3d::UnitZ()), 0.5);
  EXPECT_EQ(ConvexShape::cylinder(0.5, 2.0).radiusAbout(Eigen::Vector3d::UnitY()), 2.5);
}

TEST(ConvexShapeTest, SupportPointsOfItsFacesAreOnTheirRims) {
  const ConvexShape drill = ConvexShape::cylinder(0.5, 2.0);
  EXPECT_TRUE(drill.frontSupport({3, 4, 7}).isApprox(Eigen::Vector3d(0.3, 0.4, 0.0), 1e-15));
  EXPECT_TRUE(drill.rearSupport({-3, 4, 7}).isApprox(Eigen::Vector3d(-0.3, 0.4, -2.0), 1e-15));
  EXPECT_EQ(drill.frontSupport(Eigen::Vector3d::UnitZ()), Eigen::Vector3d(0, 0, 0));
}

// A prism of 4 sides, radius 1, length 2: 16 triangles, 48 corners; 5 at each of its 8 rim vertices, 4 at each center.
// So the sum of x^2 is 5 * 4, and every z differs from the mean by 1.
TEST(ConvexShapeTest, MomentsAreThePapersSumsOverTriangleCorners) {
  const ConvexShape prism = ConvexShape::cylinder(/*radius=*/1.0, /*length=*/2.0, /*sides=*/4);
  ASSERT_EQ(prism.mesh_T().triangles().size(), 16U);
  EXPECT_TRUE(prism.moments_T().mean.isApprox(Eigen::Vector3d(0, 0, -1), 1e-12));
  const Eigen::Vector3d diagonal(20.0 / 48.0, 20.0 / 48.0, 1.0);
  EXPECT_TRUE(prism.moments_T().covariance.isApprox(Eigen::Matrix3d(diagonal.asDiagonal()), 1e-7));
}

TEST(ConvexShapeTest, MeshIsClosedAndTouchesTheRoundToolFromInside) {
  const ConvexShape drill = ConvexShape::cylinder(0.5, 2.0, /*sides=*/8);
  double six_volumes = 0.0;
  for (const Triangle& triangle : drill.mesh_T().triangles()) {
    const auto p = [&](size_t i) { return drill.mesh_T().vertex(triangle[i]); };
    six_volumes += p(0).dot(p(1).cross(p(2)));
  }
  const double octagon = 0.5 * 8 * 0.5 * 0.5 * std::sin(std::acos(-1.0) / 4);
  EXPECT_NEAR(std::abs(six_volumes / 6.0), 2.0 * octagon, 1e-6);
}

TEST(ConvexShapeTest, RefusesSizesOutOfRange) {
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {-1e-9, nan, infinity, 1.1e7}) {
    EXPECT_THROW(ConvexShape::cylinder(bad, 1.0), InvalidInput) << bad;
    EXPECT_THROW(ConvexShape::cylinder(1.0, bad), InvalidInput) << bad;
  }
  EXPECT_THROW(ConvexShape::cylinder(0.0, 0.0), InvalidInput);
  for (const int sides : {-1, 0, 2, 1001}) EXPECT_THROW(ConvexShape::cylinder(1.0, 1.0, sides), InvalidInput) << sides;
}

TEST(ConvexShapeTest, AcceptsFlatAndNeedleTools) {
  EXPECT_EQ(ConvexShape::cylinder(0.0, 1.0).support(Eigen::Vector3d::UnitX()), 0.0);
  EXPECT_EQ(ConvexShape::cylinder(1.0, 0.0, 3).support(-Eigen::Vector3d::UnitZ()), 0.0);
  EXPECT_EQ(ConvexShape::cylinder(1.0, 1.0, 1000).mesh_T().triangles().size(), 4000U);
}

std::vector<ConvexShape> shapesOfEachKind(Random& random) {
  std::vector<Eigen::Vector3d> cloud;
  for (int i = 0; i < 30; ++i) cloud.emplace_back(random.uniform(0.5, 1.0) * random.direction());
  std::vector<ConvexShape> shapes = {ConvexShape::cylinder(0.5, 2.0), ConvexShape::sphere(0.7),
                                     ConvexShape::box({0.3, 0.5, 0.8}), ConvexShape::hull(cloud),
                                     ConvexShape::hull({{-0.5, 0.1, 0}, {0.6, 0, 0}}).padded(0.3)};
  const std::vector<ConvexShape> unpadded = shapes;
  for (const ConvexShape& shape : unpadded) shapes.push_back(shape.padded(0.2));
  for (ConvexShape& shape : shapes) shape = shape.placed(random.pose(random.uniform(0.0, 2.0) * random.direction()));
  return shapes;
}

struct Placed {
  const ConvexShape& shape_T;
  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction) const { return shape_T.supportPoint(direction); }
};

// Along the surface's normal the support function is just the depth away, and nowhere less. Of a point outside, the depth
// is the distance.
TEST(ConvexShapeTest, KnowsHowDeepAPointLies) {
  Random random(/*seed=*/3);
  int inside = 0;
  int outside = 0;
  for (int trial = 0; trial < 40; ++trial) {
    for (const ConvexShape& shape : shapesOfEachKind(random)) {
      for (int i = 0; i < 10; ++i) {
        const Eigen::Vector3d p = shape.moments_T().mean + random.uniform(0.0, 1.5) * random.direction();
        const auto [depth, outwards] = shape.depthOf(p);
        const double distance = separation(Placed{shape}, PointHull(std::array<Eigen::Vector3d, 1>{p})).gap;
        EXPECT_NEAR(outwards.norm(), 1.0, 1e-12);
        if (depth < 0.0) {
          ++outside;
          EXPECT_TRUE(std::isinf(depth) || std::abs(-depth - distance) < 1e-9) << depth << " " << distance;
          continue;
        }
        ++inside;
        EXPECT_LE(distance, 1e-9);
        EXPECT_NEAR(shape.support(outwards) - outwards.dot(p), depth, 1e-9);
        for (int k = 0; k < 20; ++k) {
          const Eigen::Vector3d direction = random.direction();
          EXPECT_GE(shape.support(direction) - direction.dot(p), depth - 1e-9);
        }
      }
    }
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(outside, 500);
}

TEST(ConvexShapeTest, KnowsNoDepthInAFlatHull) {
  const ConvexShape flat = ConvexShape::hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  EXPECT_LT(flat.depthOf({0.2, 0.2, 0.0}).depth, 0.0);
}

// Between its sides, a hull contains what its corners' convex combinations reach, and its faces leave out nothing else.
TEST(ConvexShapeTest, HullsContainCombinationsOfTheirCorners) {
  Random random(/*seed=*/4);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 12; ++i) points.push_back(random.direction());
    const ConvexShape hull = ConvexShape::hull(points);
    for (int i = 0; i < 20; ++i) {
      Eigen::Vector3d p = Eigen::Vector3d::Zero();
      double sum = 0.0;
      for (const Eigen::Vector3d& point : points) {
        const double weight = random.uniform(0.0, 1.0);
        p += weight * point;
        sum += weight;
      }
      EXPECT_GE(hull.depthOf(p / sum).depth, 0.0);
    }
  }
}

}  // namespace
}  // namespace sweep_guard_core
