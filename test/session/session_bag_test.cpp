#include "session/session_bag.h"

#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/Header.h>
#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/MeshVertices.h>
#include <sys/stat.h>
#include <tf2_msgs/TFMessage.h>

#include <boost/make_shared.hpp>
#include <filesystem>
#include <fstream>
#include <string>

#include "refusal.h"
#include "sweep_guard/common/error.h"
#include "test_file.h"

namespace sweep_guard_session {
namespace {

using std::chrono::seconds;

class SessionBagTest : public testing::Test {
 protected:
  SessionBagTest() : path_(sweep_guard_core::testFile(".bag")), bag_(path_, rosbag::bagmode::Write) {}
  ~SessionBagTest() override { std::filesystem::remove(path_); }

  void writePose(double recorded, double stamp, const std::string& topic = "/tool_pose") {
    geometry_msgs::PoseStamped pose;
    pose.header.stamp = ros::Time(stamp);
    pose.header.frame_id = "world";
    bag_.write(topic, ros::Time(recorded), pose);
  }
  void writeMesh(const std::string& topic = "/mesh", const std::string& frame = "world") {
    sweep_guard::DeformableMesh mesh;
    mesh.header.frame_id = frame;
    mesh.mesh.triangles.resize(1);
    bag_.write(topic, ros::Time(100.0), mesh);
  }
  void writeTransform(const std::string& topic, const std::string& parent, const std::string& child) {
    tf2_msgs::TFMessage message;
    message.transforms.resize(1);
    message.transforms[0].header.frame_id = parent;
    message.transforms[0].child_frame_id = child;
    bag_.write(topic, ros::Time(101.0), message);
  }

  // As of a version of its definition that is older.
  template <typename Message>
  void writeOld(const std::string& topic) {
    const auto header = boost::make_shared<ros::M_string>();
    (*header)["type"] = ros::message_traits::DataType<Message>::value();
    (*header)["md5sum"] = "0123456789abcdef0123456789abcdef";
    (*header)["message_definition"] = ros::message_traits::Definition<Message>::value();
    bag_.write(topic, ros::Time(102.0), Message(), header);
  }
  void expectRefusalOfVersion(const std::string& topic) {
    const std::string text = refusal();
    EXPECT_TRUE(has(text, topic + " is ")) << text;
    EXPECT_TRUE(has(text, "of another version of its definition: migrate it (rosbag fix), or record again")) << text;
  }

  SessionBag inspect() {
    bag_.close();
    return inspectSession(SessionFiles({path_}), {"/tool_pose", "/mesh", "/mesh_vertices", ""});
  }

  // Returns the message of the refusal.
  std::string refusal() {
    return ::refusal([&] { inspect(); });
  }

