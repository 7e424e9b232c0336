#include "session/session_bag.h"

#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/Header.h>
#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/MeshVertices.h>
#include <sys/stat.h>

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
    bag_.write(topic, ros::Time(recorded), pose);
  }
  void writeMesh() { bag_.write("/mesh", ros::Time(100.0), sweep_guard::DeformableMesh()); }

  SessionBag inspect() {
    bag_.close();
    return inspectBag(path_, {"/tool_pose", "/mesh", "/mesh_vertices", ""});
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
  const SessionTopics topics{"/tool_pose", "/mesh", "/mesh_vertices", ""};
  bag_.close();
  EXPECT_THROW(inspectBag(path_ + ".not", topics), sweep_guard_core::InvalidInput);
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
  EXPECT_EQ(inspectBag(path_, {"/tool_pose", "", "", ""}).poses.size(), 1U);
  EXPECT_TRUE(inspectBag(path_, {"", "", "", ""}).poses.empty());
}

TEST_F(SessionBagTest, NeedsTheJointsOfAToolWhoseJointsMove) {
  bag_.write("/joint_states", ros::Time(101.0), sensor_msgs::JointState());
  bag_.close();
  EXPECT_TRUE(inspectBag(path_, {"", "", "", "/joint_states"}).poses.empty());
  const std::string text = ::refusal([this] { inspectBag(path_, {"", "", "", "/arm/joint_states"}); });
  EXPECT_TRUE(has(text, "no topic /arm/joint_states")) << text;
  EXPECT_TRUE(has(text, "give joint_states:=TOPIC")) << text;
}

TEST_F(SessionBagTest, RefusesATopicOfAnotherType) {
  writeMesh();
  bag_.write("/tool_pose", ros::Time(101.0), std_msgs::Header());
  EXPECT_TRUE(has(refusal(), "/tool_pose is std_msgs/Header"));
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

}  // namespace
}  // namespace sweep_guard_session
