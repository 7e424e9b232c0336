// Writes a bag with known contacts, plays it with replay.launch, and reads the report.
#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <sensor_msgs/JointState.h>
#include <sweep_guard/Contacts.h>
#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/Intend.h>
#include <sweep_guard/MeshVertices.h>
#include <sys/stat.h>
#include <tf2_msgs/TFMessage.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <future>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "refusal.h"
#include "replay_process.h"

namespace sweep_guard_session {
namespace {

namespace fs = std::filesystem;

constexpr double kBegin = 1000.0;                 // [s]
constexpr double kDuration = 4.0;                 // [s]
constexpr double kRate = 1000.0;                  // [Hz] of the poses
constexpr double kHeight = 0.15;                  // [m] of the tip above the plate, at first
constexpr double kPeriod = 2.0;                   // [s] down, and up again
constexpr double kSpeed = 0.16;                   // [m/s]
constexpr double kTurnRate = 0.5;                 // [rad/s] of the arm's shoulder
constexpr double kHold = 0.5;                     // [s] warning/hold_time
constexpr double kFirstTouch = kHeight / kSpeed;  // [s] after the tip begins to come down

constexpr double kContact = kPeriod - 2.0 * kFirstTouch + kHold;  // [s]

double duration(const std::vector<std::string>& contact) { return std::stod(contact[2]) - std::stod(contact[1]); }

// [s] of which it is not known when the tool left: poses that a machine was too slow for are swept at once. Less than tells a
// contact from one of another length.
double sweptAtOnce(const std::string& printed) {
  const std::string before = "waited for the next, up to ";
  const std::size_t found = printed.find(before);
  return found == std::string::npos ? 0.0 : std::min(std::stod(printed.substr(found + before.size())), 0.5 * kHold);
}

geometry_msgs::PoseStamped poseAt(double t) {
  const double phase = std::fmod(t, kPeriod);
  geometry_msgs::PoseStamped pose;
  pose.header.stamp = ros::Time(kBegin + t);
  pose.header.frame_id = "world";
  pose.pose.position.z = kHeight - kSpeed * std::min(phase, kPeriod - phase);
  pose.pose.orientation.x = 1.0;
  return pose;
}

sweep_guard::DeformableMesh plate() {
  sweep_guard::DeformableMesh mesh;
  mesh.header.stamp = ros::Time(kBegin);
  mesh.header.frame_id = "world";
  mesh.id = "plate";
  mesh.open = 1;
  mesh.revision = 1;
  for (const auto& [x, y] :
       std::vector<std::pair<double, double>>{{-0.1, -0.1}, {0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}}) {
    geometry_msgs::Point point;
    point.x = x;
    point.y = y;
    mesh.mesh.vertices.push_back(point);
  }
  mesh.mesh.triangles.resize(2);
  mesh.mesh.triangles[0].vertex_indices = {0, 1, 2};
  mesh.mesh.triangles[1].vertex_indices = {0, 2, 3};
  return mesh;
}

sweep_guard::MeshVertices verticesAt(double t) {
  sweep_guard::MeshVertices vertices;
  vertices.header.stamp = ros::Time(kBegin + t);
  vertices.header.frame_id = "world";
  vertices.id = "plate";
  vertices.revision = 1;
  vertices.positions = {-0.1F, -0.1F, 0.0F, 0.1F, -0.1F, 0.0F, 0.1F, 0.1F, 0.0F, -0.1F, 0.1F, 0.0F};
  return vertices;
}

class ReplayTest : public testing::Test {
 protected:
  ReplayTest() : folder_(fs::path(testing::TempDir()) / ("replay_test_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~ReplayTest() override { fs::remove_all(folder_); }

  void writeBag(const std::vector<void (*)(rosbag::Bag&)>& parts) const {
    rosbag::Bag bag(bag_.string(), rosbag::bagmode::Write);
    for (const auto write : parts) write(bag);
  }

  static void writeMesh(rosbag::Bag& bag) { bag.write("/mesh", ros::Time(kBegin), plate()); }

  static void writeVertices(rosbag::Bag& bag) {
    for (double t = 0.0; t < kDuration; t += 1.0 / 60.0) {
      bag.write("/mesh_vertices", ros::Time(kBegin + t), verticesAt(t));
    }
  }

  static void writePoses(rosbag::Bag& bag) {
    for (int i = 0; i < static_cast<int>(kDuration * kRate); ++i) {
      const geometry_msgs::PoseStamped pose = poseAt(i / kRate);
      bag.write("/tool_pose", pose.header.stamp, pose);
    }
  }

  static void writeTransforms(rosbag::Bag& bag) {
    for (double t = 0.0; t < kDuration; t += 0.01) {
      const geometry_msgs::PoseStamped pose = poseAt(t);
      tf2_msgs::TFMessage message;
      geometry_msgs::TransformStamped& transform = message.transforms.emplace_back();
      transform.header = pose.header;
      transform.child_frame_id = "tip";
      transform.transform.translation.z = pose.pose.position.z;
      transform.transform.rotation = pose.pose.orientation;
      bag.write("/tf", pose.header.stamp, message);
    }
  }

  // The base of arm.urdf, 0.3 m behind the plate: its shoulder turns the arm down, and up again.
  static void writeJoints(rosbag::Bag& bag) {
    tf2_msgs::TFMessage mount;
    geometry_msgs::TransformStamped& base = mount.transforms.emplace_back();
    base.header = poseAt(0.0).header;
    base.child_frame_id = "base";
    base.transform.translation.x = -0.3;
    base.transform.translation.z = kHeight;
    base.transform.rotation.w = 1.0;
    bag.write("/tf_static", base.header.stamp, mount);
    sensor_msgs::JointState joints;
    joints.name = {"shoulder", "elbow", "jaw"};
    for (double t = 0.0; t < kDuration; t += 0.01) {
      const double phase = std::fmod(t, kPeriod);
      joints.header = poseAt(t).header;
      joints.position = {kTurnRate * std::min(phase, kPeriod - phase), 0.0, 0.0};
      bag.write("/joint_states", joints.header.stamp, joints);
    }
  }

  std::string replay(const std::string& arguments) const { return replayBag(bag_, folder_, arguments); }

  fs::path folder_;
  fs::path bag_ = folder_ / "operator's \"first\" session.bag";
};

TEST_F(ReplayTest, ReportsEachContactWhenItWasWithItsLeads) {
  writeBag({writeMesh, writePoses, writeVertices});
  const std::string printed = replay("");
  EXPECT_TRUE(has(printed, "4000 poses")) << printed;
  EXPECT_TRUE(has(printed, "without a gap")) << printed;

  const auto contacts = readCsv(folder_ / "report/contacts.csv");
  ASSERT_EQ(contacts.size(), 3U) << printed;
  for (std::size_t i = 1; i < contacts.size(); ++i) {
    const double considered = std::stod(contacts[i][8]);
    const double reflex = std::stod(contacts[i][9]);
    EXPECT_NEAR(std::stod(contacts[i][1]), kFirstTouch + kPeriod * static_cast<double>(i - 1), 0.005);
    EXPECT_NEAR(duration(contacts[i]), kContact, 0.01 * kDuration + sweptAtOnce(printed));
    EXPECT_EQ(contacts[i][4], "plate");
    EXPECT_EQ(contacts[i][6], "2");
    EXPECT_NEAR(std::stod(contacts[i][7]), 1e3 * (kSpeed * kPeriod / 2.0 - kHeight), 1.0);
    EXPECT_GT(reflex, 0.0);
    EXPECT_GT(considered, reflex);
  }
  EXPECT_TRUE(has(readText(folder_ / "report/levels.csv"), "REFLEX")) << printed;
  EXPECT_GT(fs::file_size(folder_ / "report/timeline.png"), 10000U);
  EXPECT_GT(fs::file_size(folder_ / "report/contacts.png"), 10000U);
  EXPECT_GT(fs::file_size(folder_ / "report/touches.png"), 10000U);
  const auto touches = readCsv(folder_ / "report/touches.csv");
  ASSERT_EQ(touches.size(), 3U) << printed;
  for (std::size_t i = 1; i < touches.size(); ++i) {
    EXPECT_EQ(touches[i][0], "plate");
    EXPECT_EQ(touches[i][2], std::to_string(i - 1));
    EXPECT_GT(std::stoi(touches[i][3]), 10);
    EXPECT_NEAR(std::stod(touches[i][4]), std::stod(contacts[1][7]), 1.0);
  }
}

// Without matplotlib it draws none.
TEST_F(ReplayTest, APictureOfAnEarlierReportIsRemoved) {
  const auto write_begin = [](rosbag::Bag& bag) {
    for (int i = 0; i < 100; ++i) bag.write("/tool_pose", poseAt(i / kRate).header.stamp, poseAt(i / kRate));
  };
  writeBag({writeMesh, write_begin});
  fs::create_directories(folder_ / "report");
  for (const char* const picture : {"timeline.png", "contacts.png", "touches.png"}) {
    std::ofstream(folder_ / "report" / picture) << "earlier";
  }
  fs::create_directories(folder_ / "matplotlib");
  std::ofstream(folder_ / "matplotlib/__init__.py") << "raise ImportError('No module named matplotlib')\n";
  const char* const found = std::getenv("PYTHONPATH");
  const std::string path = found != nullptr ? found : "";
  setenv("PYTHONPATH", (folder_.string() + ':' + path).c_str(), 1);
  const std::string printed = replay("");
  setenv("PYTHONPATH", path.c_str(), 1);
  EXPECT_TRUE(fs::exists(folder_ / "report/contacts.csv")) << printed;
  for (const char* const picture : {"timeline.png", "contacts.png", "touches.png"}) {
    EXPECT_FALSE(fs::exists(folder_ / "report" / picture)) << printed;
  }
}

/// Comes to a replay when it is played already, and hears what is latched.
class LateListener {
 public:
  // Waits up to a minute for the master. A process has one node: use it once.
  explicit LateListener(int port) {
    ros::init(ros::M_string{{"__master", "http://127.0.0.1:" + std::to_string(port)}, {"__ip", "127.0.0.1"}},
              "late_listener", ros::init_options::NoSigintHandler);
    ros::master::setRetryTimeout(ros::WallDuration(60.0));
    node_.emplace();
    contacts_ = node_->subscribe<sweep_guard::Contacts>("/sweep_guard/contacts", 1, [this](const auto&) { join(); });
  }
  ~LateListener() { ros::shutdown(); }

  void listenUntil(const std::function<bool()>& condition) {
    while (!condition()) ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.05));
  }

