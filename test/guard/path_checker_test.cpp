#include "guard/path_checker.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/floating_point.h"
#include "detection/reference_detector.h"
#include "guard/clearance_by_clipping.h"

namespace sweep_guard_core {
namespace {

constexpr double kPathTolerance = 2e-3;  // [standard deviations]
constexpr double kMeasured = 1.5;        // the corners of a volume may lie farther out of reach than the tool
constexpr Duration kStep = std::chrono::milliseconds(20);

Tool toolOf(Random& random, size_t pieces) {
  std::vector<ConvexPiece> all;
  for (size_t i = 0; i < pieces; ++i) {
    const Eigen::Isometry3d X = random.pose(random.inBox({0.1, 0.1, 0.1}));
    all.push_back({"link", ConvexShape::box({0.01, 0.02, 0.03}).placed(X)});
  }
  return Tool(std::move(all));
}

// A path along which the tool turns, drifts, and is ever less certain.
PredictedPath randomPath(Random& random, const Eigen::Isometry3d& X_WT) {
  const Eigen::Vector3d step = 0.02 * random.direction();
  const Eigen::AngleAxisd turn(0.03, random.direction());
  const Vector6d sigmas = random.logUniform(0.003, 0.03) * Vector6d::Ones();
  PredictedPath path;
  Eigen::Isometry3d X = X_WT;
  for (int i = 1; i <= 8; ++i) {
    X = Eigen::Translation3d(step) * X * turn;
    path.push_back({i * kStep, X, i * i * Matrix6d(sigmas.cwiseProduct(sigmas).asDiagonal())});
  }
  return path;
}

TriangleMesh randomSoup(Random& random, const Eigen::Vector3d& middle) {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const Eigen::Vector3d place = middle + random.uniform(0.2, 0.6) * random.direction();
    for (int k = 0; k < 3; ++k)
      vertices.emplace_back((place + random.inBox({0.03, 0.03, 0.03})).cast<float>().cast<double>());
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return TriangleMesh(vertices, triangles);
}

struct PathScene {
  explicit PathScene(std::uint64_t seed, const Eigen::Vector3d& middle = Eigen::Vector3d::Zero())
      : random(seed), middle_of_soup(middle) {}

  Random random;
  Eigen::Vector3d middle_of_soup;
  Tool tool = toolOf(random, 12);
  Eigen::Isometry3d X_WT = random.pose(Eigen::Vector3d::Zero());
  PredictedPath path = randomPath(random, X_WT);
  std::shared_ptr<const Workpiece> workpiece = std::make_shared<const Workpiece>(
      Workpiece{"soup", 0, Time(), SteadyTime(), "table", randomSoup(random, middle_of_soup)});
};

PredictedObject checkedAlone(const PathScene& scene) {
  ReferenceDetector detector;
  PathChecker checker(SweepOptions(), kStep);
  PredictedObject object;
  checker.check(detector, {scene.tool, scene.X_WT, scene.path, 0, Eigen::Isometry3d::Identity(), scene.workpiece, {}},
                object);
  return object;
}

constexpr double kSharedRounding = 0x1p-20;  // [m] more than that of these meshes, which share one path

// Of each piece in one step, compared with each triangle.
std::vector<double> clearances(const PathScene& scene, size_t step) {
  const PredictedPose& end = scene.path[step];
  const Motion motion{step == 0 ? scene.X_WT : scene.path[step - 1].X_WT, end.X_WT};
  const TriangleMesh& mesh_M = scene.workpiece->mesh_M;
  std::vector<double> all;
  for (const ConvexPiece& piece : scene.tool.pieces()) {
    const SweptVolume swept_M =
        sweptVolume(piece.shape_T, motion, SweepOptions().volume, SweepOptions().margin + kSharedRounding);
    all.push_back(
        clearanceByClipping(mesh_M, swept_M, planeDeviations(piece.shape_T, end.X_WT, end.covariance, swept_M)));
  }
  return all;
}

struct Found {
  int nearer = 0;
  int no_nearer = 0;
};

// A sweep that comes no nearer than an earlier one need not say how near.
void expectTheNearestPiece(const PathScene& scene, Found& found) {
  const PredictedObject object = checkedAlone(scene);
  ASSERT_EQ(object.sweeps.size(), scene.path.size());
  double before = kInfinity;
  for (size_t step = 0; step < object.sweeps.size(); ++step) {
    const PredictedSweep& sweep = object.sweeps[step];
    const std::vector<double> all = clearances(scene, step);
    const double least = *std::min_element(all.begin(), all.end());
    EXPECT_GE(sweep.deviations, least - kPathTolerance) << "step " << step;
    if (least < std::min(before - kPathTolerance, kMeasured)) {
      ++found.nearer;
      EXPECT_NEAR(sweep.deviations, least, kPathTolerance) << "step " << step;
      ASSERT_TRUE(sweep.tool_piece);
      if (!sweep.contact) {
        EXPECT_NEAR(all[*sweep.tool_piece], least, kPathTolerance) << "step " << step;
      }
    }
    if (least > before + kPathTolerance && least > 0.0) {
      found.no_nearer += sweep.deviations == kInfinity;
      EXPECT_GT(sweep.deviations, before) << "step " << step;
    }
    before = std::min(before, sweep.deviations);
  }
}

TEST(PathCheckerTest, FindsTheNearestPieceThatComparingEachPieceWithEachTriangleFinds) {
  Found found;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    expectTheNearestPiece(PathScene(seed), found);
  }
  EXPECT_GT(found.nearer, 50);
  EXPECT_GT(found.no_nearer, 10);
}

// There, bounds leave out pieces and steps before they have volumes.
TEST(PathCheckerTest, FindsTheNearestPieceBesideAWorkpieceToo) {
  Found found;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    expectTheNearestPiece(PathScene(seed, {0.75, 0.0, 0.0}), found);
  }
  EXPECT_GT(found.nearer, 50);
  EXPECT_GT(found.no_nearer, 3);
}

}  // namespace
}  // namespace sweep_guard_core
