#include "sweep_guard/kinematics/kinematic_tree.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/floating_point.h"
#include "kinematics/random_robot.h"
#include "refusal.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

TreeLink link(const std::string& name, size_t parent, JointType type, size_t variable = 0) {
  TreeLink link;
  link.name = name;
  link.parent = parent;
  link.X_PJ = Eigen::Translation3d(1.0, 0.0, 0.0) * Eigen::Isometry3d::Identity();
  link.type = type;
  link.variable = variable;
  return link;
}

// An arm that turns about z at its shoulder, with a slide along x, a plate that is fixed to it, and a finger that turns by
// twice the shoulder's angle plus a right angle.
KinematicTree arm() {
  TreeLink slide = link("slide", 0, JointType::kPrismatic, 1);
  slide.axis_J = Eigen::Vector3d::UnitX();
  TreeLink finger = link("finger", 2, JointType::kRevolute, 0);
  finger.multiplier = 2.0;
  finger.offset = M_PI / 2;
  return {
      {{"shoulder"}, {"slide", 0.1, 0.5}},
      {link("upper", TreeLink::kRoot, JointType::kRevolute, 0), slide, link("plate", 1, JointType::kFixed), finger}};
}

std::vector<Eigen::Isometry3d> posesOf(const KinematicTree& tree, const std::vector<double>& positions) {
  std::vector<Eigen::Isometry3d> X_RL;
  tree.poses(positions, X_RL);
  return X_RL;
}

TEST(KinematicTreeTest, LinksAreMovedByTheJointsAboveThem) {
  const std::vector<Eigen::Isometry3d> X_RL = posesOf(arm(), {M_PI / 2, 0.3});
  EXPECT_TRUE(X_RL[0].translation().isApprox(Eigen::Vector3d(1.0, 0.0, 0.0), 1e-14));
  EXPECT_TRUE(X_RL[1].translation().isApprox(Eigen::Vector3d(1.0, 1.3, 0.0), 1e-14));
  EXPECT_TRUE(X_RL[2].translation().isApprox(Eigen::Vector3d(1.0, 2.3, 0.0), 1e-14));
  EXPECT_TRUE(X_RL[3].translation().isApprox(Eigen::Vector3d(1.0, 3.3, 0.0), 1e-14));
}

