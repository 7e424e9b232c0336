// Reads the force of a running guard.
#include <gtest/gtest.h>
#include <sweep_guard/Interaction.h>

#include <cmath>

#include "cube.h"
#include "node_fixture.h"
#include "proximity_listener.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Interaction;

constexpr double kCrossSection = M_PI * 1e-4;  // of the tool [m^2]; its tip points down

class InteractionTopicTest : public NodeTest {
 protected:
  // Poses that are swept before the guard knows its subscriber have no force.
  Interaction forceAt(const Eigen::Vector3d& tip) {
    while (true) {
      moveTo(tip);
      const ros::Time stamp = probe().time();
      if (forces_.all().empty()) continue;
      return forces_.awaitNewest([&](const Interaction& interaction) { return interaction.header.stamp >= stamp; });
    }
  }

  TopicListener<Interaction> forces_{"interaction"};
};

TEST_F(InteractionTopicTest, IsTheForceOfASquareOnTheTip) {
  placeSquare("square", {0.0, 0.0, 0.0});
  const Interaction interaction = forceAt({0.01, 0.02, -0.01});
  EXPECT_EQ(interaction.header.frame_id, "tool");
  EXPECT_TRUE(interaction.valid);
  EXPECT_EQ(interaction.valid_until, interaction.header.stamp + ros::Duration(1.0));
  ASSERT_EQ(interaction.objects.size(), 1U);
  const auto& object = interaction.objects[0];
  EXPECT_EQ(object.mesh_id, "square");
  EXPECT_EQ(object.revision, 1U);
  EXPECT_FALSE(object.enclosed);
  EXPECT_NEAR(object.volume, 0.01 * kCrossSection, 1e-12);
  EXPECT_NEAR(object.centroid.z, -0.005, 1e-6);
  EXPECT_NEAR(object.area.z, -kCrossSection, 1e-9);
  EXPECT_NEAR(object.depth, 0.01, 1e-6);
  EXPECT_NEAR(object.wrench.force.z, -1e6 * 0.01 * kCrossSection, 1e-5);
  EXPECT_NEAR(object.wrench.force.x, 0.0, 1e-5);
  EXPECT_NEAR(object.wrench.torque.x, 0.0, 1e-6);
  EXPECT_EQ(interaction.wrench.force.z, object.wrench.force.z);
}

TEST_F(InteractionTopicTest, InPartsThatOverlapTheForceIsNotValidAndDiagnosticsSaysWhy) {
  auto cubes = cubeAt("cubes", {0.0, 0.0, -0.1}, probe().time(), 0.1);
  const auto other = cubeAt("cubes", {0.05, 0.0, -0.1}, probe().time(), 0.08);
  for (const auto& triangle : other.mesh.triangles) {
    cubes.mesh.triangles.push_back(triangle);
    for (std::uint32_t& corner : cubes.mesh.triangles.back().vertex_indices) corner += 8;
  }
  cubes.mesh.vertices.insert(cubes.mesh.vertices.end(), other.mesh.vertices.begin(), other.mesh.vertices.end());
  placed_.insert("cubes");
  probe().place(cubes);
  EXPECT_FALSE(forceAt({0.0, 0.0, -0.01}).valid);
  EXPECT_TRUE(forceAt({0.0, 0.0, 0.1}).valid) << "the tool is not in it";
  const auto status =
      probe().awaitStatus("workpieces", [](const auto& next) { return !valueOf(next, "force of 'cubes'").empty(); });
  EXPECT_NE(valueOf(status, "force of 'cubes'").find("overlap"), std::string::npos);
}

TEST_F(InteractionTopicTest, BeforeTheSurfaceThereIsNoForce) {
  placeSquare("square", {0.0, 0.0, 0.0});
  const Interaction interaction = forceAt({0.0, 0.0, 0.01});
  EXPECT_TRUE(interaction.valid);
  EXPECT_TRUE(interaction.objects.empty());
  EXPECT_EQ(interaction.wrench.force.z, 0.0);
}

TEST_F(InteractionTopicTest, AWorkpieceMayHaveItsOwnStiffness) {
  placeSquare("square", {0.0, 0.0, 0.0});
  placeSquare("bone", {0.0, 0.0, -0.005});
  const Interaction interaction = forceAt({0.01, 0.02, -0.01});
  ASSERT_EQ(interaction.objects.size(), 2U);
  for (const auto& object : interaction.objects) {
    const double stiffness = object.mesh_id == "bone" ? 3e6 : 1e6;
    EXPECT_NEAR(object.wrench.force.z, -stiffness * object.volume, 1e-6) << object.mesh_id;
  }
  EXPECT_NEAR(interaction.wrench.force.z, -(1e6 * 0.01 + 3e6 * 0.005) * kCrossSection, 1e-5);
}

TEST_F(InteractionTopicTest, FollowsTheDeformedVertices) {
  placeSquare("square", {0.0, 0.0, 0.0});
  EXPECT_NEAR(forceAt({0.0, 0.0, -0.01}).objects.at(0).depth, 0.01, 1e-6);
  probe().place(squareMovedTo("square", {0.0, 0.0, -0.006}, probe().time()));
  EXPECT_NEAR(forceAt({0.0, 0.0, -0.01}).objects.at(0).depth, 0.004, 1e-6);
}

TEST_F(InteractionTopicTest, WithoutAWorkpieceTheForceIsNotValid) {
  while (forces_.all().empty()) {  // without a workpiece there are no contacts to wait for
    probe().tick(0.001);
    probe().publish(poseAt({0.0, 0.0, 0.05}, probe().time()));
  }
  EXPECT_FALSE(forces_.all().back().valid);
}

TEST(InteractionWithoutSubscriberTest, IsNotComputed) {
  const auto idle = [](const auto& status) { return valueOf(status, "interaction [%]") == "0.000"; };
  EXPECT_NO_THROW(probe().awaitStatus("stages", idle));
  probe().publish(poseAt({0.0, 0.0, 0.05}, probe().time()));
  EXPECT_NO_THROW(probe().awaitStatus("stages", idle));
}

}  // namespace
}  // namespace sweep_guard_ros
