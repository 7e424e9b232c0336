#include "simulation/elastic/pressing_piece.h"

#include <gtest/gtest.h>

#include <cmath>

#include "meshes.h"

namespace sweep_guard_simulation {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using sweep_guard_core::ConvexShape;
using sweep_guard_core::ForceLaw;
using sweep_guard_core::InterpenetrationFinder;
using sweep_guard_core::TriangleMesh;

constexpr double kStiffness = 1e6;  // [N/m^3]

ForceLaw law() {
  ForceLaw law;
  law.stiffness = kStiffness;
  return law;
}

Isometry3d downAt(double x, double y, double z, double tilt = 0.0) {
  return Eigen::Translation3d(x, y, z) * Eigen::AngleAxisd(tilt, Vector3d::UnitX()) *
         Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);
}

std::vector<Pressure> pressuresOn(const TriangleMesh& mesh, const ConvexShape& shape, const Isometry3d& X_MT) {
  std::vector<Pressure> pressures;
  PressingPiece(shape, law()).press(mesh, X_MT, pressures);
  return pressures;
}

double sumOfForces(const std::vector<Pressure>& pressures) {
  double sum = 0.0;
  for (const Pressure& pressure : pressures) sum += pressure.force;
  return sum;
}

Vector3d middleOf(const std::vector<Pressure>& pressures, const TriangleMesh& mesh) {
  Vector3d middle = Vector3d::Zero();
  for (const Pressure& pressure : pressures) middle += pressure.force * mesh.vertex(pressure.node);
  return middle / sumOfForces(pressures);
}

TEST(PressingPieceTest, TheSumIsTheInteractionForce) {
  const TriangleMesh mesh = cubeMesh(0.1, 12);
  for (const double tilt : {0.0, 0.3, 1.2}) {
    const ConvexShape shape = ConvexShape::cylinder(0.01, 0.1);
    const Isometry3d X_MT = downAt(0.003, -0.004, 0.045, tilt);
    const auto found = InterpenetrationFinder(shape).find(mesh, X_MT);
    const double force = interactionForce(found, Vector3d::Zero(), law()).force_T.norm();
    ASSERT_GT(force, 0.1);
    const std::vector<Pressure> pressures = pressuresOn(mesh, shape, X_MT);
    EXPECT_NEAR(sumOfForces(pressures), force, 1e-9 * force);
    for (const Pressure& pressure : pressures) {
      EXPECT_LT((pressure.outward - X_MT.linear() * found.area_T.normalized()).norm(), 1e-12);
    }
  }
}

// Also where the tool is smaller than a triangle, and no vertex is in it.
TEST(PressingPieceTest, PressesWhereTheToolIs) {
  for (const int cells : {1, 4, 40}) {
    const TriangleMesh mesh = cubeMesh(0.1, cells);
    const std::vector<Pressure> pressures =
        pressuresOn(mesh, ConvexShape::cylinder(0.01, 0.1), downAt(0.013, -0.021, 0.047));
    const Vector3d middle = middleOf(pressures, mesh);
    EXPECT_NEAR(middle.x(), 0.013, 0.001) << cells;
    EXPECT_NEAR(middle.y(), -0.021, 0.001) << cells;
    EXPECT_NEAR(middle.z(), 0.05, 1e-6) << cells;
  }
}

TEST(PressingPieceTest, TheStiffnessIsThatOfTheLayerUnderTheTool) {
  const std::vector<Pressure> pressures =
      pressuresOn(cubeMesh(0.1, 20), ConvexShape::cylinder(0.01, 0.1), downAt(0.0, 0.0, 0.047));
  double stiffness = 0.0;
  for (const Pressure& pressure : pressures) {
    stiffness += pressure.stiffness;
    EXPECT_NEAR(pressure.force / pressure.stiffness, 0.003, 1e-6);  // even under a flat tool
  }
  EXPECT_NEAR(stiffness, kStiffness * M_PI * 1e-4, 0.001 * stiffness);
}

// The deeper side takes more: the slope of the tool is that of the pressure.
TEST(PressingPieceTest, ThePressureGrowsWithTheDepth) {
  const TriangleMesh mesh = cubeMesh(0.1, 40);
  const ConvexShape ball = ConvexShape::sphere(0.02);
  const std::vector<Pressure> pressures = pressuresOn(mesh, ball, downAt(0.0, 0.0, 0.065));
  ASSERT_GT(pressures.size(), 20U);
  for (const Pressure& pressure : pressures) {
    const double distance = mesh.vertex(pressure.node).head<2>().norm();
    const double depth = std::sqrt(std::max(0.0, 4e-4 - distance * distance)) - 0.015;
    if (depth <= 0.001) continue;
    EXPECT_NEAR(pressure.force / pressure.stiffness, depth, 0.001);
  }
}

TEST(PressingPieceTest, WithoutContactThereIsNone) {
  EXPECT_TRUE(pressuresOn(cubeMesh(0.1, 4), ConvexShape::cylinder(0.01, 0.1), downAt(0.0, 0.0, 0.051)).empty());
}

}  // namespace
}  // namespace sweep_guard_simulation
