#include "guard/path_in_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "detection/reference_detector.h"
#include "geometry/round_tool.h"
#include "guard/path_checker.h"
#include "scenes.h"

namespace sweep_guard_core {
namespace {

using namespace std::chrono_literals;

// A tool that swings about, ever less sure of where it is.
struct Swing {
  explicit Swing(Random& random) : axis(random.direction()), rate(random.uniform(0.5, 4.0)) {
    const Eigen::Matrix<double, 6, 1> unit =
        (Eigen::Matrix<double, 6, 1>() << random.direction(), random.direction()).finished();
    Matrix6d doubt = Matrix6d::Identity() * 1e-5;
    doubt += 1e-3 * unit * unit.transpose();
    for (int i = 1; i <= 11; ++i) path.push_back({i * 100ms, at(0.1 * i), 0.1 * i * doubt});
  }

  Eigen::Isometry3d at(double t) const {
    Eigen::Isometry3d X_WT(Eigen::AngleAxisd(rate * t, axis));
    X_WT.translation() = 0.2 * std::sin(rate * t) * axis.unitOrthogonal();
    return X_WT;
  }

  Eigen::Vector3d axis;
  double rate;
  PredictedPath path;
};

const ConvexShape kTool = ConvexShape::cylinder(0.01, 0.15);

// A path of the tool in a mesh anywhere.
PathInMesh randomPathInMesh(Random& random) {
  const Swing swing(random);
  PathInMesh motion;
  motion.follow(Tool(kTool), swing.at(0.0), swing.path, random.pose(random.inBox({1, 1, 1})));
  return motion;
}

TEST(PathInMeshTest, ReachesAsFarAsAnyToolPointThatErrs) {
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    const PathInMesh motion = randomPathInMesh(random);
    const PathSegment whole = motion.whole();
    const Eigen::AlignedBox3d box_M = motion.reach_M(whole, 2.0, 0.0);
    for (const auto& segment :
         {motion.halves(whole).first, motion.between(4, 5), motion.halves(motion.between(7, 8)).second}) {
      const Eigen::Isometry3d X_MT = motion.end_M(segment);
      const Matrix6d doubt = motion.covariance_M(segment).llt().matrixL();
      const Eigen::AlignedBox3d near_M = motion.reach_M(segment, 2.0, 0.0);
      for (const Eigen::Vector3d& p_T : roundToolPoints_T(kTool, 8)) {
        // Any error of two deviations, to first order.
        Eigen::Matrix<double, 6, 1> unit;
        unit << random.inBox({1, 1, 1}), random.inBox({1, 1, 1});
        const Eigen::Matrix<double, 6, 1> error = 2.0 * (doubt * unit.normalized());
        const Eigen::Vector3d r_M = X_MT.linear() * p_T;
        const Eigen::Vector3d p_M = X_MT * p_T + error.head<3>() + error.tail<3>().cross(r_M);
        EXPECT_TRUE(near_M.contains(p_M));
        EXPECT_TRUE(box_M.contains(p_M));
      }
    }
  }
}

// Doubt grows fastest at the begin: as the root of time.
TEST(PathInMeshTest, ReachesAsFarWithinAStepAsAtItsEnds) {
  Random random(5);
  for (int i = 0; i < 50; ++i) {
    const PathInMesh motion = randomPathInMesh(random);
    const Eigen::AlignedBox3d step_M = motion.reach_M(motion.between(0, 1), 3.0, 0.0);
    PathSegment part = motion.between(0, 1);
    for (int halving = 0; halving < 5; ++halving) {
      part = motion.halves(part).first;
      const Eigen::AlignedBox3d part_M = motion.reach_M(part, 3.0, 0.0);
      const double rounding = 1e-9 + chordError(Tool(kTool).boundingRadius(), 0.1);
      EXPECT_TRUE(
          Eigen::AlignedBox3d(step_M.min().array() - rounding, step_M.max().array() + rounding).contains(part_M));
    }
  }
}

// The same workpiece, with much more of it far away: nothing else is found.
TEST(PathCheckerTest, WhatIsOutOfReachMakesNoDifference) {
  Random random(4);
  ReferenceDetector detector;
  PathChecker checker({SweepOptions(), 5ms});
  int contacts = 0;
  for (int i = 0; i < 30; ++i) {
    std::vector<Eigen::Vector3d> vertices;
    std::vector<Triangle> triangles;
    const auto add = [&](const Eigen::Vector3d& place, double size) {
      const auto first = static_cast<std::uint32_t>(vertices.size());
      for (int k = 0; k < 3; ++k)
        vertices.emplace_back((place + random.inBox({size, size, size})).cast<float>().cast<double>());
      triangles.push_back({first, first + 1, first + 2});
    };
    for (int k = 0; k < 20; ++k) add(random.inBox({0.4, 0.4, 0.4}), 0.1);
    const TriangleMesh near_M(vertices, triangles);
    for (int k = 0; k < 200; ++k) add(random.uniform(10.0, 100.0) * random.direction(), 1.0);
    const TriangleMesh all_M(vertices, triangles);

    const Swing swing(random);
    const auto predicted = [&](const TriangleMesh& mesh_M) {
      PredictedObject object;
      checker.check(detector,
                    {Tool::cylinder(0.01, 0.15),
                     swing.at(0.0),
                     swing.path,
                     1,
                     Eigen::Isometry3d::Identity(),
                     std::make_shared<const Workpiece>(Workpiece{"one", 0, Time(), SteadyTime(), "table", mesh_M}),
                     {}},
                    object);
      return object;
    };
    const PredictedObject alone = predicted(near_M);
    const PredictedObject among = predicted(all_M);
    EXPECT_EQ(alone.reflex, among.reflex);
    EXPECT_EQ(alone.considered, among.considered);
    ASSERT_EQ(alone.sweeps.size(), among.sweeps.size());
    for (size_t k = 0; k < alone.sweeps.size(); ++k) {
      EXPECT_EQ(alone.sweeps[k].contact, among.sweeps[k].contact);
      EXPECT_NEAR(alone.sweeps[k].probability, among.sweeps[k].probability, 2e-3);
    }
    contacts += !alone.considered.empty();
  }
  EXPECT_GT(contacts, 5);
}

}  // namespace
}  // namespace sweep_guard_core
