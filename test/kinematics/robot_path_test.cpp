#include "sweep_guard/kinematics/robot_path.h"

#include <gtest/gtest.h>

#include "kinematics/random_robot.h"

namespace sweep_guard_core {
namespace {

ConvexPiece ball(const std::string& link, double x) {
  return {link, ConvexShape::sphere(0.01).placed(Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.0)))};
}

TreeLink linkOf(const std::string& name, size_t parent, JointType type) {
  TreeLink link;
  link.name = name;
  link.parent = parent;
  link.type = type;
  if (parent != TreeLink::kRoot) link.X_PJ.translation().x() = 1.0;
  return link;
}

// A door that turns on a wall, with a handle.
Robot door() {
  return robotOf({{{"hinge"}},
                  {linkOf("wall", TreeLink::kRoot, JointType::kFixed), linkOf("door", 0, JointType::kRevolute),
                   linkOf("handle", 1, JointType::kFixed)}},
                 {{0, {ball("wall", 0.0)}}, {1, {ball("door", 0.5)}}, {2, {ball("handle", 0.0)}}});
}

TEST(RobotOfTest, PutsLinksThatNoJointMovesApartIntoOneBody) {
  const Robot robot = door();
  ASSERT_EQ(robot.bodies.size(), 2U);
  EXPECT_EQ(robot.bodies[0].link, 1U);
  EXPECT_EQ(robot.bodies[1].link, TreeLink::kRoot);
  ASSERT_EQ(robot.tools[0].pieces().size(), 2U);
  EXPECT_EQ(robot.tools[0].pieces()[1].link, "handle");
  EXPECT_NEAR(robot.tools[0].bounds_T().max().x(), 1.01, 1e-12);
  EXPECT_NEAR(robot.bodies[0].radius, 1.01, 1e-9);
}

TEST(RobotPathTest, JoinsTheStatesEndToEnd) {
  const Robot robot = door();
  const RobotState shut{Eigen::Isometry3d::Identity(), {0.0}};
  const RobotState open{Eigen::Isometry3d::Identity(), {1.0}};
  const RobotPath path = robotPath(robot, {shut, open, shut}, 5e-4);
  ASSERT_EQ(path.places.size() + 1, path.bodies[0].X_WB.size());
  size_t segment = 0;
  double reached = 0.0;
  for (const RobotPath::Place& place : path.places) {
    if (place.segment != segment) {
      EXPECT_EQ(reached, 1.0);
      EXPECT_EQ(place.segment, ++segment);
      reached = 0.0;
    }
    EXPECT_EQ(place.from, reached);
    reached = place.to;
  }
  EXPECT_EQ(segment, 1U);
  EXPECT_EQ(reached, 1.0);
  EXPECT_LE(path.deviationBound(), 5e-4);
  EXPECT_GT(path.deviationBound(), 0.0);
  EXPECT_EQ(path.bodies[1].deviation_bounds.front(), 0.0) << "the wall rests";
}

TEST(RobotPathTest, ASingleStateHasNoSweep) {
  const RobotPath path = robotPath(door(), {{Eigen::Isometry3d::Identity(), {0.5}}}, 5e-4);
  EXPECT_TRUE(path.places.empty());
  EXPECT_EQ(path.bodies[0].X_WB.size(), 1U);
  EXPECT_EQ(path.deviationBound(), 0.0);
}

TEST(RobotPathTest, APathOfManyLongSegmentsIsBoundedAsAWhole) {
  std::vector<RobotState> states(1024, {Eigen::Isometry3d::Identity(), {0.0}});
  for (size_t i = 1; i < states.size(); i += 2) states[i].positions[0] = 1000.0;
  EXPECT_EQ(robotPath(door(), states, 5e-4).places.size(), 1023U * 8U);
}

TEST(RobotPathTest, ALongSegmentHasAThousandSweepsThatSayHowFarTheyDeviate) {
  const RobotPath path =
      robotPath(door(), {{Eigen::Isometry3d::Identity(), {0.0}}, {Eigen::Isometry3d::Identity(), {1000.0}}}, 5e-4);
  EXPECT_EQ(path.places.size(), 1000U);
  EXPECT_GT(path.deviationBound(), 0.1);
}

}  // namespace
}  // namespace sweep_guard_core
