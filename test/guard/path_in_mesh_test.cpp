#include "guard/path_in_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "detection/reference_detector.h"
#include "geometry/round_tool.h"
#include "guard/contact_probability.h"
#include "guard/path_checker.h"
#include "scenes.h"
#include "sweep_guard/geometry/separation.h"

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
      const Eigen::Isometry3d X_MT = motion.end_M(segment).X_MT;
      const Matrix6d doubt = motion.end_M(segment).covariance_M.llt().matrixL();
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
  PathChecker checker(SweepOptions(), 5ms);
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
      EXPECT_NEAR(contactProbability(alone.sweeps[k].deviations), contactProbability(among.sweeps[k].deviations), 2e-3);
    }
    contacts += !alone.considered.empty();
  }
  EXPECT_GT(contacts, 5);
}

// Returns where the path between poses of 100 ms leads.
Eigen::Isometry3d between(const Swing& swing, Duration time) {
  const double step = std::floor(toSeconds(time) / 0.1 + 1e-9);
  const Motion motion{swing.at(0.1 * step), swing.at(0.1 * (step + 1.0))};
  const double share = toSeconds(time) / 0.1 - step;
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();
  X_WT.translation() = (1.0 - share) * motion.X_MT_start.translation() + share * motion.X_MT_end.translation();
  X_WT.linear() = Eigen::Quaterniond(motion.X_MT_start.linear())
                      .slerp(share, Eigen::Quaterniond(motion.X_MT_end.linear()))
                      .toRotationMatrix();
  return X_WT;
}

double distanceAt(const Eigen::Isometry3d& X_WT, const TriangleMesh& mesh_W) {
  const Eigen::Isometry3d X_TW = X_WT.inverse();
  const PointHull triangle_T(
      std::array<Eigen::Vector3d, 3>{X_TW * mesh_W.vertex(0), X_TW * mesh_W.vertex(1), X_TW * mesh_W.vertex(2)});
  return separation(kTool, triangle_T).gap;
}

// The volume of a sweep is larger than what the tool covers. In the reflex interval, its predictions are surer than that.
TEST(PathCheckerTest, WhatTheVolumeAloneMeetsInTheReflexIntervalIsBesideThePath) {
  Random random(6);
  ReferenceDetector detector;
  PathChecker checker(SweepOptions(), 5ms);
  int only_volume = 0;
  int met = 0;
  for (int i = 0; i < 300; ++i) {
    const Swing swing(random);
    const Eigen::Vector3d place = swing.at(0.15) * random.inBox({0.012, 0.012, 0.075});
    std::vector<Eigen::Vector3d> corners;
    for (int k = 0; k < 3; ++k) corners.emplace_back(place + random.inBox({0.004, 0.004, 0.004}));
    const TriangleMesh mesh_W(corners, {{0, 1, 2}});
    PredictedObject object;
    checker.check(detector,
                  {Tool(kTool),
                   swing.at(0.0),
                   swing.path,
                   /*reflex_sweeps=*/3,
                   Eigen::Isometry3d::Identity(),
                   std::make_shared<const Workpiece>(Workpiece{"one", 0, Time(), SteadyTime(), "table", mesh_W}),
                   {}},
                  object);
    for (size_t k = 0; object.sweeps[k].from < 300ms; ++k) {
      const Duration length = object.sweeps[k + 1].from - object.sweeps[k].from;
      double nearest = 1.0;
      for (int part = 0; part <= 8; ++part) {
        nearest = std::min(nearest, distanceAt(between(swing, object.sweeps[k].from + part * length / 8), mesh_W));
      }
      if (nearest <= 0.0) {
        EXPECT_LT(object.sweeps[k].deviations, 0.0);
        ++met;
      }
      if (object.sweeps[k].deviations == 0.0) ++only_volume;
    }
  }
  EXPECT_GT(only_volume, 20);
  EXPECT_GT(met, 20);
}

}  // namespace
}  // namespace sweep_guard_core
