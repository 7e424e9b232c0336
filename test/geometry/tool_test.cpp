#include "sweep_guard/geometry/tool.h"

#include <gtest/gtest.h>

#include <set>

#include "scenes.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

ConvexShape randomShape(Random& random) {
  const Eigen::Isometry3d X_TS = random.pose(random.inBox({1, 1, 1}));
  switch (random.below(4)) {
    case 0:
      return ConvexShape::cylinder(random.uniform(0.0, 0.3), random.uniform(0.01, 0.5)).placed(X_TS);
    case 1:
      return ConvexShape::box(random.inBox({0.3, 0.3, 0.3}).cwiseAbs()).placed(X_TS);
    case 2:
      return ConvexShape::sphere(random.uniform(0.01, 0.3)).placed(X_TS);
    default: {
      std::vector<Eigen::Vector3d> points;
      for (int i = 1 + random.below(20); i > 0; --i) points.push_back(random.inBox({0.3, 0.3, 0.3}));
      return ConvexShape::hull(points).placed(X_TS).padded(random.chance(0.5) ? 0.0 : 0.01);
    }
  }
}

Tool randomParts(Random& random, int count) {
  std::vector<ConvexPiece> parts;
  parts.reserve(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i) parts.push_back({"part " + std::to_string(i), randomShape(random)});
  return Tool(std::move(parts));
}

TEST(ToolTest, OfOnePieceIsThatPiece) {
  const Tool drill = Tool::cylinder(0.005, 0.1);
  ASSERT_EQ(drill.tree().size(), 1U);
  EXPECT_EQ(drill.tree()[0].piece, 0U);
  EXPECT_EQ(drill.whole().support(-Eigen::Vector3d::UnitZ()), 0.1);
  EXPECT_TRUE(drill.bounds_T().isApprox(
      Eigen::AlignedBox3d(Eigen::Vector3d(-0.005, -0.005, -0.1), Eigen::Vector3d(0.005, 0.005, 0.0))));
}

TEST(ToolTest, RefusesNoPiece) { EXPECT_THROW(Tool(std::vector<ConvexPiece>{}), InvalidInput); }

TEST(ToolTest, EveryPieceIsALeafOfTheTreeOnce) {
  Random random(/*seed=*/11);
  for (int count = 1; count <= 33; ++count) {
    const Tool tool = randomParts(random, count);
    std::multiset<size_t> leaves;
    std::multiset<size_t> below;
    for (const Tool::Node& node : tool.tree()) {
      if (node.piece) leaves.insert(*node.piece);
      if (!node.piece) below.insert(node.below.begin(), node.below.end());
    }
    EXPECT_EQ(leaves.size(), static_cast<size_t>(count));
    EXPECT_EQ(std::set<size_t>(leaves.begin(), leaves.end()).size(), leaves.size());
    EXPECT_EQ(below.size(), tool.tree().size() - 1);  // every node except the root is below one other
    EXPECT_EQ(std::set<size_t>(below.begin(), below.end()).size(), below.size());
  }
}

void expectHeld(const Tool& tool, const Tool::Node& above, const Tool::Node& node, const Eigen::Vector3d& direction) {
  if (node.piece) {
    EXPECT_GE(above.shape_T.support(direction), node.shape_T.support(direction) - 1e-12);
    return;
  }
  for (const size_t below : node.below) expectHeld(tool, above, tool.tree()[below], direction);
}

TEST(ToolTest, EveryNodeContainsThePiecesBelowIt) {
  Random random(/*seed=*/12);
  for (int i = 0; i < 50; ++i) {
    const Tool tool = randomParts(random, 1 + random.below(20));
    for (const Tool::Node& node : tool.tree()) {
      for (int k = 0; k < 50; ++k) expectHeld(tool, node, node, random.direction());
    }
  }
}

TEST(ToolTest, BoundingRadiusAndBoundsContainEveryPiece) {
  Random random(/*seed=*/13);
  for (int i = 0; i < 200; ++i) {
    const Tool tool = randomParts(random, 1 + random.below(5));
    for (const ConvexPiece& part : tool.pieces()) {
      const Eigen::Vector3d p_T = part.shape_T.supportPoint(random.direction());
      EXPECT_LE(p_T.norm(), tool.boundingRadius() + 1e-12);
      EXPECT_LE(tool.bounds_T().exteriorDistance(p_T), 1e-12);
      const Eigen::Vector3d axis = random.direction();
      EXPECT_LE(p_T.cross(axis).norm(), part.shape_T.radiusAbout(axis) + 1e-12);
    }
  }
}

// The support function is the value at the support point, and no point of the body reaches farther.
TEST(ToolTest, PiecesReachAsFarAsTheirSupportPoints) {
  Random random(/*seed=*/14);
  for (int i = 0; i < 300; ++i) {
    const ConvexShape shape = randomShape(random);
    for (int k = 0; k < 20; ++k) {
      const Eigen::Vector3d direction = random.direction();
      EXPECT_NEAR(shape.support(direction), direction.dot(shape.supportPoint(direction)), 1e-12);
      const Eigen::Vector3d other = shape.supportPoint(random.direction());
      EXPECT_GE(shape.support(direction), direction.dot(other) - 1e-12);
      EXPECT_LE(direction.dot(shape.frontSupport(-direction)), shape.support(direction) + 1.0);
    }
  }
}

}  // namespace
}  // namespace sweep_guard_core
