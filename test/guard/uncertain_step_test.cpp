#include "guard/uncertain_step.h"

#include <gtest/gtest.h>

#include "guard/clearance_by_clipping.h"
#include "guard/path_in_mesh.h"

namespace sweep_guard_core {
namespace {

using namespace std::chrono_literals;

constexpr double kMargin = 0.002;        // [m]
constexpr double kStepTolerance = 1e-3;  // [standard deviations]
constexpr double kMaxTurn = 0.1;         // [rad]

Tool randomTool(Random& random) {
  std::vector<ConvexPiece> pieces;
  for (int i = random.below(5); i >= 0; --i) {
    pieces.push_back(
        {"link", randomShape(random, /*hull_points=*/6).placed(random.pose(random.inBox({0.1, 0.1, 0.2})))});
  }
  return Tool(pieces);
}

// Of any kind: what grows with time need not be all of it.
Matrix6d randomCovariance(Random& random) {
  Matrix6d covariance = Matrix6d::Zero();
  for (int i = random.below(4); i >= 0; --i) {
    Eigen::Matrix<double, 6, 1> error;
    error << random.logUniform(0.01, 0.1) * random.direction(), random.logUniform(0.01, 0.2) * random.direction();
    covariance += error * error.transpose();
  }
  return covariance;
}

// Two steps, so that the first pose of the second errs, too.
PredictedPath randomSteps(Random& random, const Eigen::Isometry3d& X_WT) {
  PredictedPath path;
  Eigen::Isometry3d X = X_WT;
  for (int i = 1; i <= 2; ++i) {
    X = Eigen::Translation3d(random.uniform(0.0, 0.05) * random.direction()) * X *
        random.turn(random.uniform(0.0, 0.4));
    path.push_back({i * 50ms, X, randomCovariance(random), random.chance(0.5) ? 0.0 : 0.005});
  }
  return path;
}

FramePath randomFrame(Random& random) {
  FramePath frame;
  Eigen::Isometry3d X = random.pose(random.inBox({0.3, 0.3, 0.3}));
  for (int i = 0; i <= 2; ++i) {
    frame.points.push_back({X, i == 0 ? Matrix6d::Zero() : randomCovariance(random), i == 0 ? 0.0 : 0.001});
    X = Eigen::Translation3d(random.uniform(0.0, 0.05) * random.direction()) * X *
        random.turn(random.uniform(0.0, 0.3));
  }
  return frame;
}

TriangleMesh trianglesAround(Random& random, const Eigen::Vector3d& place) {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k)
      vertices.emplace_back((place + random.inBox({0.05, 0.05, 0.05})).cast<float>().cast<double>());
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return TriangleMesh(vertices, triangles);
}

Eigen::AlignedBox3d boundsOf(const TriangleMesh& mesh_M) {
  Eigen::AlignedBox3d bounds_M;
  for (std::uint32_t i = 0; i < mesh_M.vertexCount(); ++i) bounds_M.extend(mesh_M.vertex(i));
  return bounds_M;
}

// Of the step and of its parts.
double leastClearance(const PathInMesh& path_M, const PathSegment& segment, const ConvexShape& piece,
                      const TriangleMesh& mesh_M, VolumeKind kind, int halvings) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<Motion> motions_M;
  path_M.motions_M(segment, kMaxTurn, motions_M);
  for (const Motion& motion_M : motions_M) {
    const SweptVolume swept_M = sweptVolume(piece, motion_M, kind, kMargin);
    const PerHalfSpace deviations =
        planeDeviations(piece, path_M.end_M(segment).X_MT, path_M.end_M(segment).covariance_M, swept_M);
    least = std::min(least, clearanceByClipping(mesh_M, swept_M, deviations));
  }
  if (halvings == 0) return least;
  const auto [first, second] = path_M.halves(segment);
  return std::min({least, leastClearance(path_M, first, piece, mesh_M, kind, halvings - 1),
                   leastClearance(path_M, second, piece, mesh_M, kind, halvings - 1)});
}

