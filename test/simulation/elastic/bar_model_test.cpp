#include "simulation/elastic/bar_model.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "lattice.h"
#include "refusal.h"

namespace sweep_guard_simulation {
namespace {

using Eigen::MatrixX3d;
using Eigen::RowVector3d;

BarModel::Options equilibrium(int iterations) {
  BarModel::Options options;
  options.step = std::numeric_limits<double>::infinity();
  options.iterations = iterations;
  return options;
}

MatrixX3d loadOn(const BarStructure& structure, std::uint32_t node, const RowVector3d& force) {
  MatrixX3d loads = MatrixX3d::Zero(structure.rest.rows(), 3);
  loads.row(node) = force;
  return loads;
}

// Two bays of a cantilever with a diagonal each, held by two nodes of a wall: as many bars as equations.
class TrussTest : public testing::Test {
 protected:
  TrussTest() : structure_(nodes()) {
    structure_.fixed[0] = structure_.fixed[1] = true;
    const std::vector<std::array<std::uint32_t, 2>> bars = {{0, 2}, {1, 3}, {1, 2}, {2, 3},
                                                            {2, 4}, {3, 5}, {3, 4}, {4, 5}};
    double stiffness = 1e3;
    for (const auto& bar : bars) structure_.bars.push_back({bar, stiffness += 100.0});
  }

  static MatrixX3d nodes() {
    MatrixX3d nodes(6, 3);
    nodes << 0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0, 2, 1, 0;
    return nodes;
  }

  RowVector3d displacement(std::uint32_t node, double load) const {
    BarModel model(structure_, equilibrium(3000));
    model.advance(loadOn(structure_, 4, RowVector3d(0.0, -load, 0.0)));
    return model.positions().row(node) - structure_.rest.row(node);
  }

  // The derivative at no load: differences over two loads, extrapolated, have errors of the fourth order.
  RowVector3d flexibility(std::uint32_t node) const {
    const auto difference = [&](double load) -> RowVector3d {
      return (displacement(node, load) - displacement(node, -load)) / (2.0 * load);
    };
    return (4.0 * difference(0.05) - difference(0.1)) / 3.0;
  }

  BarStructure structure_;
};

// Forces of the bars by a load of 1 N down at node 4, from the equilibrium of each node.
const std::array<double, 8> kForces = {-2.0, 1.0, std::sqrt(2.0), -1.0, -1.0, 0.0, std::sqrt(2.0), 0.0};

TEST_F(TrussTest, YieldsAtTheLoadAsUnitLoadsSay) {
  double expected = 0.0;
  for (size_t i = 0; i < kForces.size(); ++i) expected += kForces[i] * kForces[i] / structure_.bars[i].stiffness;
  EXPECT_NEAR(flexibility(4).y(), -expected, 1e-9 * expected);
}

// A load of 1 N along x at node 5 is carried by bars 1 and 5 alone.
TEST_F(TrussTest, YieldsElsewhereAsUnitLoadsSay) {
  const double expected = kForces[1] / structure_.bars[1].stiffness + kForces[5] / structure_.bars[5].stiffness;
  EXPECT_NEAR(flexibility(5).x(), expected, 1e-9 * expected);
}

// Flat triangle of two bars: its force at a height has a closed form, far from a linear one.
TEST(BarModelTest, TwoBarsYieldFarAsTheirAnglesSay) {
  MatrixX3d nodes(3, 3);
  nodes << -1, 0, 0, 1, 0, 0, 0, 0.5, 0;
  BarStructure structure(nodes);
  structure.fixed[0] = structure.fixed[1] = true;
  structure.bars = {{{0, 2}, 1000.0}, {{1, 2}, 1000.0}};
  const double height = 0.4;
  const double length = std::hypot(1.0, height);
  const double force = 2.0 * 1000.0 * (std::hypot(1.0, 0.5) - length) * height / length;
  BarModel model(structure, equilibrium(1000));
  model.advance(loadOn(structure, 2, {0.0, -force, 0.0}));
  EXPECT_NEAR(model.positions()(2, 1), height, 1e-9);
}

class ElasticCubeTest : public testing::Test {
 protected:
  static constexpr double kStiffness = 100.0;
  static constexpr double kStress = 1e-4;                     // [Pa]
  static constexpr double kYoungsModulus = 2.5 * kStiffness;  // [Pa]: lambda = mu = k / side
  static constexpr double kShearModulus = kStiffness;         // [Pa]

  ElasticCubeTest() : lattice_({4, 4, 4}, kStiffness) { lattice_.structure().fixed[lattice_.node({2, 2, 2})] = true; }

  // Pulls at both faces across an axis.
  void addStress(MatrixX3d& loads, int axis, const RowVector3d& stress) const {
    const MatrixX3d& rest = lattice_.structure().rest;
    for (Eigen::Index i = 0; i < rest.rows(); ++i) {
      const double side = rest(i, axis) == 0.0 ? -1.0 : rest(i, axis) == 4.0 ? 1.0 : 0.0;
      loads.row(i) += side * lattice_.share(i, axis) * stress;
    }
  }

