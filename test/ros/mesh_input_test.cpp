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

class MeshInputTest : public testing::Test {
 protected:
  MeshInputTest() { input_.start(supervisor_); }

  template <typename Condition>
  bool await(const Condition& condition) const {
    for (int i = 0; i < 2000 && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return condition();
  }

  // @returns what is wrong `seconds` from now
  std::string problems(double seconds = 0.0) const {
    const sweep_guard_core::Duration later = sweep_guard_core::fromSeconds(seconds);
    return monitor_.meshProblems({now().stamp + later, now().steady + later}, {});
  }

  // With rules for two workpieces that most tests do not have.
  static Parameters parameters() {
    Parameters parameters = loadParameters(ros::NodeHandle("~"));
    parameters.paddings.by_id["padded"] = 0.01;
    parameters.sheets.by_id["curtain"] = true;
    return parameters;
  }

  ros::NodeHandle node_;
  const Parameters parameters_ = parameters();
  sweep_guard_core::WarningMonitor monitor_{
      {parameters_.limits.pose_timeout, /*mesh_timeout=*/sweep_guard_core::Duration::max(), {}}};
  sweep_guard_core::WorkpieceStore workpieces_{[this](const auto& all) { monitor_.setWorkpieces(all); }};
  Supervisor supervisor_{Process::kShared};
  MeshInput input_{node_, parameters_, workpieces_, monitor_};
  const ros::Publisher meshes_ = node_.advertise<sweep_guard::DeformableMesh>("mesh", 10);
  const ros::Publisher vertices_ = node_.advertise<sweep_guard::MeshVertices>("mesh_vertices", 10);
  const ros::Time begin_ = ros::Time::now() - ros::Duration(0.1);
};

// They may be the only ones that ever come.
TEST_F(MeshInputTest, VerticesDoNotOvertakeTheirMesh) {
  const auto mesh = strip(begin_);
  const auto first = raised(*mesh, begin_ + ros::Duration(0.01), 1.0F);
  const auto second = raised(*mesh, begin_ + ros::Duration(0.02), 2.0F);
  meshes_.publish(mesh);
  vertices_.publish(first);
  vertices_.publish(second);
  ASSERT_TRUE(await([&] {
    const auto all = workpieces_.snapshot();
    return !all.empty() && all[0]->updates == 2;
  }));
  const auto all = workpieces_.snapshot();
  EXPECT_EQ(all[0]->stamp, fromMsg(second->header.stamp));
  EXPECT_EQ(all[0]->mesh_M.vertex(0).z(), 2.0);
  EXPECT_EQ(problems(), "");
  EXPECT_EQ(input_.droppedUpdates(), 0U);
}

TEST_F(MeshInputTest, AMeshThatItsSenderRefusesIsRefusedInItsWords) {
  const auto mesh = strip(begin_);
  const auto refused = boost::make_shared<sweep_guard::DeformableMesh>(*mesh);
  refused->refused = "a shape is a cone";
  meshes_.publish(mesh);
  meshes_.publish(refused);
  EXPECT_TRUE(await([&] { return problems() == "workpiece 'square' refused: its sender says: a shape is a cone"; }));
  EXPECT_TRUE(await([&] { return workpieces_.contains(kId); })) << "the mesh before stays";
  const auto again = boost::make_shared<sweep_guard::DeformableMesh>(*mesh);
  again->header.stamp += ros::Duration(0.01);
  meshes_.publish(again);
  EXPECT_TRUE(await([&] { return problems().empty(); }));
}

TEST_F(MeshInputTest, AWorkpieceIsAsItsRulesSay) {
  for (const std::string& id : {kId, std::string("padded"), std::string("curtain")}) {
    const auto mesh = strip(begin_);
    mesh->id = id;
    meshes_.publish(mesh);
  }
  ASSERT_TRUE(await([&] { return workpieces_.snapshot().size() == 3; }));
  for (const auto& workpiece : workpieces_.snapshot()) {
    EXPECT_EQ(workpiece->mesh_M.padding(), workpiece->id == "padded" ? 0.01 : 0.0);
    EXPECT_EQ(workpiece->mesh_M.isSheet(), workpiece->id == "curtain") << workpiece->id;
  }
}

// It says nothing of where the workpiece is, so nothing but the end of its age depends on it.
TEST_F(MeshInputTest, WhatIsWrongWithAMessageWithoutPositionsCountsForASecond) {
  const auto mesh = strip(begin_);
  meshes_.publish(mesh);
  ASSERT_TRUE(await([&] { return problems().empty(); }));
  auto unchanged = boost::make_shared<sweep_guard::MeshVertices>();
  unchanged->header = mesh->header;
  unchanged->id = kId;
  unchanged->header.stamp = ros::Time::now() + ros::Duration(100.0);
  vertices_.publish(unchanged);
  ASSERT_TRUE(await([&] { return !problems().empty(); }));
  EXPECT_EQ(problems(1.1), "");
  const auto before = workpieces_.snapshot()[0];
  unchanged = boost::make_shared<sweep_guard::MeshVertices>(*unchanged);
  unchanged->header.stamp = ros::Time::now();
  vertices_.publish(unchanged);
  ASSERT_TRUE(await([&] { return monitor_.heard().at(0).second.stamp == fromMsg(unchanged->header.stamp); }));
  EXPECT_EQ(workpieces_.snapshot()[0], before);
}

// The good one is accepted after the bad one behind it is refused: it is converted first, and stored later.
TEST_F(MeshInputTest, AGoodMeshDoesNotExcuseABadOneThatCameAfterIt) {
  const auto good = strip(begin_);
  const auto bad = boost::make_shared<sweep_guard::DeformableMesh>(*good);
  bad->revision = 2;
  bad->mesh.triangles[0].vertex_indices[0] = kVertices;
  for (int i = 0; i < 5; ++i) {
    const auto again = boost::make_shared<sweep_guard::DeformableMesh>(*good);
    again->header.stamp = begin_ + ros::Duration(0.001 * i);
    meshes_.publish(again);
  }
  meshes_.publish(bad);
  ASSERT_TRUE(await([&] { return input_.meshRecord().summary().refused == 1; }));
  ASSERT_TRUE(await([&] {
    const auto all = workpieces_.snapshot();
    return !all.empty() && all[0]->stamp == fromMsg(begin_ + ros::Duration(0.004));
  }));
  const ros::Time last = begin_ + ros::Duration(0.01);
  vertices_.publish(raised(*good, last, 1.0F));  // stored after every mesh is accepted
  ASSERT_TRUE(await([&] { return workpieces_.snapshot()[0]->stamp == fromMsg(last); }));
  EXPECT_NE(problems(10.0).find("refused"), std::string::npos);
}

TEST_F(MeshInputTest, VerticesOfNoWorkpieceAreForgottenWhateverElseIsWrongWithThem) {
  const auto mesh = strip(begin_);
  auto without_frame = raised(*mesh, begin_, 1.0F);
  without_frame->header.frame_id.clear();
  auto in_the_future = raised(*mesh, ros::Time::now() + ros::Duration(3600.0), 1.0F);
  const std::string nothing_else = "no workpiece yet";
  std::uint64_t refused = 0;
  for (const auto& vertices : {without_frame, in_the_future}) {
    vertices_.publish(vertices);
    ++refused;
    ASSERT_TRUE(await([&] { return input_.verticesRecord().summary().refused == refused; }));
    EXPECT_NE(problems(), nothing_else);
    EXPECT_EQ(problems(1.1), nothing_else);
  }
}

}  // namespace
}  // namespace sweep_guard_ros
