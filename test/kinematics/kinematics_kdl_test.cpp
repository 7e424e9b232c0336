// Poses of links against those of KDL, which shares no code with ours. It does not know joints that mimic others: it gets
// their positions.
#include <gtest/gtest.h>

#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>

#include "kinematics/random_robot.h"

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

KDL::Frame poseByKdl(const KinematicTree& tree, size_t link, const std::vector<double>& positions) {
  std::vector<TreeLink> path;
  for (; link != TreeLink::kRoot; link = tree.links()[link].parent) path.insert(path.begin(), tree.links()[link]);
  KDL::Chain chain;
  for (const TreeLink& next : path) chain.addSegment(KDL::Segment(next.name, jointOf(next), toKdl(next.X_PJ)));
  KDL::JntArray array(chain.getNrOfJoints());
  unsigned int joint = 0;
  for (const TreeLink& next : path) {
    if (next.type != JointType::kFixed) array(joint++) = next.multiplier * positions[next.variable] + next.offset;
  }
  KDL::Frame F;
  EXPECT_GE(KDL::ChainFkSolverPos_recursive(chain).JntToCart(array, F), 0);
  return F;
}

TEST(KinematicsKdlTest, LinksAreWhereKdlPutsThem) {
  Random random(/*seed=*/1);
  for (int i = 0; i < 1000; ++i) {
    const KinematicTree tree = randomRobot(random, 2 + static_cast<size_t>(random.below(12)), random.chance(0.5));
    const RobotState state = randomState(random, tree, 3.0);
    std::vector<Eigen::Isometry3d> X_RL;
    tree.poses(state.positions, X_RL);
    for (size_t link = 0; link < X_RL.size(); ++link) {
      const KDL::Frame expected = poseByKdl(tree, link, state.positions);
      EXPECT_TRUE(KDL::Equal(expected, toKdl(X_RL[link]), 1e-12)) << "robot " << i << ", link " << link;
    }
  }
}

}  // namespace
}  // namespace sweep_guard_core
