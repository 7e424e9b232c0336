#include "camera/depth_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "allocations.h"
#include "camera/depth_surface_fixture.h"
#include "detection/exact_oracle.h"
#include "refusal.h"
#include "scenes.h"
#include "sweep_guard/detection/detector.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {
namespace {

TEST_F(DepthSurfaceTest, EachPixelLiesOnItsRayInTheFrameOfTheSurface) {
  Random random(1);
  const Eigen::Isometry3d X_FC = random.pose({0.3, -1.2, 2.0});
  std::vector<float> depths = wall(0.0F);
  for (float& depth : depths) depth = static_cast<float>(random.uniform(0.2, 3.9));
  const TriangleMesh mesh_F = take(depths, X_FC);
  for (std::uint32_t row = 0; row < kHeight; ++row) {
    for (std::uint32_t column = 0; column < kWidth; ++column) {
      const Eigen::Vector3d expected = X_FC * onRay(column, row, double{at(depths, column, row)});
      EXPECT_LE((mesh_F.vertex(grid_.place(column, row)) - expected).norm(), mesh_F.rounding() + 1e-12);
    }
  }
}

TEST_F(DepthSurfaceTest, AMarginBringsASurfaceNearerAlongItsRay) {
  const TriangleMesh mesh_F = take(wall(2.0F), Eigen::Isometry3d::Identity(), {0.1, 4.0, {0.01, 0.005}});
  for (const auto& [column, row] : {std::pair(0U, 0U), {26U, 18U}, {52U, 37U}}) {
    const Eigen::Vector3d far = onRay(column, row, 2.0);
    const Eigen::Vector3d near = mesh_F.vertex(grid_.place(column, row));
    EXPECT_NEAR((far - near).norm(), 0.03, 1e-6);
    EXPECT_NEAR(near.normalized().dot(far.normalized()), 1.0, 1e-9);
  }
}

TEST_F(DepthSurfaceTest, EveryTriangleOfAWallExistsOnce) {
  const TriangleMesh mesh_F = take(wall(1.0F));
  size_t count = 0;
  Submesh(mesh_F).forEachTriangle([&](std::uint32_t /*i*/) { ++count; });
  EXPECT_EQ(count, 2U * (kWidth - 1) * (kHeight - 1));
  EXPECT_EQ(trianglesOf(mesh_F).size(), count);
}

TEST_F(DepthSurfaceTest, NoTriangleExistsAtAPixelThatSeesNothing) {
  for (const float nothing : {kNone, std::numeric_limits<float>::infinity(), 0.0F, -1.0F, 0.05F, 4.5F, 65.535F}) {
    std::vector<float> depths = wall(1.0F);
    at(depths, 7, 3) = nothing;  // in the corner of a tile
    const auto triangles = trianglesOf(take(depths));
    EXPECT_EQ(triangles.size(), 2U * (kWidth - 1) * (kHeight - 1) - 6U) << nothing;
    for (const auto& triangle : triangles) EXPECT_EQ(triangle.count(grid_.place(7, 3)), 0U);
  }
}

TEST_F(DepthSurfaceTest, NothingSeenHasNoTriangleAndIsWhereTheCameraIs) {
  Random random(2);
  const Eigen::Isometry3d X_FC = random.pose({1.0, 2.0, 3.0});
  const TriangleMesh mesh_F = take(wall(kNone), X_FC);
  EXPECT_TRUE(trianglesOf(mesh_F).empty());
  EXPECT_TRUE(mesh_F.bounds_M().isApprox(Eigen::AlignedBox3d(X_FC.translation(), X_FC.translation()), 1e-6));
}

TEST_F(DepthSurfaceTest, PixelsThatSeeNothingMakeNoBoxLarger) {
  for (const auto& [first, end] : {std::pair(2U, 8U), std::pair(10U, 20U), std::pair(20U, 26U)}) {
    std::vector<float> depths = wall(kNone);
    for (std::uint32_t row = first; row < end; ++row) {
      for (std::uint32_t column = 10; column < 20; ++column) at(depths, column, row) = 1.0F;
    }
    const Eigen::AlignedBox3d seen(onRay(10, first, 1.0), onRay(19, end - 1, 1.0));
    const Eigen::AlignedBox3d box = take(depths).bounds_M();
    EXPECT_TRUE(box.isApprox(seen, 1e-6)) << first;
  }
}

TEST_F(DepthSurfaceTest, AStepIsTheEdgeOfWhatIsSeenAndASteepSurfaceIsNone) {
  std::vector<float> steps = wall(1.0F);
  std::vector<float> steep = wall(1.0F);
  for (std::uint32_t row = 0; row < kHeight; ++row) {
    for (std::uint32_t column = 20; column < kWidth; ++column) {
      at(steps, column, row) = 1.5F;
      at(steep, column, row) = 1.0F + 0.05F * static_cast<float>(column - 19);  // 72 degrees
    }
  }
  const auto broken = trianglesOf(take(steps));
  EXPECT_EQ(broken.size(), 2U * (kWidth - 2) * (kHeight - 1));
  EXPECT_EQ(broken.count({grid_.place(19, 5), grid_.place(20, 5), grid_.place(19, 6)}), 0U);
  EXPECT_EQ(trianglesOf(take(steep)).size(), 2U * (kWidth - 1) * (kHeight - 1));
}

// Noise of the camera is no step.
TEST_F(DepthSurfaceTest, AStepIsLargerThanTwiceTheMargin) {
  std::vector<float> depths = wall(0.1F);
  for (size_t i = 0; i < depths.size(); i += 2) depths[i] = 0.16F;
  EXPECT_TRUE(trianglesOf(take(depths)).size() < 10U);
  EXPECT_EQ(trianglesOf(take(depths, Eigen::Isometry3d::Identity(), {0.05, 4.0, {0.03, 0.0}})).size(),
            2U * (kWidth - 1) * (kHeight - 1));
}

bool joined(double depth, double other) {
  const auto step = [](double z) {
    return 10.0 * std::hypot(1.0 / 60.0, 1.0 / 58.0) * z + 2.0 * (0.005 + 0.003 * z * z);
  };
  return std::abs(depth - other) <= std::min(step(depth), step(other));
}

TEST(DepthSurfaceRuleTest, ATriangleExistsIfItsCornersAreSeenAndNoStepIsBetweenTwoOfThem) {
  Random random(3);
  std::array<size_t, 2> count{};
  for (const auto& [width, height] :
       {std::pair(2U, 2U), {3U, 9U}, {8U, 4U}, {9U, 5U}, {17U, 3U}, {64U, 31U}, {95U, 66U}}) {
    const Grid grid(width, height);
    std::vector<float> depths(size_t{width} * height);
    for (float& depth : depths)
      depth = random.chance(0.1) ? kNone : static_cast<float>(random.uniform(1.0, random.chance(0.2) ? 2.0 : 1.1));
    std::vector<float> at(grid.places(), kNone);
    for (std::uint32_t i = 0; i < depths.size(); ++i) at[grid.place(i % width, i / width)] = depths[i];
    DepthSurface surface(grid, kCamera, {0.1, 4.0, {0.005, 0.003}});
    surface.take(depths, Eigen::Isometry3d::Identity());
    const std::vector<Triangle> triangles = grid.triangles();
    for (size_t i = 0; i < triangles.size(); ++i) {
      const auto& [a, b, c] = triangles[i];
      const bool expected = a != b && joined(at[a], at[b]) && joined(at[b], at[c]) && joined(at[c], at[a]);
      EXPECT_EQ((surface.existing()[i / simd::kCluster] >> i % simd::kCluster & 1U) == 1U, expected)
          << width << ", " << i;
      ++count.at(expected ? 1 : 0);
    }
  }
  EXPECT_GT(count[0], 1000U);
  EXPECT_GT(count[1], 1000U);
}

TEST_F(DepthSurfaceTest, WhatWasSeenBeforeIsForgotten) {
  DepthSurface surface(grid_, kCamera, kExact);
  TriangleMesh mesh_F(grid_);
  for (const auto& depths : {wall(1.0F), wall(kNone)}) {
    surface.take(depths, Eigen::Isometry3d::Identity());
    mesh_F.deform(surface.places_F(), surface.before_F(), surface.existing());
  }
  EXPECT_EQ(surface.seen(), 0U);
  EXPECT_TRUE(trianglesOf(mesh_F).empty());
}

TEST_F(DepthMotionTest, APixelMovesAlongItsRayAsFarAsItReaches) {
  take(wall(1.0F), 0.0);
  const double length = onRay(40, 30, 1.0).norm();  // of a ray up to depth 1
  std::vector<float> nearer = wall(0.9F);
  take(nearer, 0.1001 * length);
  EXPECT_TRUE(before(40, 30).isApprox(onRay(40, 30, 1.0), 1e-6));
  EXPECT_TRUE(now(40, 30).isApprox(onRay(40, 30, 0.9), 1e-6));
}

TEST_F(DepthMotionTest, WhatCameFromFartherAwayIsThereAtOnce) {
  take(wall(1.0F), 0.0);
  take(wall(0.9F), 0.0999 * onRay(40, 30, 1.0).norm());
  EXPECT_EQ(before(40, 30), now(40, 30));
}

TEST_F(DepthMotionTest, WhatWasNotSeenBeforeIsThereAtOnce) {
  std::vector<float> gap = wall(1.0F);
  at(gap, 40, 30) = kNone;
  take(gap, 0.0);
  take(wall(1.0F), 10.0);
  EXPECT_EQ(before(40, 30), now(40, 30));
  EXPECT_TRUE(now(40, 30).isApprox(onRay(40, 30, 1.0), 1e-6));
}

TEST_F(DepthMotionTest, NothingMovesAlongTheRaysOfACameraThatMoves) {
  take(wall(1.0F), 0.0);
  X_FC_.translation().x() = 1e-3;
  take(wall(0.99F), 10.0);
  EXPECT_EQ(before(40, 30), now(40, 30));
}

TEST_F(DepthMotionTest, WhatTheRobotHidesStaysWhereItWasSeen) {
  take(wall(1.0F), 0.0);
  takeRobotBefore(1.0F);
  EXPECT_EQ(surface_.self(), 1U);
  EXPECT_EQ(surface_.seen(), size_t{kWidth} * kHeight);
  EXPECT_TRUE(now(26, 18).isApprox(onRay(26, 18, 1.0), 1e-6));
  TriangleMesh mesh_F(grid_);
  mesh_F.deform(surface_.places_F(), surface_.before_F(), surface_.existing());
  EXPECT_EQ(trianglesOf(mesh_F).size(), 2U * (kWidth - 1) * (kHeight - 1));
}

TEST_F(DepthMotionTest, WhatTheRobotHasHiddenSinceTheBeginningIsNoSurface) {
  takeRobotBefore(1.0F);
  EXPECT_EQ(surface_.seen(), size_t{kWidth} * kHeight - 1);
}

TEST_F(DepthMotionTest, ACameraThatMovesForgetsWhatTheRobotHides) {
  take(wall(1.0F), 0.0);
  X_FC_.translation().x() = 1e-3;
  takeRobotBefore(1.0F);
  EXPECT_EQ(surface_.seen(), size_t{kWidth} * kHeight - 1);
}

// Each point of a kind.
std::vector<Eigen::Vector3d> pointsOf(PointKind kind, const std::vector<PicturePoint>& points) {
  std::vector<Eigen::Vector3d> found;
  for (const PicturePoint& point : points) {
    if (point.kind == kind) found.emplace_back(point.p_F.cast<double>());
  }
  return found;
}

TEST_F(DepthMotionTest, APointIsSeenOrRememberedWhereItsVertexIsAndTheRobotWhereItIsSeen) {
  const DepthOptions options{0.1, 4.0, {0.01, 0.0}};
  DepthSurface surface(grid_, kCamera, options);
  surface.take(wall(1.0F), X_FC_);
  std::vector<float> robot = withSpot(wall(1.0F), 0.5F);
  at(robot, 25, 18) = kNone;
  at(robot, 40, 30) = kNone;
  surface.take(robot, X_FC_, 0.0, {boxAt(0.5)});
  const auto points = surface.points(robot, robot.size());
  const auto remembered = pointsOf(PointKind::kRemembered, points);
  ASSERT_EQ(remembered.size(), 2U);
  EXPECT_EQ(surface.hidden(), 2U);
  EXPECT_TRUE(remembered[1].isApprox(onRay(26, 18, 1.0) - 0.01 * onRay(26, 18, 1.0).normalized(), 1e-6));
  const auto self = pointsOf(PointKind::kSelf, points);
  ASSERT_EQ(self.size(), 1U) << "in the other pixel it is not seen";
  EXPECT_TRUE(self[0].isApprox(onRay(26, 18, 0.5), 1e-6));
  const auto seen = pointsOf(PointKind::kSeen, points);
  EXPECT_EQ(seen.size(), size_t{kWidth} * kHeight - 3);
  EXPECT_TRUE(seen[0].isApprox(onRay(0, 0, 1.0) - 0.01 * onRay(0, 0, 1.0).normalized(), 1e-6));
}

TEST_F(DepthMotionTest, WhereTheRobotHasHiddenAllSinceTheBeginningNoPointIsRemembered) {
  const std::vector<float> robot = withSpot(wall(7.0F), 0.5F);  // beyond the range
  take(robot, 0.0, {boxAt(0.5)});
  const auto points = surface_.points(robot, robot.size());
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].kind, PointKind::kSelf);
  EXPECT_EQ(surface_.hidden(), 0U);
}

