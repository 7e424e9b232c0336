#include "evaluation/session_objects.h"

#include <gtest/gtest.h>

#include "evaluation/motions.h"
#include "evaluation/square_obstacle.h"

namespace sweep_guard_evaluation {
namespace {

using sweep_guard_core::TriangleMesh;

const RecordedMotion kMotion(straightMotion(0.1, milliseconds(20), seconds(10)));  // from x = 0 to 1 m

TEST(SessionObjectsTest, SheetsAreSquaresAroundWhereTheToolWas) {
  SessionOptions options;
  options.sheets = 300;
  double farthest = 0.0;
  for (const TriangleMesh& sheet : placeInWorkspace(kMotion, options, 0)) {
    const double side = (sheet.vertex(1) - sheet.vertex(0)).norm();
    EXPECT_GE(side, 0.1 - 1e-6);
    EXPECT_LE(side, 0.3 + 1e-6);
    const Eigen::Vector3d center = 0.5 * (sheet.vertex(0) + sheet.vertex(2));
    const double x = std::clamp(center.x(), 0.0, 1.0);
    const double distance = (center - x * Eigen::Vector3d::UnitX()).norm();
    EXPECT_LE(distance, 0.2 + 1e-6);
    farthest = std::max(farthest, distance);
  }
  EXPECT_GT(farthest, 0.18);
}

TEST(SessionObjectsTest, AreTheSameForTheSameSeedAndOthersInEachSession) {
  const SessionOptions options;
  const auto first = placeInWorkspace(kMotion, options, 0);
  EXPECT_EQ(first.size(), 20U);
  EXPECT_EQ(first[7].vertex(3), placeInWorkspace(kMotion, options, 0)[7].vertex(3));
  EXPECT_NE(first[7].vertex(3), placeInWorkspace(kMotion, options, 1)[7].vertex(3));
  SessionOptions next = options;
  next.seed = 2;
  EXPECT_EQ(placeInWorkspace(kMotion, next, 0)[7].vertex(3), placeInWorkspace(kMotion, options, 1)[7].vertex(3));
}

TEST(SessionObjectsTest, AMeshIsPlacedAtRandomOrStays) {
  SessionOptions options;
  options.sheets = 0;
  SquareObstacle far;
  far.X_WS.translation().x() = 50.0;
  options.placed = {meshOf(far)};
  options.fixed = {meshOf(far)};
  const auto objects = placeInWorkspace(kMotion, options, 0);
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_LT(objects[0].vertex(0).norm(), 1.5);
  EXPECT_EQ(objects[1].vertex(0), options.fixed[0].vertex(0));
}

}  // namespace
}  // namespace sweep_guard_evaluation