  // Of the gradient of the displacement, if that is the same everywhere.
  Eigen::Matrix3d gradient(const MatrixX3d& loads) const {
    BarModel model(lattice_.structure(), equilibrium(400));
    model.advance(loads);
    const MatrixX3d& rest = lattice_.structure().rest;
    const MatrixX3d from_middle = rest.rowwise() - RowVector3d(2.0, 2.0, 2.0);
    const MatrixX3d moved = model.positions() - rest;
    Eigen::Matrix3d gradient =
        ((from_middle.transpose() * from_middle).inverse() * from_middle.transpose() * moved).transpose();
    EXPECT_LT((moved - from_middle * gradient.transpose()).norm(), 1e-5 * moved.norm());
    return gradient;
  }

  MatrixX3d noLoads() const { return MatrixX3d::Zero(lattice_.structure().rest.rows(), 3); }

  Lattice lattice_;
};

TEST_F(ElasticCubeTest, IsPulledLongerAndThinnerWithPoissonsRatioOfAQuarter) {
  MatrixX3d loads = noLoads();
  addStress(loads, 0, {kStress, 0.0, 0.0});
  const Eigen::Matrix3d strain = gradient(loads);
  const double expected = kStress / kYoungsModulus;
  EXPECT_NEAR(strain(0, 0), expected, 1e-5 * expected);
  EXPECT_NEAR(strain(1, 1), -0.25 * expected, 1e-5 * expected);
  EXPECT_NEAR(strain(2, 2), -0.25 * expected, 1e-5 * expected);
  EXPECT_NEAR(strain(0, 1), 0.0, 1e-5 * expected);
}

TEST_F(ElasticCubeTest, IsShearedByItsShearModulus) {
  MatrixX3d loads = noLoads();
  addStress(loads, 0, {0.0, kStress, 0.0});
  addStress(loads, 1, {kStress, 0.0, 0.0});
  const Eigen::Matrix3d strain = gradient(loads);
  const double expected = kStress / kShearModulus;
  EXPECT_NEAR(strain(0, 1) + strain(1, 0), expected, 1e-5 * expected);
  EXPECT_NEAR(strain(0, 0), 0.0, 1e-5 * expected);
}

class BlockTest : public testing::Test {
 protected:
  BlockTest() : lattice_({4, 1, 1}, 100.0) { lattice_.structure().masses.setConstant(0.1); }

  Lattice lattice_;
};

TEST_F(BlockTest, LosesEnergyInEveryStepWithoutLoads) {
  for (const std::uint32_t node : {lattice_.node({0, 0, 0}), lattice_.node({0, 1, 0}), lattice_.node({0, 0, 1})}) {
    lattice_.structure().fixed[node] = true;
  }
  BarModel model(lattice_.structure(), {});
  MatrixX3d velocities = MatrixX3d::Zero(lattice_.structure().rest.rows(), 3);
  for (Eigen::Index i = 0; i < velocities.rows(); ++i) {
    if (lattice_.structure().fixed[static_cast<size_t>(i)]) continue;
    velocities.row(i) << 0.3 * std::sin(7.0 * static_cast<double>(i)), 0.5,
        -0.2 * std::cos(3.0 * static_cast<double>(i));
  }
  model.setVelocities(velocities);
  const double start = model.kineticEnergy() + model.elasticEnergy();
  double before = start;
  for (int i = 0; i < 6000; ++i) {
    model.advance(MatrixX3d::Zero(velocities.rows(), 3));
    const double now = model.kineticEnergy() + model.elasticEnergy();
    ASSERT_LE(now, before) << "step " << i;
    before = now;
  }
  EXPECT_LT(before, 0.05 * start);
}

double largestStrain(const BarModel& model) {
  double largest = 0.0;
  for (const auto& [nodes, stiffness] : model.structure().bars) {
    const double rest = (model.structure().rest.row(nodes[0]) - model.structure().rest.row(nodes[1])).norm();
    const double length = (model.positions().row(nodes[0]) - model.positions().row(nodes[1])).norm();
    largest = std::max(largest, std::abs(length / rest - 1.0));
  }
  return largest;
}

// From the side of the wall that it is held at by one edge, a block falls by a right angle.
TEST_F(BlockTest, TurnsByARightAngleWithoutStrain) {
  lattice_.structure().fixed[lattice_.node({0, 0, 0})] = lattice_.structure().fixed[lattice_.node({0, 1, 0})] = true;
  BarModel model(lattice_.structure(), equilibrium(100000));
  MatrixX3d weight = MatrixX3d::Zero(lattice_.structure().rest.rows(), 3);
  weight.col(2).setConstant(-0.01);
  model.advance(weight);
  const RowVector3d edge(0.0, 0.5, 0.0);
  const RowVector3d middle = model.positions().colwise().mean() - edge;
  EXPECT_NEAR(middle.x(), 0.0, 0.01);
  EXPECT_NEAR(middle.z(), -std::hypot(2.0, 0.5), 0.01);
  EXPECT_LT(largestStrain(model), 0.01);
}

TEST_F(BlockTest, SpinsWithItsShape) {
  BarModel::Options options;
  options.iterations = 50;
  options.step = 0.01;
  BarModel model(lattice_.structure(), options);
  const MatrixX3d from_middle = lattice_.structure().rest.rowwise() - RowVector3d(2.0, 0.5, 0.5);
  MatrixX3d velocities(from_middle.rows(), 3);
  for (Eigen::Index i = 0; i < velocities.rows(); ++i) {
    velocities.row(i) = RowVector3d(0.0, 0.0, 1.0).cross(from_middle.row(i));
  }
  model.setVelocities(velocities);
  for (int i = 0; i < 300; ++i) model.advance(MatrixX3d::Zero(velocities.rows(), 3));
  const RowVector3d along = model.positions().row(lattice_.node({4, 0, 0})) - model.positions().row(0);
  const double turned = std::atan2(along.y(), along.x());
  EXPECT_GT(std::abs(turned), M_PI / 2.0);
  EXPECT_LT(largestStrain(model), 0.01);
}

class PressureTest : public testing::Test {
 protected:
  static constexpr double kGround = 200.0;  // [N/m]