TEST_F(DepthMotionTest, PointsOfALargeImageAreFewerAllOverThePicture) {
  X_FC_ = placedAt(0.1, 0.2, 0.3);
  take(wall(1.0F), 0.0);
  const auto points = surface_.points(wall(1.0F), 300);
  EXPECT_EQ(points.size(), 18U * 13U) << "every third column and row";
  EXPECT_TRUE(points.front().p_F.cast<double>().isApprox(X_FC_ * onRay(0, 0, 1.0), 1e-6));
  EXPECT_TRUE(points.back().p_F.cast<double>().isApprox(X_FC_ * onRay(51, 36, 1.0), 1e-6));
}

// As of a black one, or in its shadow.
TEST_F(DepthMotionTest, WhatARobotWithoutDepthHidesStaysWhereItWasSeen) {
  take(wall(1.0F), 0.0);
  std::vector<float> robot = withSpot(wall(1.0F), kNone);
  at(robot, 50, 5) = kNone;
  take(robot, 0.0, {boxAt(0.5)});
  EXPECT_EQ(surface_.self(), 1U);
  EXPECT_EQ(surface_.seen(), size_t{kWidth} * kHeight - 1) << "beside it, nothing is seen";
  EXPECT_TRUE(now(26, 18).isApprox(onRay(26, 18, 1.0), 1e-6));
}

