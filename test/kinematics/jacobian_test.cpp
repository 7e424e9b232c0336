#include "sweep_guard/kinematics/kinematic_tree.h"

#include <gtest/gtest.h>

#include "kinematics/random_robot.h"

namespace sweep_guard_core {
namespace {

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
