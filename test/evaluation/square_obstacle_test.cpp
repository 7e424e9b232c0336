#include "evaluation/square_obstacle.h"

#include <gtest/gtest.h>

#include "evaluation/random.h"
#include "square_at.h"

namespace sweep_guard_evaluation {
namespace {

using sweep_guard_core::ConvexShape;

// A tool along z from -0.1 to 0 with a radius of 5 mm.
class SquareObstacleIntersectsTest : public testing::Test {
 protected:
  static SquareObstacle obstacleAt(const Eigen::Vector3d& center, const Eigen::Vector3d& normal) {
    return squareAt(center, normal, 0.05);
  }

  bool intersectsTool(const SquareObstacle& obstacle, double margin = 0.0) const {
    return intersects(tool_, Eigen::Isometry3d::Identity(), obstacle, margin);
  }

  ConvexShape tool_ = ConvexShape::cylinder(0.005, 0.1);
};

TEST_F(SquareObstacleIntersectsTest, AWallInFrontOfTheTip) {
  EXPECT_TRUE(intersectsTool(obstacleAt({0, 0, -1e-9}, Eigen::Vector3d::UnitZ())));
  EXPECT_FALSE(intersectsTool(obstacleAt({0, 0, 1e-9}, Eigen::Vector3d::UnitZ())));
  EXPECT_FALSE(intersectsTool(obstacleAt({0, 0, -0.1 - 1e-9}, Eigen::Vector3d::UnitZ())));
}

TEST_F(SquareObstacleIntersectsTest, AWallBesideTheToolAtItsRadiusInEveryDirection) {
  for (double angle = 0.0; angle < 6.3; angle += 0.1) {
    const Eigen::Vector3d normal(std::cos(angle), std::sin(angle), 0.0);
    EXPECT_TRUE(intersectsTool(obstacleAt((0.005 - 1e-9) * normal, normal))) << angle;
    EXPECT_FALSE(intersectsTool(obstacleAt((0.005 + 1e-9) * normal, normal))) << angle;
  }
}

// The rim's lowest point lies at 5 mm sideways and 0 ahead: (sin a, 0, cos a) reaches 5 mm * sin a.
TEST_F(SquareObstacleIntersectsTest, ATiltedWallAtTheRim) {
  const Eigen::Vector3d normal(std::sin(0.7), 0.0, std::cos(0.7));
  EXPECT_TRUE(intersectsTool(obstacleAt((0.005 * std::sin(0.7) - 1e-9) * normal, normal)));
  EXPECT_FALSE(intersectsTool(obstacleAt((0.005 * std::sin(0.7) + 1e-9) * normal, normal)));
}

TEST_F(SquareObstacleIntersectsTest, AnEdgeThatPassesTheRoundSide) {
  EXPECT_TRUE(intersectsTool(obstacleAt({0.055 - 1e-9, 0, -0.05}, Eigen::Vector3d::UnitZ())));
  EXPECT_FALSE(intersectsTool(obstacleAt({0.055 + 1e-9, 0, -0.05}, Eigen::Vector3d::UnitZ())));
}

TEST_F(SquareObstacleIntersectsTest, ACornerThatPassesTheRoundSide) {
  const double diagonal = 0.05 + 0.005 / std::sqrt(2.0);
  EXPECT_TRUE(intersectsTool(obstacleAt({diagonal - 1e-9, diagonal - 1e-9, -0.05}, Eigen::Vector3d::UnitZ())));
  EXPECT_FALSE(intersectsTool(obstacleAt({diagonal + 1e-9, diagonal + 1e-9, -0.05}, Eigen::Vector3d::UnitZ())));
}

TEST_F(SquareObstacleIntersectsTest, AnObstacleThatContainsTheAxis) {
  EXPECT_TRUE(intersectsTool(obstacleAt({0, 0, -0.05}, Eigen::Vector3d::UnitX())));
}

TEST_F(SquareObstacleIntersectsTest, GrowsByTheMargin) {
  EXPECT_TRUE(intersectsTool(obstacleAt({0, 0, 0.02 - 1e-9}, Eigen::Vector3d::UnitZ()), 0.02));
  EXPECT_FALSE(intersectsTool(obstacleAt({0, 0, 0.02 + 1e-9}, Eigen::Vector3d::UnitZ()), 0.02));
  EXPECT_TRUE(intersectsTool(obstacleAt({0.025 - 1e-9, 0, 0}, Eigen::Vector3d::UnitX()), 0.02));
}

// Against points of the obstacle, each tested by the inequalities of a cylinder.
TEST_F(SquareObstacleIntersectsTest, AgreesWithPointsOfTheObstacle) {
  Random random(/*seed=*/3);
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    SquareObstacle obstacle =
        obstacleAt({random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05), random.uniform(-0.15, 0.05)},
                   {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
    bool point_inside = false;
    bool point_near = false;
    constexpr int kSteps = 200;
    for (int x = -kSteps; x <= kSteps; ++x) {
      for (int y = -kSteps; y <= kSteps; ++y) {
        const Eigen::Vector3d p = obstacle.X_WS * (Eigen::Vector3d(x, y, 0.0) * (obstacle.half_side / kSteps));
        const double beyond = std::max({p.z(), -0.1 - p.z(), p.head<2>().norm() - 0.005});
        point_inside = point_inside || beyond <= 0.0;
        point_near = point_near || beyond <= obstacle.half_side / kSteps;
      }
    }
    hits += intersectsTool(obstacle) ? 1 : 0;
    EXPECT_TRUE(intersectsTool(obstacle) || !point_inside) << i;
    EXPECT_TRUE(!intersectsTool(obstacle) || point_near) << i;
  }
  EXPECT_GT(hits, 50);
  EXPECT_LT(hits, 250);
}

TEST(SquareObstacleTest, HasAMeshOfItsSize) {
  SquareObstacle obstacle;
  obstacle.half_side = 0.25;
  obstacle.X_WS.translation() << 1, 2, 3;
  const sweep_guard_core::TriangleMesh mesh = meshOf(obstacle);
  EXPECT_EQ(mesh.triangles().size(), 2U);
  EXPECT_EQ(mesh.vertex(0), Eigen::Vector3d(0.75, 1.75, 3.0));
  EXPECT_EQ(mesh.vertex(2), Eigen::Vector3d(1.25, 2.25, 3.0));
}

}  // namespace
}  // namespace sweep_guard_evaluation