TEST_F(DepthMotionTest, WhatHasGivenWayToTheDistanceIsNotRemembered) {
  take(wall(1.0F), 0.0);
  take(wall(7.0F), 0.0);
  takeRobotBefore(7.0F);
  EXPECT_EQ(surface_.seen(), 0U);
}

// Transforms between two equal ones differ in their last digits.
TEST_F(DepthMotionTest, ACameraThatRestsUpToRoundingRemembers) {
  take(wall(1.0F), 0.0);
  X_FC_ = Eigen::AngleAxisd(1e-13, Eigen::Vector3d::UnitX());
  X_FC_.translation().x() = 1e-13;
  take(wall(0.9F), 1.0);
  EXPECT_TRUE(surface_.rests());
  EXPECT_TRUE(before(40, 30).isApprox(onRay(40, 30, 1.0), 1e-6));
}

TEST_F(DepthMotionTest, SmallMotionsOfACameraAddUp) {
  take(wall(1.0F), 0.0);
  for (int i = 0; i < 2; ++i) {
    X_FC_.translation().x() += 0.6 * DepthSurface::kStill;
    take(wall(1.0F), 1.0);
    EXPECT_EQ(surface_.rests(), i == 0);
  }
}

TEST_F(DepthMotionTest, TheMarginTakesTheRobotNotOutOfItsVolume) {
  DepthSurface surface(grid_, kCamera, {0.1, 4.0, {0.1, 0.0}});
  surface.take(wall(0.5F), X_FC_, 0.0, {boxAt(0.5)});
  EXPECT_GT(surface.self(), 50U);
}