  std::string path_;
  rosbag::Bag bag_;
};

TEST_F(SessionBagTest, CountsWhatIsGuarded) {
  writeMesh();
  writePose(101.0, 100.99);
  writePose(102.0, 101.99);
  bag_.write("/mesh_vertices", ros::Time(103.0), sweep_guard::MeshVertices());
  const SessionBag bag = inspect();
  ASSERT_EQ(bag.poses.size(), 2U);
  EXPECT_EQ(bag.meshes, 1U);
  EXPECT_EQ(bag.vertices, 1U);
  EXPECT_EQ(bag.begin, sweep_guard_core::Time(seconds(100)));
  EXPECT_EQ(bag.end, sweep_guard_core::Time(seconds(103)));
  EXPECT_EQ(bag.poses.back(), sweep_guard_core::Time(std::chrono::milliseconds(101990)));
}

TEST_F(SessionBagTest, RefusesAFileThatIsMissingOrNoBag) {
  bag_.close();
  EXPECT_THROW(SessionFiles({path_ + ".not"}), sweep_guard_core::InvalidInput);
  std::ofstream(path_) << "100 0 0 0 0 0 0 1\n";
  EXPECT_TRUE(has(refusal(), "not a rosbag"));
}

// Opening it would wait for a writer.
TEST_F(SessionBagTest, RefusesAPipe) {
  bag_.close();
  std::filesystem::remove(path_);
  ASSERT_EQ(mkfifo(path_.c_str(), 0600), 0);
  EXPECT_TRUE(has(refusal(), "not a regular file"));
}

TEST_F(SessionBagTest, RefusesAnEmptyBag) { EXPECT_TRUE(has(refusal(), "the bag is empty")); }

TEST_F(SessionBagTest, ListsTheTopicsThatAreThereWhereOneIsMissing) {
  writeMesh();
  writePose(101.0, 101.0, "/stylus");
  const std::string text = refusal();
  EXPECT_TRUE(has(text, "no topic /tool_pose"));
  EXPECT_TRUE(has(text, "give tool_pose:=TOPIC"));
  EXPECT_TRUE(has(text, "/stylus (geometry_msgs/PoseStamped)"));
  EXPECT_TRUE(has(text, "/mesh (sweep_guard/DeformableMesh)"));
}

TEST_F(SessionBagTest, SaysHowToGuardABagWithoutAMesh) {
  writePose(101.0, 101.0);
  EXPECT_TRUE(has(refusal(), "mesh_file:=FILE"));
}

TEST_F(SessionBagTest, NeedsNoMeshThatComesFromElsewhereAndNoPoseThatComesFromTf) {
  writePose(101.0, 101.0);
  bag_.close();
  EXPECT_EQ(inspectSession(SessionFiles({path_}), {"/tool_pose", "", "", ""}).poses.size(), 1U);
  EXPECT_TRUE(inspectSession(SessionFiles({path_}), {"", "", "", ""}).poses.empty());
}

TEST_F(SessionBagTest, NeedsTheJointsOfAToolWhoseJointsMove) {
  bag_.write("/joint_states", ros::Time(101.0), sensor_msgs::JointState());
  bag_.close();
  EXPECT_TRUE(inspectSession(SessionFiles({path_}), {"", "", "", "/joint_states"}).poses.empty());
  const std::string text = ::refusal([this] {
    inspectSession(SessionFiles({path_}), {"", "", "", "/arm/joint_states"});
  });
  EXPECT_TRUE(has(text, "no topic /arm/joint_states")) << text;
  EXPECT_TRUE(has(text, "give joint_states:=TOPIC")) << text;
}

TEST_F(SessionBagTest, RefusesATopicOfAnotherType) {
  writeMesh();
  bag_.write("/tool_pose", ros::Time(101.0), std_msgs::Header());
  EXPECT_TRUE(has(refusal(), "/tool_pose is std_msgs/Header"));
}

// The player would wait for the guard without end.
TEST_F(SessionBagTest, RefusesAMeshOfAnotherVersion) {
  writePose(101.0, 101.0);
  writeMesh();  // of another publisher
  writeOld<sweep_guard::DeformableMesh>("/mesh");
  expectRefusalOfVersion("/mesh");
}

TEST_F(SessionBagTest, RefusesPosesOfAnotherVersion) {
  writeMesh();
  writeOld<geometry_msgs::PoseStamped>("tool_pose");
  expectRefusalOfVersion("/tool_pose");
}

TEST_F(SessionBagTest, RefusesVerticesOfAnotherVersion) {
  writeMesh();
  writePose(101.0, 101.0);
  writeOld<sweep_guard::MeshVertices>("/mesh_vertices");
  expectRefusalOfVersion("/mesh_vertices");
}

TEST_F(SessionBagTest, RefusesTransformsOfAnotherVersion) {
  writeMesh();
  writePose(101.0, 101.0);
  writeOld<tf2_msgs::TFMessage>("tf_static");
  expectRefusalOfVersion("/tf_static");
}

TEST_F(SessionBagTest, PassesOverAnotherVersionOfWhatIsNotPlayed) {
  writeMesh();
  writePose(101.0, 101.0);
  writeOld<sweep_guard::DeformableMesh>("/other_mesh");
  EXPECT_EQ(inspect().meshes, 1U);
}

TEST_F(SessionBagTest, FindsTopicsThatAScriptWroteWithoutASlash) {
  writeMesh("mesh", "table");
  writePose(101.0, 101.0, "tool_pose");
  writePose(102.0, 102.0);
  writeTransform("tf_static", "world", "table");
  bag_.close();
  for (const std::string slash : {"/", ""}) {
    const SessionTopics topics{slash + "tool_pose", slash + "mesh", slash + "mesh_vertices", ""};
    const SessionBag bag = inspectSession(SessionFiles({path_}), topics);
    EXPECT_EQ(bag.poses.size(), 2U) << slash;
    EXPECT_EQ(bag.meshes, 1U) << slash;
    EXPECT_TRUE(bag.missing.empty()) << slash;
  }
}

TEST_F(SessionBagTest, FixedFrameAndThoseOfTheToolMayHaveASlash) {
  writeMesh("/mesh", "/world");
  writePose(101.0, 101.0);
  bag_.close();
  for (const std::string fixed : {"world", "/world"}) {
    for (const std::string tool : {"world", "/world"}) {
      const SessionTopics topics{"/tool_pose", "/mesh", "/mesh_vertices", "", {tool}, fixed};
      EXPECT_TRUE(inspectSession(SessionFiles({path_}), topics).missing.empty()) << fixed << ' ' << tool;
    }
  }
  const SessionTopics other{"/tool_pose", "/mesh", "/mesh_vertices", "", {"/tip"}, "/world"};
  EXPECT_TRUE(has(inspectSession(SessionFiles({path_}), other).missing.at(0), "no transform of 'tip'"));
}

TEST_F(SessionBagTest, RefusesPosesWithoutStamps) {
  writeMesh();
  writePose(101.0, 0.0);
  EXPECT_TRUE(has(refusal(), "no stamps"));
}

TEST_F(SessionBagTest, RefusesPosesWithStampsOfAnotherClock) {
  writeMesh();
  writePose(101.0, 41.0);
  writePose(102.0, 42.5);
  EXPECT_TRUE(has(refusal(), "stamped 59.5 s before they were recorded"));
}

// They are in the first part of a split recording.
TEST_F(SessionBagTest, SaysWhereWhatIsLatchedHasGone) {
  writePose(101.0, 101.0);
  const std::string text = refusal();
  EXPECT_TRUE(has(text, "no topic /mesh")) << text;
  EXPECT_TRUE(has(text, "there is no /tf_static either")) << text;
  EXPECT_TRUE(has(text, "in the first part of a split recording")) << text;
  EXPECT_TRUE(has(text, "bag:=FIRST:SECOND")) << text;
  EXPECT_TRUE(has(text, "--repeat-latched")) << text;
}

TEST_F(SessionBagTest, SaysNothingOfStaticTransformsThatAreThere) {
  writePose(101.0, 101.0);
  writeTransform("/tf_static", "world", "table");
  const std::string text = refusal();
  EXPECT_FALSE(has(text, "either")) << text;
  EXPECT_TRUE(has(text, "--repeat-latched")) << text;
}

TEST_F(SessionBagTest, SaysNothingOfPartsIfTheMeshHasAnotherName) {
  writePose(101.0, 101.0);
  writeMesh("/liver/mesh");
  const std::string text = refusal();
  EXPECT_TRUE(has(text, "/liver/mesh (sweep_guard/DeformableMesh)")) << text;
  EXPECT_FALSE(has(text, "--repeat-latched")) << text;
}

TEST_F(SessionBagTest, NamesTheFramesThatNoTransformPlaces) {
  writePose(101.0, 101.0);
  writeMesh("/mesh", "table_frame");
  const SessionBag bag = inspect();
  ASSERT_EQ(bag.missing.size(), 1U);
  EXPECT_TRUE(has(bag.missing[0], "no transform of 'table_frame', and no topic /tf_static")) << bag.missing[0];
  EXPECT_TRUE(has(bag.missing[0], "--repeat-latched")) << bag.missing[0];
  const SessionTopics tool{"/tool_pose", "/mesh", "/mesh_vertices", "", {"tip"}, "table_frame"};
  const SessionBag other = inspectSession(SessionFiles({path_}), tool);
  ASSERT_EQ(other.missing.size(), 1U);
  EXPECT_TRUE(has(other.missing[0], "no transform of 'tip', 'world'")) << other.missing[0];
}

TEST_F(SessionBagTest, LacksNoTransformOfAFrameThatIsInTf) {
  writePose(101.0, 101.0);
  writeMesh("/mesh", "/table_frame");
  writeTransform("/tf_static", "world", "table_frame");
  writeTransform("/tf", "base", "tip");
  bag_.close();
  for (const std::string tool : {"tip", "base", "table_frame"}) {
    const SessionTopics topics{"/tool_pose", "/mesh", "/mesh_vertices", "", {tool}};
    EXPECT_TRUE(inspectSession(SessionFiles({path_}), topics).missing.empty()) << tool;
  }
}

TEST_F(SessionBagTest, CountsThePosesFromTheStartOn) {
  writeMesh();
  for (const double second : {101.0, 102.0, 103.0}) writePose(second, second);
  bag_.close();
  const SessionFiles files({path_});
  const SessionTopics topics{"/tool_pose", "/mesh", "/mesh_vertices", ""};
  for (const auto& [start, poses] : {std::pair{0, 3U}, {1, 3U}, {2, 2U}, {3, 1U}}) {
    const SessionBag bag = inspectSession(files, topics, seconds(start));
    EXPECT_EQ(bag.poses.size(), poses) << start;
    EXPECT_EQ(bag.begin, sweep_guard_core::Time(seconds(100)));
    EXPECT_EQ(bag.start, sweep_guard_core::Time(seconds(100 + start)));
  }
  const std::string text = ::refusal([&] { inspectSession(files, topics, seconds(4)); });
  EXPECT_TRUE(has(text, "it ends after 3.0 s; give a smaller start:=SECONDS")) << text;
}

}  // namespace
}  // namespace sweep_guard_session