  std::set<std::string> meshes;
  std::set<std::string> frames;

 private:
  void join() {
    contacts_.shutdown();
    mesh_ = node_->subscribe<sweep_guard::DeformableMesh>(
        "/mesh", 10, [this](const sweep_guard::DeformableMesh::ConstPtr& mesh) { meshes.insert(mesh->id); });
    transforms_ =
        node_->subscribe<tf2_msgs::TFMessage>("/tf_static", 10, [this](const tf2_msgs::TFMessage::ConstPtr& message) {
          for (const auto& transform : message->transforms) frames.insert(transform.child_frame_id);
        });
  }

  std::optional<ros::NodeHandle> node_;
  ros::Subscriber contacts_;
  ros::Subscriber mesh_;
  ros::Subscriber transforms_;
};

// The meshes and where they are are in the first part alone, and were recorded before the start. Parameters are beside it.
TEST_F(ReplayTest, PlaysThePartsOfASessionFromALaterTimeOn) {
  const auto part = [this](const std::string& name) { return (folder_ / name).string(); };
  {
    rosbag::Bag first(part("black_box_1 first.bag"), rosbag::bagmode::Write);
    sweep_guard::DeformableMesh mesh = plate();
    mesh.header.frame_id = "table";
    first.write("/mesh", ros::Time(kBegin), mesh);
    mesh.id = "bone";
    for (geometry_msgs::Point& vertex : mesh.mesh.vertices) vertex.x += 1.0;
    first.write("/mesh", ros::Time(kBegin), mesh);
    tf2_msgs::TFMessage placed;
    geometry_msgs::TransformStamped& table = placed.transforms.emplace_back();
    table.header.stamp = ros::Time(kBegin);
    table.header.frame_id = "world";
    table.child_frame_id = "table";
    table.transform.translation.z = 0.02;
    table.transform.rotation.w = 1.0;
    first.write("/tf_static", ros::Time(kBegin), placed);
    rosbag::Bag second(part("black_box_2.bag"), rosbag::bagmode::Write);
    rosbag::Bag third(part("third.bag"), rosbag::bagmode::Write);
    for (int i = 0; i < static_cast<int>(kDuration * kRate); ++i) {
      const geometry_msgs::PoseStamped pose = poseAt(i / kRate);
      rosbag::Bag& bag = i < 1500 ? first : i < 3000 ? second : third;
      bag.write("/tool_pose", pose.header.stamp, pose);
    }
  }
  std::ofstream(part("black_box_1 first.yaml")) << "timing:\n  mesh_timeout: .inf\n";
  std::ofstream(part("black_box_2.yaml")) << "timing:\n  mesh_timeout: 0.5\n";
  const std::string list = part("black_box_1 first.bag") + ":" + part("black_box_2.bag") + ":" + part("third.bag");
  const int port = freePort();
  std::future<std::string> replayed = std::async(
      std::launch::async, [this, &list, port] { return replayBag(list, folder_, "start:=2 rate:=0.5", port); });
  const auto has_ended = [&replayed] {
    return replayed.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  };
  {
    LateListener late(port);
    late.listenUntil([&] { return has_ended() || (late.meshes.size() == 2 && !late.frames.empty()); });
    EXPECT_EQ(late.meshes, (std::set<std::string>{"bone", "plate"}));
    EXPECT_EQ(late.frames, std::set<std::string>{"table"});
  }
  const std::string printed = replayed.get();
  const auto contacts = readCsv(folder_ / "report/contacts.csv");
  ASSERT_EQ(contacts.size(), 2U) << printed;
  EXPECT_NEAR(std::stod(contacts[1][1]), (kHeight - 0.02) / kSpeed + kPeriod, 0.005) << printed;
  EXPECT_TRUE(has(printed, "(played from 2.0 s on), 2000 poses")) << printed;
  EXPECT_FALSE(has(printed, "missing    ")) << printed;
  EXPECT_TRUE(has(printed, "config     " + part("black_box_1 first.yaml"))) << printed;
  EXPECT_TRUE(has(printed, "black_box_2.bag, which is played with timing/mesh_timeout .inf instead of 0.5")) << printed;
}

// The guard holds a contact by the clock of the machine: at four times the speed it would join the two. So few poses that
// a machine under load keeps up.
TEST_F(ReplayTest, ContactsLastAsLongAtFourTimesTheSpeed) {
  const auto write_poses = [](rosbag::Bag& bag) {
    for (double t = 0.0; t < kDuration; t += 0.01) bag.write("/tool_pose", poseAt(t).header.stamp, poseAt(t));
  };
  writeBag({writeMesh, write_poses, writeVertices});
  const std::string printed = replay("rate:=4");
  const auto contacts = readCsv(folder_ / "report/contacts.csv");
  ASSERT_EQ(contacts.size(), 3U) << printed;
  for (std::size_t i = 1; i < contacts.size(); ++i) {
    EXPECT_NEAR(std::stod(contacts[i][1]), kFirstTouch + kPeriod * static_cast<double>(i - 1), 0.005) << printed;
    EXPECT_NEAR(duration(contacts[i]), kContact, 0.01 * kDuration + sweptAtOnce(printed)) << printed;
  }
}

// The file is in millimeters.
TEST_F(ReplayTest, TakesAWorkpieceFromAFileWhereTheBagHasNone) {
  writeBag({writePoses});
  const fs::path file = folder_ / "plate.obj";
  std::ofstream(file) << "v -100 -100 0\nv 100 -100 0\nv 100 100 0\nv -100 100 0\nf 1 2 3\nf 1 3 4\n";
  const std::string printed = replay("mesh_file:=" + file.string() + " mesh_scale:=0.001");
  ASSERT_EQ(readCsv(folder_ / "report/contacts.csv").size(), 3U) << printed;
}

// The guard does not subscribe to the poses, and the player waits for a subscriber of each topic.
TEST_F(ReplayTest, TakesTheToolFromTfAlthoughTheBagHasItsPoses) {
  writeBag({writeMesh, writePoses, writeTransforms});
  const fs::path config = folder_ / "tf.yaml";
  std::ofstream(config) << "tool_source: tf\ntool_frame: tip\ntiming:\n  mesh_timeout: .inf\n";
  const std::string printed = replay("config:=" + config.string());
  ASSERT_EQ(readCsv(folder_ / "report/contacts.csv").size(), 3U) << printed;
  EXPECT_FALSE(has(printed, "there are no vertices")) << printed;
}

// The far edge of the plate is 0.4 m before the shoulder and 0.15 m below it, and the forearm is 0.02 m thick:
// 0.15 cos a - 0.4 sin a = 0.01 at an angle a of 0.3354.
TEST_F(ReplayTest, PlaysTheJointsOfATool) {
  writeBag({writeMesh, writeJoints});
  const fs::path config = folder_ / "joints.yaml";
  std::ofstream(config) << "tool_source: joint_states\ntool_frame: base\ntiming:\n  mesh_timeout: .inf\n"
                        << "tool:\n  type: urdf\n  links: [upper, fore, left, right]\n";
  const std::string urdf = std::string(SWEEP_GUARD_SOURCE_DIR) + "/test/ros/arm.urdf";
  const std::string printed = replay("config:=" + config.string() + " tool_urdf:=" + urdf);
  const auto contacts = readCsv(folder_ / "report/contacts.csv");
  ASSERT_EQ(contacts.size(), 3U) << printed;
  EXPECT_NEAR(std::stod(contacts[1][1]), 0.3354 / kTurnRate, 0.005) << printed;
  EXPECT_EQ(contacts[1][5], "fore") << printed;
}

TEST_F(ReplayTest, ContactThatWasMeantIsMeantInTheReplay) {
  const auto write_intend = [](rosbag::Bag& bag) {
    sweep_guard::Intend intend;
    intend.mesh_id = "plate";
    intend.triangles = {0, 1};
    intend.depth = 0.05;
    bag.write("/sweep_guard/intend_updates", ros::Time(kBegin + 0.3), intend);
  };
  writeBag({writeMesh, writePoses, writeVertices, write_intend});
  const std::string printed = replay("");
  const std::string levels = readText(folder_ / "report/levels.csv");
  EXPECT_TRUE(has(levels, "CLEAR")) << printed;
  EXPECT_FALSE(has(levels, "CONTACT")) << levels;
}

TEST_F(ReplayTest, ABagThatCannotBeGuardedEndsItWithALineThatSaysWhy) {
  writeBag({writeMesh});
  const std::string printed = replay("");
  EXPECT_TRUE(has(printed, "no topic /tool_pose")) << printed;
  EXPECT_FALSE(fs::exists(folder_ / "report/contacts.csv"));
}

TEST_F(ReplayTest, ARateThatIsNoneEndsItWithALineThatNamesIt) {
  writeBag({writeMesh, writePoses});
  const std::string printed = replay("rate:=0");
  EXPECT_TRUE(has(printed, "rate")) << printed;
  EXPECT_TRUE(has(printed, "0.001")) << printed;
  EXPECT_FALSE(fs::exists(folder_ / "report/contacts.csv"));
}

// If roslaunch had to kill it, the log would say so.
TEST_F(ReplayTest, APipeEndsItWithALineThatSaysWhyAndLeavesNobodyHanging) {
  ASSERT_EQ(mkfifo(bag_.c_str(), 0600), 0);
  const std::string printed = replay("");
  EXPECT_TRUE(has(printed, "not a regular file")) << printed;
  EXPECT_FALSE(has(printed, "escalating")) << printed;
}

}  // namespace
}  // namespace sweep_guard_session
