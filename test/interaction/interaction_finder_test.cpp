#include "sweep_guard/interaction/interaction_finder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "interaction_scenes.h"

namespace sweep_guard_core {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using namespace std::chrono_literals;

const std::string kFrame = "mesh";
const Vector3d kHalfTool(0.01, 0.02, 0.03);  // of a box as a tool [m]

std::shared_ptr<const Workpiece> workpieceOf(const TriangleMesh& mesh_M, const std::string& id = "liver",
                                             const std::string& frame = kFrame) {
  return std::make_shared<const Workpiece>(Workpiece{id, 1, Time(100s), SteadyTime(100s), frame, mesh_M});
}

PoseWithFrames poseAt(const Isometry3d& X_WT, Duration at = 0s, const Isometry3d& X_WM = Isometry3d::Identity()) {
  return {Time(100s) + at, SteadyTime(100s), X_WT, {{kFrame, X_WM}}};
}

class InteractionFinderTest : public testing::Test {
 protected:
  Interaction find(const PoseWithFrames& pose) {
    Interaction found;
    finder_.find(pose, workpieces_, options_, found);
    return found;
  }

  InteractionOptions options_;
  Workpieces workpieces_ = {workpieceOf(boxMesh({1.0, 1.0, 1.0}))};
  InteractionFinder finder_{std::vector<Tool>{Tool(ConvexShape::box(kHalfTool))}};
};

TEST_F(InteractionFinderTest, TheForceIsStiffnessTimesVolumeOutOfTheWorkpiece) {
  options_.law.stiffness = 2e6;
  const Interaction found = find(poseAt(placedAt(0.1, 0.2, 1.02)));
  ASSERT_EQ(found.objects.size(), 1U);
  const ObjectInteraction& object = found.objects[0];
  EXPECT_EQ(object.workpiece->id, "liver");
  EXPECT_TRUE(object.enclosed);
  EXPECT_NEAR(object.volume, 8e-6, 1e-15);
  EXPECT_NEAR(object.depth, 0.01, 1e-12);
  EXPECT_TRUE(object.wrench.force_T.isApprox(Vector3d(0.0, 0.0, 16.0), 1e-9));
  EXPECT_LT(object.wrench.torque_T.norm(), 1e-9);
  EXPECT_EQ(found.total.force_T, object.wrench.force_T);
}

TEST_F(InteractionFinderTest, TheTorqueIsThatOfTheForceAtTheCentroid) {
  const Interaction found = find(poseAt(placedAt(1.005, 0.3, 0.0)));
  const Vector3d centroid_T(-0.0075, 0.0, 0.0);
  ASSERT_EQ(found.objects.size(), 1U);
  EXPECT_TRUE(found.objects[0].centroid_T.isApprox(centroid_T, 1e-9));
  const Interaction beside = find(poseAt(placedAt(1.005, 0.99, 0.0)));
  const ObjectInteraction& object = beside.objects.at(0);
  EXPECT_LT((object.wrench.torque_T - object.centroid_T.cross(object.wrench.force_T)).norm(), 1e-12);
  EXPECT_GT(object.wrench.torque_T.norm(), 1e-3);
}

TEST_F(InteractionFinderTest, WithoutTouchThereIsNoObjectAndNoForce) {
  const Interaction found = find(poseAt(placedAt(0.0, 0.0, 1.031)));
  EXPECT_TRUE(found.objects.empty());
  EXPECT_TRUE(found.total.force_T.isZero(0.0));
}

TEST_F(InteractionFinderTest, AnObjectMayHaveItsOwnStiffness) {
  workpieces_.push_back(workpieceOf(boxMesh({1.0, 1.0, 1.0}), "bone"));
  options_.law.stiffness = 1e6;
  options_.stiffness_of["bone"] = 3e6;
  const Interaction found = find(poseAt(placedAt(0.1, 0.2, 1.02)));
  ASSERT_EQ(found.objects.size(), 2U);
  EXPECT_NEAR(found.objects[0].wrench.force_T.z(), 8.0, 1e-8);
  EXPECT_NEAR(found.objects[1].wrench.force_T.z(), 24.0, 1e-8);
  EXPECT_NEAR(found.total.force_T.z(), 32.0, 1e-8);
}

TEST_F(InteractionFinderTest, PiecesThatOverlapCountTwice) {
  const ConvexShape box = ConvexShape::box(kHalfTool);
  InteractionFinder twice({Tool(std::vector<ConvexPiece>{{"a", box}, {"b", box}})});
  Interaction found;
  const PoseWithFrames pose = poseAt(placedAt(0.1, 0.2, 1.02));
  twice.find(pose, workpieces_, options_, found);
  const Interaction once = find(pose);
  EXPECT_NEAR(found.objects.at(0).volume, 2.0 * once.objects.at(0).volume, 1e-18);
  EXPECT_LT((found.total.force_T - 2.0 * once.total.force_T).norm(), 1e-9);
  EXPECT_NEAR(found.objects[0].depth, once.objects[0].depth, 1e-15);
}

TEST_F(InteractionFinderTest, AWorkpieceWithoutFrameIsLeftOut) {
  workpieces_.push_back(workpieceOf(boxMesh({1.0, 1.0, 1.0}), "lost", "nowhere"));
  const Interaction found = find(poseAt(placedAt(0.1, 0.2, 1.02)));
  EXPECT_EQ(found.objects.size(), 1U);
  ASSERT_EQ(found.unplaced.size(), 1U);
  EXPECT_EQ(found.unplaced[0]->id, "lost");
}

TEST_F(InteractionFinderTest, BelowTheLeastAreaTheForceIsLess) {
  options_.law.least_area = 16e-4;  // twice that of the box
  EXPECT_NEAR(find(poseAt(placedAt(0.1, 0.2, 1.02))).total.force_T.z(), 4.0, 1e-8);
}

TEST_F(InteractionFinderTest, WithoutDampingTheForceIsTheSameOnTheWayInAndOut) {
  std::vector<Vector3d> in;
  for (int i = 0; i <= 20; ++i) in.push_back(find(poseAt(placedAt(0.1, 0.2, 1.03 - 0.001 * i), i * 1ms)).total.force_T);
  for (int i = 20; i >= 0; --i) {
    const Interaction out = find(poseAt(placedAt(0.1, 0.2, 1.03 - 0.001 * i), (40 - i) * 1ms));
    EXPECT_EQ(out.total.force_T, in[static_cast<size_t>(i)]);
  }
}

TEST_F(InteractionFinderTest, DampingAddsToTheForceOnTheWayInAndTakesFromItOnTheWayOut) {
  options_.law.damping = 2.0;
  find(poseAt(placedAt(0.1, 0.2, 1.021)));
  EXPECT_NEAR(find(poseAt(placedAt(0.1, 0.2, 1.02), 10ms)).total.force_T.z(), 8.0 * (1.0 + 2.0 * 0.1), 1e-6);
  find(poseAt(placedAt(0.1, 0.2, 1.019), 20ms));
  EXPECT_NEAR(find(poseAt(placedAt(0.1, 0.2, 1.02), 30ms)).total.force_T.z(), 8.0 * (1.0 - 2.0 * 0.1), 1e-6);
}

TEST_F(InteractionFinderTest, NeverPullsHoweverFastTheToolLeaves) {
  options_.law.damping = 2.0;
  find(poseAt(placedAt(0.1, 0.2, 1.0)));
  EXPECT_EQ(find(poseAt(placedAt(0.1, 0.2, 1.02), 10ms)).total.force_T.z(), 0.0);
}

TEST_F(InteractionFinderTest, DampsTheSpeedRelativeToTheFrameOfTheWorkpiece) {
  options_.law.damping = 2.0;
  find(poseAt(placedAt(0.1, 0.2, 1.02)));
  const Interaction together = find(poseAt(placedAt(0.1, 0.2, 1.021), 10ms, placedAt(0.0, 0.0, 0.001)));
  EXPECT_NEAR(together.total.force_T.z(), 8.0, 1e-6);
  const Interaction up = find(poseAt(placedAt(0.1, 0.2, 1.021), 20ms, placedAt(0.0, 0.0, 0.002)));
  EXPECT_NEAR(up.total.force_T.z(), 8.8 * (1.0 + 2.0 * 0.1), 1e-6);
}

TEST_F(InteractionFinderTest, AfterASilenceThereIsNoDamping) {
  options_.law.damping = 2.0;
  find(poseAt(placedAt(0.1, 0.2, 1.021)));
  EXPECT_NEAR(find(poseAt(placedAt(0.1, 0.2, 1.02), 200ms)).total.force_T.z(), 8.0, 1e-8);
  find(poseAt(placedAt(0.1, 0.2, 1.021), 210ms));
  finder_.reset();
  EXPECT_NEAR(find(poseAt(placedAt(0.1, 0.2, 1.02), 220ms)).total.force_T.z(), 8.0, 1e-8);
}

// Two jaws, each turned and placed against T.
class JawsTest : public InteractionFinderTest {
 protected:
  PoseWithFrames poseOf(const Isometry3d& X_WT, const Isometry3d& X_TB, Duration at = 0s) const {
    PoseWithFrames pose = poseAt(X_WT, at);
    pose.bodies = {{X_WT * X_TB}, {X_WT * X_TA_}};
    pose.state.positions = {0.0};
    return pose;
  }
  Interaction findOfJaws(const PoseWithFrames& pose) {
    Interaction found;
    jaws_.find(pose, workpieces_, options_, found);
    return found;
  }

