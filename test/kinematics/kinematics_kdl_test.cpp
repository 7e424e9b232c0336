// Poses and Jacobians of links against those of KDL, which shares no code with ours. It does not know joints that mimic others: it gets
// their positions.
#include <gtest/gtest.h>

#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "kinematics/random_robot.h"
#include "sweep_guard/kinematics/kinematic_tree.h"

namespace sweep_guard_core {
namespace {

KDL::Frame toKdl(const Eigen::Isometry3d& X) {
  const Eigen::Matrix3d& R = X.linear();
  const Eigen::Vector3d p = X.translation();
  return {KDL::Rotation(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)),
          KDL::Vector(p.x(), p.y(), p.z())};
}

KDL::Joint jointOf(const TreeLink& link) {
  const KDL::Frame F = toKdl(link.X_PJ);
  const KDL::Vector axis = F.M * KDL::Vector(link.axis_J.x(), link.axis_J.y(), link.axis_J.z());
  if (link.type == JointType::kFixed) return KDL::Joint(link.name, KDL::Joint::None);
  return {link.name, F.p, axis, link.type == JointType::kRevolute ? KDL::Joint::RotAxis : KDL::Joint::TransAxis};
}

// The links from the root to one of them, the joints that move, and their positions.
struct ChainByKdl {
  ChainByKdl(const KinematicTree& tree, size_t link, const std::vector<double>& positions) {
    std::vector<TreeLink> path;
    for (; link != TreeLink::kRoot; link = tree.links()[link].parent) path.insert(path.begin(), tree.links()[link]);
    for (const TreeLink& next : path) {
      chain.addSegment(KDL::Segment(next.name, jointOf(next), toKdl(next.X_PJ)));
      if (next.type != JointType::kFixed) joints.push_back(next);
    }
    array.resize(chain.getNrOfJoints());
    for (unsigned int i = 0; i < joints.size(); ++i) array(i) = joints[i].at(positions);
  }

  KDL::Chain chain;
  std::vector<TreeLink> joints;
  KDL::JntArray array;
};

KDL::Frame poseByKdl(const KinematicTree& tree, size_t link, const std::vector<double>& positions) {
  const ChainByKdl of(tree, link, positions);
  KDL::Frame F;
  EXPECT_GE(KDL::ChainFkSolverPos_recursive(of.chain).JntToCart(of.array, F), 0);
  return F;
}

Jacobian jacobianByKdl(const KinematicTree& tree, size_t link, const std::vector<double>& positions) {
  const ChainByKdl of(tree, link, positions);
  KDL::Jacobian of_joints(of.chain.getNrOfJoints());
  EXPECT_GE(KDL::ChainJntToJacSolver(of.chain).JntToJac(of.array, of_joints), 0);
  Jacobian J_R = Jacobian::Zero(6, static_cast<Eigen::Index>(positions.size()));
  for (size_t i = 0; i < of.joints.size(); ++i) {
    J_R.col(static_cast<Eigen::Index>(of.joints[i].variable)) +=
        of.joints[i].multiplier * of_joints.data.col(static_cast<Eigen::Index>(i));
  }
  return J_R;
}

struct PlacedRobot {
  KinematicTree tree;
  std::vector<double> positions;
  std::vector<Eigen::Isometry3d> X_RL;
};

/// Calls check(robot, link) for each link of 1000 robots.
template <typename Check>
void forEachLink(std::uint64_t seed, const Check& check) {
  Random random(seed);
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE("robot " + std::to_string(i));
    PlacedRobot robot{randomRobot(random, 2 + static_cast<size_t>(random.below(12)), random.chance(0.5)), {}, {}};
    robot.positions = randomState(random, robot.tree, 3.0).positions;
    robot.tree.poses(robot.positions, robot.X_RL);
    for (size_t link = 0; link < robot.X_RL.size(); ++link) check(robot, link);
  }
}

TEST(KinematicsKdlTest, LinksAreWhereKdlPutsThem) {
  forEachLink(/*seed=*/1, [](const PlacedRobot& robot, size_t link) {
    const KDL::Frame expected = poseByKdl(robot.tree, link, robot.positions);
    EXPECT_TRUE(KDL::Equal(expected, toKdl(robot.X_RL[link]), 1e-12)) << "link " << link;
  });
}

TEST(KinematicsKdlTest, JacobiansAreThoseOfKdl) {
  Jacobian J_R;
  forEachLink(/*seed=*/2, [&](const PlacedRobot& robot, size_t link) {
    geometricJacobian(robot.tree, robot.X_RL, link, J_R);
    EXPECT_LT((J_R - jacobianByKdl(robot.tree, link, robot.positions)).norm(), 1e-12) << "link " << link;
  });
}

}  // namespace
}  // namespace sweep_guard_core