TEST_F(DepthMotionTest, ARobotAllOverThePictureHidesAllThatWasSeen) {
  SweptVolume robot = boxAt(0.5);
  robot.box.half_extents = {1.0, 1.0, 0.05};
  take(wall(1.0F), 0.0);
  take(wall(1.0F), 0.0);
  take(wall(0.5F), 0.0, {robot});
  EXPECT_EQ(surface_.self(), size_t{kWidth} * kHeight);
  EXPECT_EQ(surface_.hidden(), surface_.self());
  for (std::uint32_t row = 0; row < kHeight; ++row) {
    for (std::uint32_t column = 0; column < kWidth; ++column)
      EXPECT_TRUE(now(column, row).isApprox(onRay(column, row, 1.0), 1e-6)) << column << ' ' << row;
  }
}

// A camera's fault lasts for one image, and what came for more.
TEST_F(DepthMotionTest, WhatOnlyOneImageShowsIsNotRemembered) {
  const std::vector<float> speck = withSpot(wall(1.0F), 0.9F);
  const std::vector<float> robot = withSpot(wall(1.0F), 0.5F);
  take(wall(1.0F), 0.0);
  take(speck, 0.0);
  take(robot, 0.0, {boxAt(0.5)});
  EXPECT_TRUE(now(26, 18).isApprox(onRay(26, 18, 1.0), 1e-6));
  take(speck, 0.0);
  take(speck, 0.0);
  take(robot, 0.0, {boxAt(0.5)});
  EXPECT_TRUE(now(26, 18).isApprox(onRay(26, 18, 0.9), 1e-6));
}

