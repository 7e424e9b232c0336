#include "session/session_start.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "test_file.h"

namespace sweep_guard_session {
namespace {

using std::chrono::seconds;

class SessionStartTest : public testing::Test {
 protected:
  SessionStartTest() : path_(sweep_guard_core::testFile(".bag")), bag_(path_, rosbag::bagmode::Write) {
    writeTransform(100, "elsewhere", 0.0);
  }
  ~SessionStartTest() override { std::filesystem::remove(path_); }

  void writeMesh(int recorded, const std::string& id, std::uint32_t revision, size_t triangles = 1) {
    sweep_guard::DeformableMesh mesh;
    mesh.id = id;
    mesh.revision = revision;
    mesh.mesh.triangles.resize(triangles);
    bag_.write("/mesh", ros::Time(recorded), mesh);
  }
  void writeVertices(int recorded, const std::string& id, std::uint32_t revision, float x) {
    sweep_guard::MeshVertices vertices;
    vertices.id = id;
    vertices.revision = revision;
    vertices.positions = {x};
    bag_.write("/mesh_vertices", ros::Time(recorded), vertices);
  }
  void writeTransform(int recorded, const std::string& child, double x) {
    tf2_msgs::TFMessage message;
    message.transforms.resize(1);
    message.transforms[0].child_frame_id = child;
    message.transforms[0].transform.translation.x = x;
    bag_.write("/tf_static", ros::Time(recorded), message);
  }
  void writeIntend(int recorded, const std::string& mesh, double radius, int duration) {
    sweep_guard::Intend intend;
    intend.mesh_id = mesh;
    intend.radius = radius;
    intend.duration = ros::Duration(duration);
    bag_.write("/sweep_guard/intend_updates", ros::Time(recorded), intend);
  }

  SessionStart startAt(int second) {
    bag_.close();
    return readStart(SessionFiles({path_}), {"/tool_pose", "/mesh", "/mesh_vertices", ""},
                     sweep_guard_core::Time(seconds(second)));
  }

  std::string path_;
  rosbag::Bag bag_;
};

TEST_F(SessionStartTest, KeepsTheNewestOfEachWorkpieceFromBefore) {
  writeMesh(101, "liver", 1);
  writeMesh(101, "bone", 1);
  writeVertices(102, "liver", 1, 0.1F);
  writeVertices(103, "liver", 1, 0.2F);
  writeVertices(103, "bone", 1, 0.3F);
  writeMesh(104, "bone", 2);
  writeMesh(110, "liver", 2);
  writeVertices(111, "liver", 2, 0.4F);
  const SessionStart start = startAt(110);
  ASSERT_EQ(start.meshes.size(), 2U);
  EXPECT_EQ(start.meshes[0]->id, "bone");
  EXPECT_EQ(start.meshes[0]->revision, 2U);
  EXPECT_EQ(start.meshes[1]->revision, 1U);
  ASSERT_EQ(start.vertices.size(), 1U) << "vertices of the bone belong to the mesh before";
  EXPECT_EQ(start.vertices[0]->positions.front(), 0.2F);
}

TEST_F(SessionStartTest, LeavesOutWhatWasRemoved) {
  writeMesh(101, "liver", 1);
  writeMesh(101, "bone", 1);
  writeVertices(102, "liver", 1, 0.1F);
  writeMesh(103, "liver", 1, 0);
  const SessionStart start = startAt(110);
  ASSERT_EQ(start.meshes.size(), 1U);
  EXPECT_EQ(start.meshes[0]->id, "bone");
  EXPECT_TRUE(start.vertices.empty());
}

TEST_F(SessionStartTest, KeepsTheNewestStaticTransformOfEachFrame) {
  writeTransform(101, "table", 0.1);
  writeTransform(102, "camera", 0.2);
  writeTransform(103, "table", 0.3);
  writeTransform(110, "table", 0.4);
  const SessionStart start = startAt(110);
  ASSERT_EQ(start.transforms.size(), 1U);
  const auto& transforms = start.transforms[0]->transforms;
  ASSERT_EQ(transforms.size(), 3U);
  EXPECT_EQ(transforms[0].child_frame_id, "camera");
  EXPECT_EQ(transforms[2].child_frame_id, "table");
  EXPECT_EQ(transforms[2].transform.translation.x, 0.3);
}

TEST_F(SessionStartTest, IntentionsLastAsLongAsTheyWere) {
  writeIntend(101, "liver", 0.1, 0);
  writeIntend(102, "liver", 0.0, 0);  // takes it back
  writeIntend(103, "liver", 0.2, 0);
  writeIntend(104, "bone", 0.3, 5);
  writeIntend(105, "bone", 0.4, 7);
  const SessionStart start = startAt(110);
  ASSERT_EQ(start.intends.size(), 2U);
  EXPECT_EQ(start.intends[0]->radius, 0.2);
  EXPECT_EQ(start.intends[0]->duration, ros::Duration(0));
  EXPECT_EQ(start.intends[1]->radius, 0.4);
  EXPECT_EQ(start.intends[1]->duration, ros::Duration(2));
}

TEST_F(SessionStartTest, IsEmptyAtTheBegin) {
  writeMesh(100, "liver", 1);
  const SessionStart start = startAt(100);
  EXPECT_TRUE(start.meshes.empty());
  EXPECT_TRUE(start.transforms.empty());
}

}  // namespace
}  // namespace sweep_guard_session
