#include "guard/separating_directions.h"

#include <gtest/gtest.h>

#include "guard/swept_body.h"
#include "scenes.h"

namespace sweep_guard_core {
namespace {

using Eigen::Vector3d;

struct ToolAndTriangle {
  explicit ToolAndTriangle(Random& random, double size, double away)
      : shape_T(randomTool(random, size)),
        motion_M(randomMotion(random, shape_T, away * random.direction(), 0.17)),
        place_M(motion_M.X_MT_start.translation()) {}

  MovingTriangle triangle(Random& random, double size) const {
    MovingTriangle one;
    const Vector3d middle = place_M + size * random.uniform(0.0, 4.0) * random.direction();
    for (size_t i = 0; i < 3; ++i) {
      one.start_M[i] = middle + size * random.logUniform(0.01, 2.0) * random.direction();
      one.end_M[i] = one.start_M[i] + size * random.uniform(0.0, 0.5) * random.direction();
    }
    return one;
  }

  ConvexShape shape_T;
  Motion motion_M;
  Vector3d place_M;
};

// Directions at random, of which some separate: whatever is called separated is far from the hull of the motion.
TEST(SeparatingDirectionsTest, SeparateOnlyWhatTheHullMisses) {
  Random random(/*seed=*/1);
  int separated = 0;
  int missed = 0;
  for (int i = 0; i < 300; ++i) {
    const double size = random.logUniform(1e-3, 10.0);
    const ToolAndTriangle scene(random, size, random.chance(0.5) ? 0.0 : random.logUniform(1.0, 1e5));
    const double margin = random.chance(0.5) ? 0.0 : 0.1 * size;
    SeparatingDirections directions;
    const std::vector<Motion> motions_M = {scene.motion_M};
    directions.begin(scene.shape_T, motions_M, margin);
    for (size_t k = 0; k < simd::kMaxDirections + 3; ++k) directions.add(random.direction());
    for (const bool moves : {false, true}) {
      std::array<MovingTriangle, simd::kBatch> triangles;
      for (size_t place = 0; place < simd::kBatch; ++place) {
        triangles[place] = scene.triangle(random, size);
        if (!moves) triangles[place].end_M = triangles[place].start_M;
        directions.load(place, triangles[place], moves);
      }
      directions.separate();
      for (size_t place = 0; place < simd::kBatch; ++place) {
        const double all = margin + deviationBound(scene.shape_T, scene.motion_M);
        const bool is_missed = missedByHull(scene.shape_T, scene.motion_M, triangles[place], all);
        missed += is_missed ? 1 : 0;
        if (!directions.separated(place)) continue;
        ++separated;
        EXPECT_TRUE(is_missed) << "scene " << i << ", triangle " << place;
      }
    }
  }
  EXPECT_GT(separated, 1000);
  EXPECT_LT(separated, missed);
}

TEST(SeparatingDirectionsTest, LeaveAMarginAndTheDeviationOfArcs) {
  const ConvexShape ball = ConvexShape::sphere(1.0);
  std::vector<Motion> motions_M(1);
  motions_M[0].deviation_bound = 0.5;
  const auto separated = [&](double height) {
    SeparatingDirections directions;
    directions.begin(ball, motions_M, /*margin=*/0.25);
    directions.add(-Vector3d::UnitZ());
    const std::array<Vector3d, 3> corners = {Vector3d(0, 0, height), Vector3d(1, 0, height + 1),
                                             Vector3d(0, 1, height)};
    directions.load(0, {corners, corners}, false);
    directions.separate();
    return directions.separated(0);
  };
  EXPECT_TRUE(separated(1.7501));
  EXPECT_FALSE(separated(1.7499));
}

TEST(SeparatingDirectionsTest, AreKeptFromMotionToMotion) {
  const ConvexShape ball = ConvexShape::sphere(1.0);
  const std::array<Vector3d, 3> corners = {Vector3d(0, 0, 2), Vector3d(1, 0, 2), Vector3d(0, 1, 2)};
  const std::vector<Motion> at_rest(1);
  SeparatingDirections directions;
  directions.begin(ball, at_rest, 0.0);
  EXPECT_TRUE(directions.best_M(0).isZero(0.0));
  directions.add(-Vector3d::UnitZ());
  const auto separatedAt = [&](double height) {
    Motion there;
    there.X_MT_start.translation().z() = there.X_MT_end.translation().z() = height;
    const std::vector<Motion> motions_M = {there};
    directions.begin(ball, motions_M, 0.0);
    directions.load(0, {corners, corners}, false);
    directions.separate();
    EXPECT_EQ(directions.best_M(0), -Vector3d::UnitZ());
    return directions.separated(0);
  };
  EXPECT_TRUE(separatedAt(0.9));
  EXPECT_FALSE(separatedAt(1.1));
}

}  // namespace
}  // namespace sweep_guard_core
