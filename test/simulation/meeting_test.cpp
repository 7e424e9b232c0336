#include "simulation/joint_motion.h"

#include <gtest/gtest.h>

namespace sweep_guard_simulation {
namespace {

using Eigen::Vector3d;
using sweep_guard_core::ConvexPiece;
using sweep_guard_core::ConvexShape;
using sweep_guard_core::KinematicTree;
using sweep_guard_core::TreeLink;
using sweep_guard_core::TriangleMesh;

// A slide along x that carries a slide down along z, each with a ball of 0.1 m; the tool frame is 1 m above the root.
sweep_guard_ros::RobotModel twoSlides() {
  std::vector<sweep_guard_core::JointVariable> variables(2);
  std::vector<TreeLink> links(2);
  for (size_t i = 0; i < 2; ++i) {
    variables[i].name = "slide" + std::to_string(i);
    links[i].type = sweep_guard_core::JointType::kPrismatic;
    links[i].variable = i;
  }
  links[0].axis_J = Vector3d::UnitX();
  links[1].axis_J = -Vector3d::UnitZ();
  links[1].parent = 0;
  const std::vector<ConvexPiece> ball = {{"ball", ConvexShape::sphere(0.1)}};
  const Eigen::Isometry3d X_TR(Eigen::Translation3d(0.0, 0.0, -1.0));
  return {robotOf(KinematicTree(variables, links), {{0, ball}, {1, ball}}), {0.0, 0.0}, X_TR};
}

std::vector<StampedPositions> motionOf(const std::vector<std::vector<double>>& positions) {
  std::vector<StampedPositions> motion;
  for (const auto& at : positions) motion.push_back({sweep_guard_core::Time(), at});
  return motion;
}

TEST(MeetingTest, IsTheFrontOfTheLastBodyInTheMiddleOfItsPath) {
  const Meeting meeting = halfway(twoSlides(), motionOf({{0, 0}, {0, 0.4}, {0, 0.5}, {0, 1.0}}));
  EXPECT_LT((meeting.direction_T + Vector3d::UnitZ()).norm(), 1e-9);
  EXPECT_LT((meeting.p_T - Vector3d(0.0, 0.0, -1.6)).norm(), 1e-3);
}

TEST(MeetingTest, TheMiddleIsThatOfTheLengthOfThePath) {
  const Meeting meeting = halfway(twoSlides(), motionOf({{0, 0}, {0.1, 0}, {0.2, 0}, {0.9, 0}, {1.0, 0}}));
  EXPECT_LT((meeting.direction_T - Vector3d::UnitX()).norm(), 1e-9);
  EXPECT_LT((meeting.p_T - Vector3d(1.0, 0.0, -1.0)).norm(), 1e-3);
}

TEST(MeetingTest, IsBelowAToolThatIsWhereItBegan) {
  EXPECT_EQ(halfway(twoSlides(), motionOf({{0, 0}})).direction_T, -Vector3d::UnitZ());
}

TEST(MeetingTest, TheWorkpieceIsInFrontOfTheTool) {
  const TriangleMesh mesh_W({{1, 0, 0}, {2, 1, 0}, {3, 0, 1}}, {{0, 1, 2}});
  const Meeting meeting{{0.5, 0.25, 0}, Vector3d::UnitX()};
  const Vector3d p_WT = placeToMeet(meeting, mesh_W, /*depth=*/0.125);
  EXPECT_LT((p_WT + meeting.p_T - Vector3d(1.125, 0.0, 0.0)).norm(), 1e-6);
}

}  // namespace
}  // namespace sweep_guard_simulation