bool holds(const Tool& tool, const Tool::Node& node, size_t piece) {
  if (node.piece) return *node.piece == piece;
  return holds(tool, tool.tree()[node.below[0]], piece) || holds(tool, tool.tree()[node.below[1]], piece);
}

TEST(UncertainStepTest, NoVolumeOfAPieceIsNearerThanItsBoundWhateverTheStepAndTheFrame) {
  Random random(/*seed=*/21);
  int near = 0;
  int far = 0;
  for (int i = 0; i < 1000; ++i) {
    const Tool tool = randomTool(random);
    const Eigen::Isometry3d X_WT = random.pose(random.inBox({0.3, 0.3, 0.3}));
    const PredictedPath path = randomSteps(random, X_WT);
    PathInMesh path_M;
    if (random.chance(0.5)) {
      path_M.follow(tool, X_WT, path, random.pose(random.inBox({0.3, 0.3, 0.3})));
    } else {
      path_M.follow(tool, X_WT, path, randomFrame(random));
    }
    const PathSegment step = path_M.between(1, 2);
    const Eigen::Vector3d beside_M = path_M.end_M(step).X_MT * tool.bounds_T().center();
    const TriangleMesh mesh_M = trianglesAround(random, beside_M + random.uniform(0.1, 0.5) * random.direction());
    const UncertainStep uncertain = path_M.uncertainStep(step, kMargin);
    const VolumeKind kind = random.chance(0.5) ? VolumeKind::kObb : VolumeKind::kObbPlanes;
    for (size_t piece = 0; piece < tool.pieces().size(); ++piece) {
      const double clearance = leastClearance(path_M, step, tool.pieces()[piece].shape_T, mesh_M, kind, 2);
      near += clearance < kMaxDeviations;
      for (const Tool::Node& node : tool.tree()) {
        if (!holds(tool, node, piece)) continue;
        const UncertainBall ball = uncertain.ballAround(node.bounds_T);
        const double least = ball.deviationsWithin(boundsOf(mesh_M).exteriorDistance(ball.center_M));
        far += least > 0.0 && clearance < kMaxDeviations;
        if (clearance < kMaxDeviations) {
          EXPECT_LE(least, std::max(0.0, clearance) + kStepTolerance) << i;
        }
      }
    }
  }
  EXPECT_GT(near, 200);
  EXPECT_GT(far, 50) << "bounds that tell apart";
}

// Its 10 mm count along each of three axes; so does a margin, in any direction.
TEST(UncertainStepTest, TheBallAroundABallIsThatAroundItsBox) {
  const Tool tool(ConvexShape::sphere(0.01));
  Matrix6d covariance = Matrix6d::Zero();
  covariance.diagonal() << 0.04, 0.0, 0.0, 0.0, 0.0, 0.0;
  const UncertainPose sure{Eigen::Isometry3d::Identity(), Matrix6d::Zero()};
  const UncertainPose unsure{Eigen::Isometry3d(Eigen::Translation3d(0.2, 0.0, 0.0)), covariance};
  const UncertainBall ball = UncertainStep(sure, unsure, 0.0).ballAround(tool.tree()[0].bounds_T);
  EXPECT_NEAR(ball.center_M.x(), 0.1, 1e-12);
  EXPECT_NEAR(ball.radius, 0.03 + 0.1, 1e-8);
  EXPECT_NEAR(ball.sigma, 0.2, 1e-8);
  EXPECT_NEAR(ball.deviationsWithin(0.53), 2.0, 1e-6);
  const UncertainBall grown = UncertainStep(unsure, sure, 0.1).ballAround(tool.tree()[0].bounds_T);
  EXPECT_NEAR(grown.radius, 0.03 + 0.1 + 0.1 * std::sqrt(3.0), 1e-8);
  EXPECT_NEAR(grown.sigma, 0.2, 1e-8);
}

}  // namespace
}  // namespace sweep_guard_core
