// The input of meshes in one process with their publishers, where a published message is queued at once.
#include "ros/input/mesh_input.h"

#include <gtest/gtest.h>
#include <ros/ros.h>

#include <boost/make_shared.hpp>
#include <thread>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

constexpr std::uint32_t kVertices = 300000;
const std::string kId = "square";

// A strip, large enough to take a while.
boost::shared_ptr<sweep_guard::DeformableMesh> strip(ros::Time stamp) {
  auto mesh = boost::make_shared<sweep_guard::DeformableMesh>();
  mesh->header.stamp = stamp;
  mesh->header.frame_id = "table";
  mesh->id = kId;
  for (std::uint32_t i = 0; i < kVertices; ++i) {
    geometry_msgs::Point vertex;
    vertex.x = 0.001 * i;
    vertex.y = i % 2;
    mesh->mesh.vertices.push_back(vertex);
    if (i < 2) continue;
    shape_msgs::MeshTriangle triangle;
    triangle.vertex_indices = {i - 2, i - 1, i};
    mesh->mesh.triangles.push_back(triangle);
  }
  return mesh;
}

boost::shared_ptr<sweep_guard::MeshVertices> raised(const sweep_guard::DeformableMesh& mesh, ros::Time stamp, float z) {
  auto vertices = boost::make_shared<sweep_guard::MeshVertices>();
  vertices->header = mesh.header;
  vertices->header.stamp = stamp;
  vertices->id = kId;
  for (const geometry_msgs::Point& vertex : mesh.mesh.vertices) {
    for (const double x : {vertex.x, vertex.y, static_cast<double>(z)}) {
      vertices->positions.push_back(static_cast<float>(x));
    }
  }
  return vertices;
}

// They may be the only ones that ever come.
TEST(MeshInputTest, VerticesDoNotOvertakeTheirMesh) {
  ros::NodeHandle node;
  const Parameters parameters = loadParameters(ros::NodeHandle("~"));
  sweep_guard_core::WarningMonitor monitor(parameters.limits);
  sweep_guard_core::WorkpieceStore workpieces([&](const auto& all) { monitor.setWorkpieces(all); });
  MeshInput input(node, parameters, workpieces, monitor);
  const ros::Publisher meshes = node.advertise<sweep_guard::DeformableMesh>("mesh", 10);
  const ros::Publisher vertices = node.advertise<sweep_guard::MeshVertices>("mesh_vertices", 10);
  ASSERT_EQ(meshes.getNumSubscribers(), 1U);
  ASSERT_EQ(vertices.getNumSubscribers(), 1U);
  input.start();
  const ros::Time begin = ros::Time::now() - ros::Duration(0.1);
  const auto mesh = strip(begin);
  const auto first = raised(*mesh, begin + ros::Duration(0.01), 1.0F);
  const auto second = raised(*mesh, begin + ros::Duration(0.02), 2.0F);
  meshes.publish(mesh);
  vertices.publish(first);
  vertices.publish(second);
  for (int i = 0; i < 2000; ++i) {
    const auto all = workpieces.snapshot();
    if (!all.empty() && all[0]->updates == 2) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  const auto all = workpieces.snapshot();
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0]->updates, 2U);
  EXPECT_EQ(all[0]->stamp, fromMsg(second->header.stamp));
  EXPECT_EQ(all[0]->mesh_M.vertex(0).z(), 2.0);
  EXPECT_EQ(monitor.meshProblems({all[0]->stamp, all[0]->received}, {}), "");
  EXPECT_EQ(input.droppedUpdates(), 0U);
}

}  // namespace
}  // namespace sweep_guard_ros
