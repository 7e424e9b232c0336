#include "guard/contact_probability.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "guard/clearance_by_clipping.h"
#include "scenes.h"

namespace sweep_guard_core {
namespace {

double phi(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

Matrix6d covarianceOf(const Eigen::Matrix<double, 6, 1>& deviations) {
  return deviations.cwiseProduct(deviations).asDiagonal();
}

Matrix6d translating(double deviation) {
  return covarianceOf((Eigen::Matrix<double, 6, 1>() << deviation, deviation, deviation, 0, 0, 0).finished());
}

// The tool may turn about y by 0.1 rad.
const Matrix6d kTurning = covarianceOf(0.1 * Vector6d::Unit(4));

Motion resting(double lean) {
  Motion motion;
  motion.X_MT_start.linear() = Eigen::AngleAxisd(lean, Eigen::Vector3d::UnitY()).toRotationMatrix();
  motion.X_MT_end = motion.X_MT_start;
  return motion;
}

// A square of two triangles, parallel to y and z, a kilometre wide.
TriangleMesh wallAt(double x) {
  return TriangleMesh({{x, -512, -512}, {x, 512, -512}, {x, 512, 512}, {x, -512, 512}}, {{0, 1, 2}, {0, 2, 3}});
}

// A tool of 0.125 m along x, its tip at the origin, that goes on along x by 0.25 m: its box ends at x = 0.25.
const ConvexShape kNeedle = ConvexShape::cylinder(0.0, 0.125);
const ConvexShape kDrum = ConvexShape::cylinder(0.5, 0.125);
Motion goesOn() {
  Motion motion = resting(M_PI / 2.0);
  motion.X_MT_end = Eigen::Translation3d(0.25, 0.0, 0.0) * motion.X_MT_start;
  return motion;
}

double probabilityOf(const ConvexShape& tool, const Motion& motion, const Matrix6d& covariance_M,
                     const TriangleMesh& mesh_M) {
  const SweptVolume swept_M = sweptVolume(tool, motion, VolumeKind::kObbPlanes);
  const auto deviations = planeDeviations(tool, motion.X_MT_end, covariance_M, swept_M);
  const auto clearance = ClearanceMeter().measure(mesh_M, swept_M, deviations);
  EXPECT_EQ(ClearanceMeter().isNear(mesh_M, swept_M, deviations), clearance.has_value());
  return clearance ? contactProbability(clearance->deviations) : 0.0;
}

TEST(ContactProbabilityTest, IsTheGaussianIntegralAndZeroWhereItIsSmall) {
  EXPECT_DOUBLE_EQ(contactProbability(0.0), 0.5);
  EXPECT_NEAR(contactProbability(1.0), 0.158655253931457, 1e-12);
  EXPECT_NEAR(contactProbability(-1.0), 1.0 - 0.158655253931457, 1e-12);
  EXPECT_NEAR(contactProbability(3.09), 0.0010007824, 1e-9);
  EXPECT_EQ(contactProbability(3.0901), 0.0);
}

TEST(ContactProbabilityTest, IsNotMeasuredBeyondTheLargestClearanceThatMatters) {
  for (const double most : {0.0, 0.5, 2.0}) {
    ClearanceMeter meter(most);
    for (const double ratio : {-1.0, 0.25, 1.0, 3.0}) {
      const SweptVolume swept_M = sweptVolume(kNeedle, goesOn(), VolumeKind::kObbPlanes);
      const auto deviations = planeDeviations(kNeedle, goesOn().X_MT_end, translating(0.0625), swept_M);
      const TriangleMesh wall = wallAt(0.25 + ratio * 0.0625);
      const auto clearance = meter.measure(wall, swept_M, deviations);
      EXPECT_EQ(clearance.has_value(), ratio < most) << ratio << " of " << most;
      EXPECT_EQ(meter.isNear(wall, swept_M, deviations), ratio < most) << ratio << " of " << most;
      if (clearance) {
        EXPECT_NEAR(clearance->deviations, ratio, 2e-3);
      }
    }
  }
}

// The wall stands `distance` beyond where the tip is expected to be, across its path.
TEST(ContactProbabilityTest, OfAFlatWallIsExact) {
  for (const double deviation : {0.001, 0.0625, 1.0}) {
    for (const double ratio : {0.0, 0.25, 1.0, 2.0, 3.0}) {
      const TriangleMesh wall = wallAt(0.25 + ratio * deviation);
      EXPECT_NEAR(probabilityOf(kNeedle, goesOn(), translating(deviation), wall), phi(-ratio), 1e-6) << ratio;
      EXPECT_NEAR(probabilityOf(kDrum, goesOn(), translating(deviation), wall), phi(-ratio), 1e-6) << ratio;
    }
  }
}

// The path ends beyond the wall: it must err backwards by as much for the wall not to be met.
TEST(ContactProbabilityTest, OfAWallOnThePathIsMoreThanHalf) {
  for (const double ratio : {-0.25, -1.0, -2.0, -3.0}) {
    EXPECT_NEAR(probabilityOf(kDrum, goesOn(), translating(0.0625), wallAt(0.25 + ratio * 0.0625)), phi(-ratio), 1e-6);
    EXPECT_NEAR(probabilityOf(kNeedle, goesOn(), translating(0.0625), wallAt(0.25 + ratio * 0.0625)), phi(-ratio),
                1e-6);
  }
}

TEST(ContactProbabilityTest, OfAFarWallIsZero) {
  EXPECT_GT(probabilityOf(kNeedle, goesOn(), translating(0.0625), wallAt(0.25 + 3.08 * 0.0625)), 0.001);
  EXPECT_EQ(probabilityOf(kNeedle, goesOn(), translating(0.0625), wallAt(0.25 + 3.10 * 0.0625)), 0.0);
  EXPECT_EQ(probabilityOf(kNeedle, goesOn(), translating(0.0625), wallAt(100.0)), 0.0);
}

TEST(ContactProbabilityTest, OfAPathThatIsSureIsZeroOrOne) {
  EXPECT_EQ(probabilityOf(kNeedle, goesOn(), Matrix6d::Zero(), wallAt(0.2501)), 0.0);
  EXPECT_NEAR(probabilityOf(kDrum, goesOn(), Matrix6d::Zero(), wallAt(0.2499)), 1.0, 0.002);
}

// A drill that stands up, its tip at the origin and its far end 0.2 m below; a wall stands beside it. Its turn about y
// by 0.1 rad moves the far end by 0.2 * 0.1 = 0.02 m towards the wall, and the tip not at all.
TEST(ContactProbabilityTest, TurnsReachFartherWithALongerLever) {
  const ConvexShape drill = ConvexShape::cylinder(0.0, 0.2);
  const SweptVolume swept_M = sweptVolume(drill, Motion(), VolumeKind::kObb);
  const auto deviations = planeDeviations(drill, Eigen::Isometry3d::Identity(), kTurning, swept_M);
  const auto half_spaces_B = swept_M.halfSpaces_B();
  for (size_t i = 0; i < half_spaces_B.size(); ++i) {
    const Eigen::Vector3d n_M = swept_M.box.X_MB.linear() * half_spaces_B[i].normal();
    if (std::abs(n_M.z()) > 0.5) {
      EXPECT_NEAR(deviations[i], 1e-9, 1e-12);  // along its axis the tool does not move
    }
  }
  // With the plane's normal n and its point r, the lever is (r x n): a plane that faces x and down touches the far end.
  const Eigen::Vector3d n_M = Eigen::Vector3d(1.0, 0.0, -1.0).normalized();
  SweptVolume tilted_M = swept_M;
  tilted_M.clips_B.emplace_back(swept_M.box.X_MB.linear().transpose() * n_M, 1.0);
  EXPECT_NEAR(planeDeviations(drill, Eigen::Isometry3d::Identity(), kTurning, tilted_M).back(), 0.1 * 0.2 * n_M.x(),
              1e-12);
}

// A drill that stands, its tip free to turn about by 0.1 rad; a wall 10 mm beside its axis, 5 mm beside its side. The
// far end, 0.2 m away, is off by 20 mm: a quarter of a deviation. Whichever end leans towards the wall, and if none
// does.
TEST(ContactProbabilityTest, OfAWallAlongTheToolDoesNotDependOnHowItLeans) {
  const ConvexShape drill = ConvexShape::cylinder(0.005, 0.2);
  for (const double lean : {-1e-6, 0.0, 1e-6}) {
    EXPECT_NEAR(probabilityOf(drill, resting(lean), kTurning, wallAt(0.01)), 0.40, 0.01) << lean;
  }
}

// The far end lags 96 mm behind the tip, seen along the plane's normal: 5.5 deviations of its own.
TEST(ContactProbabilityTest, AnEndThatIsFarFromThePlaneDoesNotCount) {
  const ConvexShape drill = ConvexShape::cylinder(0.0, 0.2);
  const Motion leans = resting(0.5);
  SweptVolume swept_M = sweptVolume(drill, leans, VolumeKind::kObb);
  swept_M.clips_B.emplace_back(swept_M.box.X_MB.linear().transpose() * Eigen::Vector3d::UnitX(), 1.0);
  EXPECT_NEAR(planeDeviations(drill, leans.X_MT_end, kTurning, swept_M).back(), 1e-9, 1e-12);
}

// Any mesh, any motion: more doubt or less distance never makes contact beyond the path less probable.
TEST(ContactProbabilityTest, GrowsWithDoubtAndFallsWithDistance) {
  Random random(2);
  const TriangleMesh hull = wavyHull(12, 16, 0.0);
  int between = 0;
  for (int i = 0; i < 200; ++i) {
    const ConvexShape tool = ConvexShape::cylinder(0.005, 0.1);
    const Eigen::Vector3d away = random.direction();
    Motion motion{random.pose(0.25 * away), random.pose(0.25 * away)};
    motion.X_MT_end.linear() = motion.X_MT_start.linear();
    const double scale = random.logUniform(0.01, 0.1);
    const auto at = [&](double further, double doubt) {
      Motion moved = motion;
      moved.X_MT_start.pretranslate(further * away);
      moved.X_MT_end.pretranslate(further * away);
      return probabilityOf(tool, moved, translating(doubt * scale), hull);
    };
    const double here = at(0.0, 1.0);
    between += here > 0.01 && here < 0.49;
    if (here < 0.5) {
      EXPECT_GE(at(0.0, 1.5) + 1e-3, here);
      EXPECT_LE(at(0.0, 0.5) - 1e-3, here);
    }
  }
  EXPECT_GT(between, 50);
  const auto wall = [](double distance) {
    return probabilityOf(kNeedle, goesOn(), translating(0.05), wallAt(0.25 + distance));
  };
  for (double distance = -0.05; distance < 0.2; distance += 0.01)
    EXPECT_LE(wall(distance + 0.01), wall(distance) + 1e-3);
}

// A tool, its motion, and how uncertain the end of it is.
struct UncertainSweep {
  UncertainSweep(Random& random, int index)
      : i(index),
        tool(randomTool(random, 0.1)),
        motion(randomMotion(random, tool, random.uniform(0.05, 0.3) * random.direction(), 0.17)),
        covariance(covarianceOf(Eigen::Matrix<double, 6, 1>::Constant(random.logUniform(0.01, 0.2)))) {}

  PerHalfSpace deviationsOf(const SweptVolume& volume_M) const {
    return planeDeviations(tool, motion.X_MT_end, covariance, volume_M);
  }

  int i;  // among those of a seed
  ConvexShape tool;
  Motion motion;
  Matrix6d covariance;
  SweptVolume swept_M = sweptVolume(tool, motion, VolumeKind::kObbPlanes);
  PerHalfSpace deviations = deviationsOf(swept_M);
};

std::vector<UncertainSweep> uncertainSweeps(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<UncertainSweep> sweeps;
  for (int i = 0; i < count; ++i) sweeps.emplace_back(random, i);
  return sweeps;
}

// What the meter says is what clipping says: a little less and nothing is met, a little more and something is. Where
// the volume meets the mesh as it is, the tool must stay back from the triangle that is deepest in it.
TEST(ContactProbabilityTest, TheDeviationsAreThoseAtWhichTheVolumeMeetsTheMesh) {
  const TriangleMesh hull = wavyHull(12, 16, 0.5);
  ClearanceMeter meter;
  int outside = 0;
  int inside = 0;
  for (const UncertainSweep& sweep : uncertainSweeps(/*count=*/300, /*seed=*/3)) {
    const auto meetsAt = [&](double z) {
      return std::any_of(hull.triangles().begin(), hull.triangles().end(), [&](const Triangle& triangle) {
        return meets(hull, triangle, sweep.swept_M, z, sweep.deviations);
      });
    };
    const bool is_near = meter.isNear(hull, sweep.swept_M, sweep.deviations);
    const auto clearance = meter.measure(hull, sweep.swept_M, sweep.deviations);
    EXPECT_EQ(is_near, clearance.has_value()) << sweep.i;
    if (!clearance) {
      EXPECT_FALSE(meetsAt(kMaxDeviations - 1e-6));
      continue;
    }
    EXPECT_TRUE(meetsAt(std::max(0.0, clearance->deviations) + 1e-5)) << sweep.i;
    EXPECT_EQ(clearance->separated, meter.notSeparated(hull, sweep.swept_M).empty());
    if (clearance->deviations > 2e-3) {
      ++outside;
      EXPECT_FALSE(meetsAt(clearance->deviations - 2e-3)) << sweep.i;
      continue;
    }
    double deepest = 0.0;
    for (const Triangle& triangle : hull.triangles()) {
      if (!meets(hull, triangle, sweep.swept_M, 0.0, sweep.deviations)) continue;
      deepest = std::min(deepest, farthestBack(hull, triangle, sweep.swept_M, sweep.deviations));
    }
    inside += deepest < 0.0;
    EXPECT_NEAR(clearance->deviations, std::max(deepest, -kMaxDeviations), 2e-3) << sweep.i;
  }
  EXPECT_GT(outside, 50);
  EXPECT_GT(inside, 20);
}

// Up to fewer deviations, the meter says the same of what is nearer, and of what no plane separates; and it says nothing where
// the planes of the box alone, moved out as far, separate every triangle.
TEST(ContactProbabilityTest, IsTheSameUpToFewerDeviationsUnlessTheBoxAloneSeparatesAll) {
  const TriangleMesh hull = wavyHull(12, 16, 0.5);
  ClearanceMeter meter;
  int same = 0;
  int separated_by_box = 0;
  for (const UncertainSweep& sweep : uncertainSweeps(/*count=*/500, /*seed=*/4)) {
    const SweptVolume box_M = sweptVolume(sweep.tool, sweep.motion, VolumeKind::kObb);
    const auto of_box = sweep.deviationsOf(box_M);
    const auto all = meter.measure(hull, sweep.swept_M, sweep.deviations);
    for (const double at_most : {0.0, 0.3, 1.0, 2.5}) {
      const auto clearance = meter.measure(hull, sweep.swept_M, sweep.deviations, {}, at_most);
      if (meter.isSeparated(hull, box_M, of_box, at_most)) {
        ++separated_by_box;
        EXPECT_FALSE(clearance) << sweep.i;
      }
      if (clearance) {
        ++same;
        EXPECT_NEAR(clearance->deviations, all->deviations, 2e-3) << sweep.i;
        EXPECT_EQ(clearance->separated, all->separated) << sweep.i;
      } else if (all) {
        EXPECT_TRUE(all->separated) << sweep.i;
        EXPECT_GT(all->deviations, at_most - 2e-3) << sweep.i;
      }
    }
  }
  EXPECT_GT(same, 100);
  EXPECT_GT(separated_by_box, 100);
}

}  // namespace
}  // namespace sweep_guard_core