TEST_F(DepthMotionTest, WhatStoodBeforeTheRobotHasGoneWhereTheRobotIsSeen) {
  const std::vector<float> robot = withSpot(wall(1.0F), 0.7F);
  take(wall(1.0F), 0.0);
  take(wall(0.5F), 0.0);
  take(wall(0.5F), 0.0);
  take(robot, 0.0, {boxAt(0.7)});
  EXPECT_TRUE(now(26, 18).isApprox(onRay(26, 18, 1.0), 1e-6));
}

TEST_F(DepthMotionTest, WhereNothingIsKnownBehindTheRobotWhatStoodBeforeItLeavesNoSurface) {
  const std::vector<float> robot = withSpot(wall(1.0F), 0.7F);
  take(wall(0.5F), 0.0);
  take(robot, 0.0, {boxAt(0.7)});
  EXPECT_EQ(surface_.seen(), size_t{kWidth} * kHeight - 1);
}

TEST_F(DepthMotionTest, WhatStandsBesideTheRobotIsASurface) {
  take(wall(1.0F), 0.0);
  take(wall(0.5F), 0.0, {boxAt(0.6)});
  EXPECT_EQ(surface_.self(), 0U);
  EXPECT_TRUE(now(26, 18).isApprox(onRay(26, 18, 0.5), 1e-6));
}

// Of points 1 cm behind the face of the robot, which is a box of 0.1 m.
TEST_F(DepthMotionTest, ThePointsOfTheRobotAreFoundWhereThePictureShowsIt) {
  std::vector<Eigen::Vector3d> points;
  for (const double x : {-0.03, 0.0, 0.03}) points.emplace_back(x, 0.0, 0.51);
  const std::vector<SweptVolume> robot = {boxAt(0.5)};
  const auto compared = [&](const std::vector<float>& depths) {
    take(depths, 0.0, robot);
    const auto [all, found] = surface_.compare(depths, points, 0.0);
    return std::pair(all, found);
  };
  EXPECT_EQ(compared(wall(0.5F)), std::pair(size_t{3}, size_t{3}));
  EXPECT_EQ(compared(wall(1.0F)), std::pair(size_t{3}, size_t{0})) << "the robot is elsewhere";
  EXPECT_EQ(compared(wall(0.3F)), std::pair(size_t{0}, size_t{0})) << "something stands before it";
  EXPECT_EQ(compared(wall(kNone)), std::pair(size_t{0}, size_t{0}));
  points = {{5.0, 0.0, 0.5}, {0.0, 0.0, -0.5}};
  EXPECT_EQ(compared(wall(1.0F)), std::pair(size_t{0}, size_t{0})) << "beside the picture, and behind the camera";
}

// The wall is seen where the point is expected, and the robot two pixels beside.
TEST_F(DepthMotionTest, APointIsFoundIfTheRobotIsSeenAsNearAsTheBodiesWereGrown) {
  std::vector<float> robot = wall(1.0F);
  at(robot, 28, 18) = 0.5F;
  take(robot, 0.0, {boxAt(0.5)});
  const std::vector<Eigen::Vector3d> points = {onRay(26, 18, 0.5)};
  EXPECT_EQ(surface_.compare(robot, points, 0.0).found, 0U);
  EXPECT_EQ(surface_.compare(robot, points, 0.02).found, 1U);
}

