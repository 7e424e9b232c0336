#include "sweep_guard/kinematics/kinematic_tree.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/floating_point.h"
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

}  // namespace
}  // namespace sweep_guard_core
