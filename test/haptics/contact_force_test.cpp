#include "sweep_guard/haptics/contact_force.h"

#include <gtest/gtest.h>

#include <cmath>

#include "allocations.h"
#include "haptics/planes.h"
#include "motion/random_scenes.h"
#include "refusal.h"

namespace sweep_guard_core {
namespace {

using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

const ContactLaw kLaw{/*stiffness=*/1000.0};
const SeparatingPlane kFloor = planeAt(Vector3d::UnitZ(), Vector3d::Zero());
const SeparatingPlane kWall = planeAt(Vector3d::UnitX(), Vector3d::Zero());

ToolForce forceAt(const Vector3d& p_W, const std::vector<SeparatingPlane>& planes, const ContactLaw& law = kLaw,
                  const Twist& twist_W = {}) {
  ContactForceFinder finder;
  return finder.find(planeSet(planes), ballTool(0.005), {Isometry3d(Translation3d(p_W))}, twist_W, law);
}

TEST(ContactForceTest, AFloorPushesInProportionToTheDepth) {
  const ToolForce force = forceAt({0.3, 0.2, 0.003}, {kFloor});
  EXPECT_TRUE(force.force_W.isApprox(Vector3d(0.0, 0.0, 2.0), 1e-9)) << force.force_W.transpose();
  EXPECT_NEAR(force.depth, 0.002, 1e-12);
  EXPECT_TRUE(forceAt({0.0, 0.0, 0.0051}, {kFloor}).force_W.isZero(0.0));
}

TEST(ContactForceTest, TheForceBeginsAtTheDistance) {
  ContactLaw law = kLaw;
  law.distance = 0.004;
  EXPECT_NEAR(forceAt({0.0, 0.0, 0.006}, {kFloor}, law).force_W.z(), 3.0, 1e-9);
  EXPECT_EQ(forceAt({0.0, 0.0, 0.0091}, {kFloor}, law).force_W.z(), 0.0);
}

TEST(ContactForceTest, ParallelPlanesCountOnceAndThoseOfACornerBoth) {
  EXPECT_NEAR(forceAt({0.0, 0.0, 0.004}, {kFloor, kFloor, kFloor}).force_W.z(), 1.0, 1e-9);
  const ToolForce corner = forceAt({0.003, 0.0, 0.004}, {kFloor, kWall});
  EXPECT_TRUE(corner.force_W.isApprox(Vector3d(2.0, 0.0, 1.0), 1e-9)) << corner.force_W.transpose();
}

TEST(ContactForceTest, NoTranslationFreesAToolThatPiercesASheet) {
  const SeparatingPlane ceiling = planeAt(-Vector3d::UnitZ(), Vector3d(0.0, 0.0, 0.001));
  const ToolForce force = forceAt({0.0, 0.0, 0.0}, {kFloor, ceiling});
  EXPECT_TRUE(force.force_W.isZero(0.0));
  EXPECT_EQ(force.depth, 0.0);
}

// Opposite normals, with further planes in between: the search has to see that there is no way out.
TEST(ContactForceTest, NorFromASheetAmongOtherPlanes) {
  RandomScenes random(4);
  for (int i = 0; i < 500; ++i) {
    const Vector3d normal_W = random.direction();
    std::vector<SeparatingPlane> planes = {planeAt(normal_W, Vector3d::Zero()), planeAt(-normal_W, 0.001 * normal_W)};
    for (size_t j = random.count(5); j > 0; --j)
      planes.push_back(planeAt(random.direction(), 0.002 * random.direction()));
    EXPECT_TRUE(forceAt(Vector3d::Zero(), planes).force_W.isZero(0.0));
  }
}

TEST(ContactForceTest, TheTorqueIsThatOfTheForceAtTheNearestPoint) {
  ToolBalls tool = ballTool(0.001);
  tool.pieces[0].push_back({Vector3d(0.1, 0.0, -0.01), 0.002});
  ContactForceFinder finder;
  const Isometry3d X_WT(Translation3d(0.0, 0.0, 0.011));
  const ToolForce force = finder.find(planeSet({kFloor}), tool, {X_WT}, {}, kLaw);
  EXPECT_NEAR(force.force_W.z(), 1.0, 1e-9);
  EXPECT_TRUE(force.torque_W.isApprox(Vector3d(0.1, 0.0, -0.012).cross(force.force_W), 1e-9));
}

// A forearm of 0.2 m behind an elbow that turns about y, 0.3 m before the tool frame.
TEST(ContactForceTest, AToolThatJointsMoveFeelsAsOneThatIsFixedWhereTheyPutIt) {
  TreeLink fore;
  fore.name = "fore";
  fore.joint = "elbow";
  fore.X_PJ = Translation3d(0.3, 0.0, 0.0);
  fore.type = JointType::kRevolute;
  fore.axis_J = Vector3d::UnitY();
  MovingTool moving(std::make_shared<const KinematicTree>(std::vector<JointVariable>{{"elbow"}}, std::vector{fore}));
  ToolBalls tool = ballTool(0.002);
  tool.pieces[0][0].center_T = Vector3d(0.2, 0.0, 0.0);
  tool.frames = {"fore"};
  const Isometry3d X_WT(Translation3d(0.0, 0.0, 0.1));
  moving.place({X_WT, {0.53}}, tool, Eigen::VectorXd::Zero(1));
  ContactForceFinder finder;
  const ToolForce bent = finder.find(planeSet({kFloor}), tool, {X_WT, &moving}, {}, kLaw);

  ToolBalls fixed = ballTool(0.002);
  fixed.pieces[0][0].center_T = Vector3d(0.3 + 0.2 * std::cos(0.53), 0.0, -0.2 * std::sin(0.53));
  const ToolForce as_fixed = finder.find(planeSet({kFloor}), fixed, {X_WT}, {}, kLaw);
  EXPECT_GT(as_fixed.force_W.z(), 0.5);
  EXPECT_TRUE(bent.force_W.isApprox(as_fixed.force_W, 1e-9));
  EXPECT_TRUE(bent.torque_W.isApprox(as_fixed.torque_W, 1e-9)) << bent.torque_W.transpose();
}

TEST(ContactForceTest, DampingResistsTheWayInAndNeverPulls) {
  ContactLaw law = kLaw;
  law.damping = 10.0;
  const auto normalForce = [&](double speed) {
    return forceAt({0.0, 0.0, 0.004}, {kFloor}, law, {Vector3d(0.7, 0.0, speed), Vector3d::Zero()}).force_W.z();
  };
  EXPECT_NEAR(normalForce(-0.05), 1.5, 1e-9);
  EXPECT_NEAR(normalForce(0.05), 0.5, 1e-9);
  EXPECT_EQ(normalForce(0.2), 0.0);
}

// Along a closed path the sum of force * way vanishes with the step: planes at rest have a potential.
TEST(ContactForceTest, PlanesAtRestReturnWhatTheyTook) {
  RandomScenes random(5);
  double largest_way = 0.0;
  for (int loop = 0; loop < 20; ++loop) {
    std::vector<SeparatingPlane> planes;
    for (int i = 0; i < 3; ++i) {
      const Vector3d normal_W = (Vector3d::UnitZ() + 0.8 * random.direction()).normalized();
      planes.push_back(planeAt(normal_W, 0.002 * random.direction()));
    }
    const Vector3d radius_W = 0.004 * random.direction();
    const Vector3d other_W = 0.004 * random.direction();
    constexpr int kSteps = 4000;
    double energy = 0.0;
    double exchanged = 0.0;
    const auto at = [&](double angle) -> Vector3d { return std::cos(angle) * radius_W + std::sin(angle) * other_W; };
    for (int i = 0; i < kSteps; ++i) {
      const double angle = 2.0 * M_PI * i / kSteps;
      const double next = 2.0 * M_PI * (i + 1) / kSteps;
      const double work = forceAt(at((angle + next) / 2), planes).force_W.dot(at(next) - at(angle));
      energy += work;
      exchanged += std::abs(work);
    }
    EXPECT_LT(std::abs(energy), 1e-5 * exchanged + 1e-12);
    largest_way = std::max(largest_way, exchanged);
  }
  EXPECT_GT(largest_way, 1e-3) << "the tool meets the planes";
}

TEST(ContactForceTest, ThePredictiveCueGrowsAsTheTimeToAPlaneShrinks) {
  ContactLaw law = kLaw;
  law.cue_damping = 2.0;
  law.cue_time = 0.5;
  const auto cueAt = [&](double gap, double speed) {
    return forceAt({0.0, 0.0, 0.005 + gap}, {kFloor}, law, {Vector3d(0.0, 0.0, -speed), Vector3d::Zero()}).force_W.z();
  };
  EXPECT_NEAR(cueAt(0.02, 0.1), 2.0 * 0.1 * (1.0 - 0.2 / 0.5), 1e-9);
  EXPECT_EQ(cueAt(0.06, 0.1), 0.0);
  EXPECT_EQ(cueAt(0.02, -0.1), 0.0) << "it goes away";
  law.cue_damping = 0.0;
  EXPECT_EQ(cueAt(0.02, 0.1), 0.0) << "off";
}

TEST(ContactForceTest, AllocatesNothing) {
  ContactForceFinder finder;
  std::vector<SeparatingPlane> planes;
  RandomScenes random(9);
  for (int i = 0; i < 64; ++i)
    planes.push_back(planeAt(Vector3d::UnitZ() + 0.5 * random.direction(), Vector3d::Zero()));
  const PlaneSet set = planeSet(planes);
  const ToolBalls tool = ballTool(0.01);
  const Allocations allocations;
  EXPECT_GT(finder.find(set, tool, {Isometry3d::Identity()}, {}, kLaw).force_W.z(), 0.0);
  EXPECT_EQ(allocations.count(), 0U) << allocations.stacks();
}

TEST(ContactForceTest, ANegativeOrNaNValueIsRefused) {
  ContactLaw law;
  law.stiffness = -1.0;
  EXPECT_TRUE(has(refusal([&] { requireUsable(law); }), "stiffness"));
  law = {};
  law.damping = std::nan("");
  EXPECT_TRUE(has(refusal([&] { requireUsable(law); }), "damping"));
}

}  // namespace
}  // namespace sweep_guard_core