  PressureTest() : structure_(MatrixX3d::Zero(1, 3)) { structure_.foundation.setConstant(kGround); }

  BarStructure structure_;
};

TEST_F(PressureTest, YieldsAsTwoSpringsInARow) {
  for (const double stiffness : {1.0, 200.0, 1e9}) {
    BarModel model(structure_, equilibrium(1));
    const double indentation = 0.01;  // of the pressing body
    model.advance(MatrixX3d::Zero(1, 3), {{0, {0.0, 0.0, 1.0}, stiffness * indentation, stiffness}});
    const double force = indentation / (1.0 / stiffness + 1.0 / kGround);
    EXPECT_NEAR(model.forces()[0], force, 1e-9 * force);
    EXPECT_NEAR(model.positions()(0, 2), -force / kGround, 1e-9);
  }
}

TEST_F(PressureTest, NeverPulls) {
  BarModel model(structure_, equilibrium(1));
  model.advance(MatrixX3d::Zero(1, 3), {{0, {0.0, 0.0, 1.0}, 1.0, 1e6}});
  const double pressed = model.positions()(0, 2);
  ASSERT_LT(pressed, 0.0);
  MatrixX3d loads = MatrixX3d::Zero(1, 3);
  loads(0, 2) = -10.0;
  model.advance(loads, {{0, {0.0, 0.0, 1.0}, 0.1, 1e6}});
  EXPECT_EQ(model.forces()[0], 0.0);
  EXPECT_NEAR(model.positions()(0, 2), -10.0 / kGround, 1e-12);
}

TEST_F(PressureTest, TwoThatOpposeEachOtherKeepTheNodeBetweenThem) {
  BarModel model(structure_, equilibrium(1));
  model.advance(MatrixX3d::Zero(1, 3), {{0, {0.0, 0.0, 1.0}, 30.0, 1e4}, {0, {0.0, 0.0, -1.0}, 10.0, 1e4}});
  const double displacement = -20.0 / (kGround + 2e4);
  EXPECT_NEAR(model.positions()(0, 2), displacement, 1e-9);
  EXPECT_NEAR(model.forces()[0], 30.0 + 1e4 * displacement, 1e-6);
  EXPECT_NEAR(model.forces()[1], 10.0 - 1e4 * displacement, 1e-6);
}

TEST(BarModelTest, RefusesWhatIsNotHeld) {
  BarStructure structure(MatrixX3d::Random(3, 3));
  structure.fixed[0] = true;
  structure.bars = {{{0, 1}, 1.0}};
  EXPECT_TRUE(has(refusal([&] { BarModel(structure, equilibrium(1)); }), "not held"));
  structure.bars.push_back({{1, 2}, 1.0});
  EXPECT_NO_THROW(BarModel(structure, equilibrium(1)));
}

TEST(BarModelTest, RefusesBarsAndOptionsOutOfRange) {
  BarStructure structure(MatrixX3d::Random(2, 3));
  structure.fixed[0] = true;
  structure.bars = {{{0, 1}, -1.0}};
  EXPECT_TRUE(has(refusal([&] { BarModel(structure, {}); }), "stiffness of a bar"));
  structure.bars = {{{0, 2}, 1.0}};
  EXPECT_TRUE(has(refusal([&] { BarModel(structure, {}); }), "no node 2"));
  structure.bars = {{{0, 1}, 1.0}};
  BarModel::Options options;
  options.step = 0.0;
  EXPECT_TRUE(has(refusal([&] { BarModel(structure, options); }), "time step"));
}

}  // namespace
}  // namespace sweep_guard_simulation