  const Isometry3d X_TA_ = placedAt(0.2, -0.1, 0.3);
  InteractionFinder jaws_{{Tool(ConvexShape::box(kHalfTool)), Tool(ConvexShape::box(kHalfTool))}};
};

TEST_F(JawsTest, TheForceOfAJawIsThatOfARigidToolWithTheJawInPlace) {
  const Isometry3d X_WT = placedAt(0.1, 0.2, 0.95) * Eigen::AngleAxisd(0.4, Vector3d(1.0, 2.0, -1.0).normalized());
  const Isometry3d X_TB = placedAt(0.0, 0.0, 0.07) * Eigen::AngleAxisd(-0.7, Vector3d(2.0, 0.5, 1.0).normalized());
  const ConvexShape jaw = ConvexShape::box(kHalfTool);
  InteractionFinder rigid({Tool(std::vector<ConvexPiece>{{"b", jaw.placed(X_TB)}, {"a", jaw.placed(X_TA_)}})});
  Interaction expected;
  rigid.find(poseAt(X_WT), workpieces_, options_, expected);
  const Interaction found = findOfJaws(poseOf(X_WT, X_TB));
  ASSERT_EQ(found.objects.size(), 1U);
  ASSERT_EQ(expected.objects.size(), 1U);
  EXPECT_GT(expected.objects[0].volume, 1e-6);
  EXPECT_NEAR(found.objects[0].volume, expected.objects[0].volume, 1e-12);
  EXPECT_LT((found.objects[0].centroid_T - expected.objects[0].centroid_T).norm(), 1e-9);
  EXPECT_LT((found.objects[0].area_T - expected.objects[0].area_T).norm(), 1e-10);
  EXPECT_LT((found.total.force_T - expected.total.force_T).norm(), 1e-6);
  EXPECT_LT((found.total.torque_T - expected.total.torque_T).norm(), 1e-6);
}

TEST_F(JawsTest, AJawThatClosesIsDampedWhileTheToolRests) {
  options_.law.damping = 2.0;
  const Isometry3d X_WT = placedAt(0.1, 0.2, 0.5);
  findOfJaws(poseOf(X_WT, placedAt(0.0, 0.0, 0.521)));
  EXPECT_NEAR(findOfJaws(poseOf(X_WT, placedAt(0.0, 0.0, 0.52), 10ms)).total.force_T.z(), 8.0 * (1.0 + 2.0 * 0.1),
              1e-6);
}

// The energy [J] that the workpiece gives to a tool on a closed path, and all that it exchanges.
struct LoopEnergy {
  double made = 0.0;
  double exchanged = 0.0;
};

LoopEnergy energyOnLoop(const Isometry3d& X_MT, const Vector3d& u, const Vector3d& v, const Vector3d& turn) {
  const Workpieces workpieces = {workpieceOf(organ())};
  InteractionFinder finder({Tool(ConvexShape::cylinder(0.006, 0.08))});
  const InteractionOptions options;
  constexpr int kSteps = 400;
  const auto pose = [&](int i) {
    const double angle = 2.0 * M_PI * i / kSteps;
    Isometry3d X = X_MT;
    X.translation() += std::cos(angle) * u + std::sin(angle) * v;
    X.linear() = Eigen::AngleAxisd(std::sin(angle) * turn.norm(), turn.normalized()).toRotationMatrix() * X.linear();
    return X;
  };
  LoopEnergy energy;
  Interaction before;
  finder.find(poseAt(pose(0)), workpieces, options, before);
  for (int i = 1; i <= kSteps; ++i) {
    Interaction now;
    finder.find(poseAt(pose(i), i * 1ms), workpieces, options, now);
    const Isometry3d step_T = pose(i - 1).inverse() * pose(i);
    const Eigen::AngleAxisd turned(step_T.linear());
    const double work = 0.5 * (before.total.force_T + now.total.force_T).dot(step_T.translation()) +
                        0.5 * (before.total.torque_T + now.total.torque_T).dot(turned.angle() * turned.axis());
    energy.made += work;
    energy.exchanged += std::abs(work);
    before = now;
  }
  return energy;
}

// The law has no potential. What a loop makes is measured here and stated in doc/interaction.md.
TEST(InteractionEnergyTest, OfALoopIsASmallPartOfWhatIsExchanged) {
  Random random(/*seed=*/7);
  std::vector<double> shares;
  for (int i = 0; i < 100; ++i) {
    const Isometry3d X_MT = poseInOrgan(random);
    const LoopEnergy energy =
        energyOnLoop(X_MT, 0.005 * random.direction(), 0.005 * random.direction(), 0.1 * random.direction());
    if (energy.exchanged > 1e-6) shares.push_back(std::abs(energy.made) / energy.exchanged);
  }
  ASSERT_GT(shares.size(), 50U);
  std::sort(shares.begin(), shares.end());
  const double median = shares[shares.size() / 2];
  std::printf("share of the exchanged energy that %zu loops make: median %.3f, 90 %% %.3f, largest %.3f\n",
              shares.size(), median, shares[shares.size() * 9 / 10], shares.back());
  EXPECT_LT(median, 0.03);
  EXPECT_LT(shares[shares.size() * 9 / 10], 0.1);
}

}  // namespace
}  // namespace sweep_guard_core