TEST_F(DepthSurfaceTest, AnImageAllocatesNoMoreThanItsSecondThread) {
  DepthSurface surface(grid_, kCamera, kExact);
  TriangleMesh mesh_F(grid_);
  const std::vector<float> depths = wall(1.0F);
  for (int i = 0; i < 3; ++i) surface.take(depths, Eigen::Isometry3d::Identity());
  mesh_F.deform(surface.places_F(), surface.before_F(), surface.existing());
  const Allocations allocations;
  surface.take(depths, Eigen::Isometry3d::Identity());
  mesh_F.deform(surface.places_F(), surface.before_F(), surface.existing());
  EXPECT_LE(allocations.count(), 3U) << allocations.stacks();
  EXPECT_LT(allocations.largest(), 1000U) << allocations.stacks();
}

// Half of the picture may be that of the image before.
TEST_F(DepthSurfaceTest, WhatAnImageLeftThatRanOutOfMemoryIsForgotten) {
  DepthSurface surface(grid_, kCamera, kExact);
  const auto rests = [&] {
    surface.take(wall(1.0F), Eigen::Isometry3d::Identity());
    return surface.rests();
  };
  for (int i = 0; i < 3; ++i) rests();
  const std::vector<float> depths = wall(1.0F);
  {
    const FailingAllocation failing(1);
    EXPECT_THROW(surface.take(depths, Eigen::Isometry3d::Identity()), std::bad_alloc);
  }
  EXPECT_FALSE(rests());
  EXPECT_TRUE(rests());
}

TEST_F(DepthSurfaceTest, ACameraOrARangeThatIsNoneIsRefused) {
  const auto refused = [&](const Pinhole& camera, const DepthOptions& options) {
    return refusal([&] { DepthSurface(grid_, camera, options); });
  };
  EXPECT_TRUE(has(refused({0.0, 0.0, 0.0, 0.0}, kExact), "it is not calibrated"));
  EXPECT_TRUE(has(refused({60.0, std::nan(""), 0.0, 0.0}, kExact), "it is not calibrated"));
  EXPECT_TRUE(has(refused(kCamera, {0.0, 1.0, {0.0, 0.0}}), "begins above 0"));
  EXPECT_TRUE(has(refused(kCamera, {1.0, 1.0, {0.0, 0.0}}), "begins above 0"));
  EXPECT_TRUE(has(refused(kCamera, {0.1, 1.0, {-0.1, 0.0}}), "at least 0"));
}

// A mesh of ordinary triangles stands for those that exist.
class GridDetectionTest : public testing::TestWithParam<std::string> {};

TEST_P(GridDetectionTest, FindsOfTheTrianglesThatExistWhatTheExactOracleFindsAndNoOther) {
  const auto detector = makeDetector(GetParam());
  const Grid grid(kWidth, kHeight);
  size_t met = 0;
  size_t passed = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Random random(seed);
    std::vector<float> depths = wall(kNone);
    for (float& depth : depths) depth = random.chance(0.1) ? kNone : static_cast<float>(random.uniform(1.0, 1.1));
    DepthSurface surface(grid, kCamera, kExact);
    surface.take(depths, random.pose({0.0, 0.0, 0.0}));
    TriangleMesh mesh_F(grid);
    mesh_F.deform(surface.places_F(), surface.before_F(), surface.existing());
    SweptVolume volume;
    volume.box.half_extents = Eigen::Vector3d::Constant(random.uniform(0.1, 0.3));
    volume.box.X_MB = random.pose(mesh_F.vertex(grid.place(20, 20)));
    const TriangleSet found = detector->detect(mesh_F, volume).triangles;
    std::set<std::uint32_t> existing;
    Submesh(mesh_F).forEachTriangle([&](std::uint32_t i) { existing.insert(i); });
    for (const std::uint32_t i : found) EXPECT_EQ(existing.count(i), 1U);
    for (std::uint32_t i = 0; i < mesh_F.triangles().size(); ++i) {
      if (!meetsExactly(mesh_F, i, volume)) continue;
      const bool exists = existing.count(i) == 1;
      EXPECT_TRUE(!exists || std::binary_search(found.begin(), found.end(), i)) << seed;
      ++(exists ? met : passed);
    }
  }
  EXPECT_GT(met, 1000U);
  EXPECT_GT(passed, 1000U);
}

INSTANTIATE_TEST_SUITE_P(AllDetectors, GridDetectionTest, testing::ValuesIn(detectorNames()));

}  // namespace
}  // namespace sweep_guard_core
