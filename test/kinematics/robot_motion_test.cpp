#include "sweep_guard/kinematics/robot_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinematics/random_robot.h"
#include "sweep_guard/geometry/motion.h"

namespace sweep_guard_core {
namespace {

constexpr double kRounding = 1e-12;

// The largest distance of a point of a body from where straight motion and slerp, or a straight line, would have it.
double sampledDeviation(const KinematicTree& tree, const std::vector<RobotBody>& bodies, const RobotMotion& motion,
                        size_t body, const Eigen::Vector3d& p_B, double from, double to) {
  const auto pose = [&](double fraction) {
    std::vector<Eigen::Isometry3d> X_WB;
    bodyPoses(tree, bodies, motion.at(fraction), X_WB);
    return X_WB[body];
  };
  const Motion straight{pose(from), pose(to)};
  const Eigen::Vector3d start = straight.X_MT_start * p_B;
  const Eigen::Vector3d end = straight.X_MT_end * p_B;
  double largest = 0.0;
  for (int i = 1; i < 8; ++i) {
    const double s = i / 8.0;
    const Eigen::Vector3d p = pose(from + s * (to - from)) * p_B;
    largest = std::max({largest, (p - straight.at(s) * p_B).norm(), (p - ((1.0 - s) * start + s * end)).norm()});
  }
  return largest;
}

std::vector<RobotBody> bodiesOf(const KinematicTree& tree, double radius) {
  std::vector<RobotBody> bodies{{TreeLink::kRoot, radius}};
  for (size_t link = 0; link < tree.links().size(); ++link) {
    if (tree.bodyOf(link) == link) bodies.push_back({link, radius});
  }
  return bodies;
}

TEST(RobotMotionTest, NoPointOfABodyDeviatesByMoreThanTheBound) {
  Random random(/*seed=*/1);
  for (int i = 0; i < 2000; ++i) {
    const KinematicTree tree = randomRobot(random, 2 + static_cast<size_t>(random.below(6)), random.chance(0.3));
    const std::vector<RobotBody> bodies = bodiesOf(tree, random.logUniform(1e-3, 0.3));
    const RobotState from = randomState(random, tree, 3.0);
    const RobotState to = randomStateNear(random, from, random.logUniform(1e-4, 2.0));
    const RobotMotion motion(tree, bodies, from, to);
    const size_t parts = 1 + static_cast<size_t>(random.below(4));
    const auto count = static_cast<double>(parts);
    const auto body = static_cast<size_t>(random.below(static_cast<int>(bodies.size())));
    const Eigen::Vector3d p_B = bodies[body].radius * random.direction();
    for (size_t part = 0; part < parts; ++part) {
      const double deviation = sampledDeviation(tree, bodies, motion, body, p_B, static_cast<double>(part) / count,
                                                static_cast<double>(part + 1) / count);
      ASSERT_LE(deviation, motion.deviationBound(body, parts) + kRounding) << "motion " << i << ", part " << part;
    }
  }
}

// Of a link at the end of an arm that moves for 5 ms at up to 1 rad/s a joint, against the worst of 64 of its points.
TEST(RobotMotionTest, IsBoundedWithinSixTimesItsDeviationInTheMedian) {
  Random random(/*seed=*/4);
  std::vector<double> ratios;
  for (int i = 0; i < 300; ++i) {
    const KinematicTree tree = randomRobot(random, 7, /*branches=*/false);
    const std::vector<RobotBody> bodies{{6, 0.1}};
    const RobotState from = randomState(random, tree, 3.0);
    RobotState to = randomStateNear(random, from, 5e-3);
    to.X_WR = from.X_WR;
    const RobotMotion motion(tree, bodies, from, to);
    EXPECT_LE(motion.deviationBound(0, 1), 5e-4);
    double worst = 0.0;
    for (int point = 0; point < 64; ++point) {
      const Eigen::Vector3d p_B = 0.1 * random.direction();
      worst = std::max(worst, sampledDeviation(tree, bodies, motion, 0, p_B, 0.0, 1.0));
    }
    ratios.push_back(motion.deviationBound(0, 1) / worst);
  }
  std::nth_element(ratios.begin(), ratios.begin() + 150, ratios.end());
  EXPECT_LE(ratios[150], 6.0);
}

// A long lever that one joint turns: the sagitta of its arc, which the bound exceeds by slerp's share alone.
TEST(RobotMotionTest, TheBoundOfOneTurningLinkIsTheArcOfItsFarthestPoint) {
  TreeLink lever;
  lever.type = JointType::kRevolute;
  TreeLink tip;
  tip.parent = 0;
  tip.X_PJ.translation().x() = 1.0;
  tip.type = JointType::kRevolute;
  tip.variable = 1;
  const KinematicTree tree({{"lever"}, {"tip"}}, {lever, tip});
  const std::vector<RobotBody> bodies{{1, 0.0}};
  const double angle = 0.1;
  const RobotMotion motion(tree, bodies, {Eigen::Isometry3d::Identity(), {0.0, 0.0}},
                           {Eigen::Isometry3d::Identity(), {angle, 0.0}});
  const double sagitta = 1.0 - std::cos(0.5 * angle);
  EXPECT_GE(motion.deviationBound(0, 1), sagitta);
  EXPECT_NEAR(motion.deviationBound(0, 1), sagitta, 1e-3 * sagitta);
}

TEST(RobotMotionTest, IsCutIntoAsManyPartsAsTheDeviationAsksFor) {
  Random random(/*seed=*/2);
  for (int i = 0; i < 100; ++i) {
    const KinematicTree tree = randomRobot(random, 5, /*branches=*/false);
    const std::vector<RobotBody> bodies = bodiesOf(tree, 0.1);
    const RobotState from = randomState(random, tree, 3.0);
    const RobotMotion motion(tree, bodies, from, randomStateNear(random, from, 0.5));
    const size_t parts = motion.partsFor(5e-4, 1000);
    const auto largest = [&](size_t count) {
      double bound = 0.0;
      for (size_t body = 0; body < bodies.size(); ++body) bound = std::max(bound, motion.deviationBound(body, count));
      return bound;
    };
    EXPECT_LE(largest(parts), 5e-4);
    if (parts > 1) {
      EXPECT_GT(largest(parts - 1), 5e-4);
    }
    EXPECT_EQ(motion.partsFor(5e-4, 2), std::min<size_t>(parts, 2));
  }
}

TEST(RobotMotionTest, ARobotAtRestDoesNotDeviate) {
  Random random(/*seed=*/3);
  const KinematicTree tree = randomRobot(random, 6, /*branches=*/true);
  const RobotState state = randomState(random, tree, 3.0);
  const RobotMotion motion(tree, bodiesOf(tree, 0.1), state, state);
  EXPECT_EQ(motion.deviationBound(1, 1), 0.0);
  EXPECT_EQ(motion.partsFor(5e-4, 100), 1U);
}

}  // namespace
}  // namespace sweep_guard_core