TEST(KinematicTreeTest, AJointThatMimicsFollows) {
  const Eigen::Isometry3d X_RF = posesOf(arm(), {0.2, 0.1})[3];
  EXPECT_TRUE(X_RF.linear().isApprox(
      Eigen::AngleAxisd(0.2 + 0.4 + M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix(), 1e-14));
}

TEST(KinematicTreeTest, LinksThatNoJointMovesApartAreOneBody) {
  const KinematicTree tree({{"hinge"}},
                           {link("base", TreeLink::kRoot, JointType::kFixed), link("mount", 0, JointType::kFixed),
                            link("door", 1, JointType::kRevolute), link("handle", 2, JointType::kFixed)});
  EXPECT_EQ(tree.bodyOf(0), TreeLink::kRoot);
  EXPECT_EQ(tree.bodyOf(1), TreeLink::kRoot);
  EXPECT_EQ(tree.bodyOf(2), 2U);
  EXPECT_EQ(tree.bodyOf(3), 2U);
  EXPECT_EQ(arm().bodyOf(2), 1U);
}

TEST(KinematicTreeTest, UnlessSetAJointIsAsNearToZeroAsItsLimitsAllow) {
  EXPECT_EQ(arm().nearestToZero(), (std::vector<double>{0.0, 0.1}));
}

std::string refusalOf(const JointVariable& variable, const TreeLink& second) {
  return refusal([&] { KinematicTree({variable}, {link("first", TreeLink::kRoot, JointType::kFixed), second}); });
}

TEST(KinematicTreeTest, RefusesWhatIsNoTree) {
  const JointVariable free{"joint"};
  EXPECT_TRUE(has(refusalOf(free, link("second", 1, JointType::kFixed)), "'second': its parent must come before it"));
  EXPECT_TRUE(has(refusalOf(free, link("second", 0, JointType::kRevolute, 1)), "'second': its joint has no variable"));
  TreeLink no_axis = link("second", 0, JointType::kRevolute);
  no_axis.axis_J.setZero();
  EXPECT_TRUE(has(refusalOf(free, no_axis), "'second': the axis of its joint is not unit"));
  TreeLink nowhere = link("second", 0, JointType::kFixed);
  nowhere.X_PJ.translation().x() = std::nan("");
  EXPECT_TRUE(has(refusalOf(free, nowhere), "'second': the pose of its joint is not finite"));
  TreeLink endless = link("second", 0, JointType::kRevolute);
  endless.multiplier = kInfinity;
  EXPECT_TRUE(has(refusalOf(free, endless), "'second': how its joint follows is not finite"));
  EXPECT_TRUE(has(refusalOf({"joint", 1.0, 0.0}, link("second", 0, JointType::kFixed)),
                  "joint 'joint': its lower limit must not be above the upper one"));
}

TEST(KinematicTreeTest, KnowsTheJointsThatMimicOthers) {
  TreeLink left = link("left", TreeLink::kRoot, JointType::kPrismatic);
  left.joint = "left_finger";
  TreeLink right = link("right", TreeLink::kRoot, JointType::kPrismatic);
  right.joint = "right_finger";
  right.multiplier = -1.0;
  TreeLink plate = link("plate", TreeLink::kRoot, JointType::kFixed);
  plate.joint = "mount";
  const KinematicTree tree({{"left_finger"}}, {left, right, plate}, {{"crank", {0, 2.0, 0.1}}});
  ASSERT_EQ(tree.mimics().size(), 2U);
  EXPECT_DOUBLE_EQ(tree.mimics().at("right_finger").at({0.02}), -0.02);
  EXPECT_DOUBLE_EQ(tree.mimics().at("crank").at({0.02}), 0.14);
  const auto refused = [&](const MimicJoint& mimic) {
    return refusal([&] { KinematicTree({{"left_finger"}}, {left}, {{"crank", mimic}}); });
  };
  EXPECT_TRUE(has(refused({1, 1.0, 0.0}), "joint 'crank': it mimics no variable"));
  EXPECT_TRUE(has(refused({0, kInfinity, 0.0}), "joint 'crank': how it follows is not finite"));
  EXPECT_TRUE(has(refused({0, 1.0, std::nan("")}), "joint 'crank': how it follows is not finite"));
}

constexpr double kStep = 1e-5;  // [rad or m]; the error of a central difference is about its square

// Of the velocity of a link, by a central difference of its exact poses.
Eigen::Matrix<double, 6, 1> differenceQuotient(const KinematicTree& tree, std::vector<double> positions, size_t link,
                                               size_t variable) {
  std::vector<Eigen::Isometry3d> before, after;
  positions[variable] -= kStep;
  tree.poses(positions, before);
  positions[variable] += 2.0 * kStep;
  tree.poses(positions, after);
  const Eigen::AngleAxisd turn_R(after[link].linear() * before[link].linear().transpose());
  Eigen::Matrix<double, 6, 1> moved;
  moved << after[link].translation() - before[link].translation(), turn_R.angle() * turn_R.axis();
  return moved / (2.0 * kStep);
}

TEST(JacobianTest, IsTheDerivativeOfThePoses) {
  Random random(/*seed=*/3);
  Jacobian J_R;
  for (int i = 0; i < 200; ++i) {
    const KinematicTree tree = randomRobot(random, 2 + static_cast<size_t>(random.below(8)), /*branches=*/true);
    const std::vector<double> positions = randomState(random, tree, 3.0).positions;
    std::vector<Eigen::Isometry3d> X_RL;
    tree.poses(positions, X_RL);
    for (size_t link = 0; link < X_RL.size(); ++link) {
      geometricJacobian(tree, X_RL, link, J_R);
      ASSERT_EQ(J_R.cols(), static_cast<Eigen::Index>(positions.size()));
      for (size_t variable = 0; variable < positions.size(); ++variable) {
        const auto column = J_R.col(static_cast<Eigen::Index>(variable));
        EXPECT_LT((column - differenceQuotient(tree, positions, link, variable)).norm(), 1e-7)
            << "robot " << i << ", link " << link << ", variable " << variable;
      }
    }
  }
}

// A forearm of 2 m, turned by a quarter: its end is 1 m to the side of the shoulder's axis.
TEST(JacobianTest, AJointMovesWhatHangsOnItAboutItsAxis) {
  std::vector<TreeLink> links(3);
  for (TreeLink& link : links) link.name = "link";
  links[0].type = links[1].type = JointType::kRevolute;
  links[1].variable = 1;
  links[1].parent = 0;
  links[1].X_PJ.translation().x() = 1.0;
  links[2].parent = 1;
  links[2].X_PJ.translation().x() = 2.0;
  const KinematicTree tree({{"shoulder"}, {"elbow"}}, links);
  std::vector<Eigen::Isometry3d> X_RL;
  tree.poses({0.0, M_PI / 2.0}, X_RL);
  Jacobian J_R, expected(6, 2);
  geometricJacobian(tree, X_RL, 2, J_R);
  expected << -2, -2, 1, 0, 0, 0, 0, 0, 0, 0, 1, 1;
  EXPECT_TRUE(J_R.isApprox(expected, 1e-12)) << J_R;
  geometricJacobian(tree, X_RL, 0, J_R);
  EXPECT_EQ(J_R.col(1).norm(), 0.0) << "the elbow does not move the upper arm";
}

TEST(JacobianTest, NoJointMovesTheRoot) {
  Random random(/*seed=*/4);
  const KinematicTree tree = randomRobot(random, 5, /*branches=*/false);
  std::vector<Eigen::Isometry3d> X_RL;
  tree.poses(tree.nearestToZero(), X_RL);
  Jacobian J_R;
  geometricJacobian(tree, X_RL, TreeLink::kRoot, J_R);
  EXPECT_EQ(J_R.norm(), 0.0);
  EXPECT_EQ(J_R.cols(), static_cast<Eigen::Index>(tree.variables().size()));
}

}  // namespace
}  // namespace sweep_guard_core
