// A real guard beside the black box: a tool runs into a workpiece, the black box writes a bag, and replay.launch gives the
// same contact and the same levels. The tool moves in real time, as the replay does.
#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <std_srvs/Trigger.h>
#include <sweep_guard/Contacts.h>
#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/Warning.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <optional>

#include "recording/object_contacts.h"
#include "replay_process.h"
#include "sweep_guard/common/warning_level.h"

namespace sweep_guard_session {
namespace {

namespace fs = std::filesystem;

constexpr double kRate = 100.0;     // [Hz] of the poses
constexpr double kRest = 3.0;       // [s] above the plate, longer than the window reaches back at first
constexpr double kHeight = 0.2;     // [m] of the tip at rest
constexpr double kSpeed = 0.1;      // [m/s]
constexpr double kDuration = 12.0;  // [s] of a motion down and up again, and a rest

sweep_guard::DeformableMesh plate() {
  sweep_guard::DeformableMesh mesh;
  mesh.header.stamp = ros::Time::now();
  mesh.header.frame_id = "world";
  mesh.id = "liver";
  mesh.open = 1;
  mesh.revision = 1;
  mesh.mesh.vertices.resize(4);
  for (int i = 0; i < 4; ++i) {
    mesh.mesh.vertices[static_cast<size_t>(i)].x = i == 1 || i == 2 ? 0.1 : -0.1;
    mesh.mesh.vertices[static_cast<size_t>(i)].y = i > 1 ? 0.1 : -0.1;
  }
  mesh.mesh.triangles.resize(2);
  mesh.mesh.triangles[0].vertex_indices = {0, 1, 2};
  mesh.mesh.triangles[1].vertex_indices = {0, 2, 3};
  return mesh;
}

// At rest, down to 2 cm below the plate, up again, at rest.
double heightAt(double time) {
  const double depth = kHeight + 0.02;
  const double moved = kSpeed * std::max(time - kRest, 0.0);
  return kHeight - (moved < depth ? moved : std::max(2.0 * depth - moved, 0.0));
}

geometry_msgs::PoseStamped poseAt(double time) {
  geometry_msgs::PoseStamped pose;
  pose.header.stamp = ros::Time::now();
  pose.header.frame_id = "world";
  pose.pose.position.z = heightAt(time);
  pose.pose.orientation.x = 1.0;
  return pose;
}

fs::path folder() { return ros::param::param<std::string>("black_box/folder", ""); }

std::optional<fs::path> recordedBag(const std::string& cause) {
  std::error_code none;
  for (const auto& file : fs::directory_iterator(folder(), none)) {
    const std::string name = file.path().filename();
    if (file.path().extension() == ".bag" && name.find(cause) != std::string::npos) return file.path();
  }
  return std::nullopt;
}

std::map<std::string, std::size_t> messagesIn(const fs::path& path) {
  const rosbag::Bag bag(path.string());
  std::map<std::string, std::size_t> messages;
  for (const rosbag::MessageInstance& message : rosbag::View(bag)) ++messages[message.getTopic()];
  return messages;
}

struct Session {
  double begin;
  std::map<double, int> levels;   // by the time at which each began, from the begin of the bag
  std::optional<double> contact;  // stamp of the first pose in contact
};

Session sessionIn(const fs::path& path) {
  const rosbag::Bag bag(path.string());
  rosbag::View all(bag);
  Session session{all.getBeginTime().toSec(), {}, {}};
  for (const rosbag::MessageInstance& message : all) {
    if (const auto warning = message.instantiate<sweep_guard::Warning>()) {
      const bool same = !session.levels.empty() && session.levels.rbegin()->second == warning->level;
      if (!same) session.levels[message.getTime().toSec() - session.begin] = warning->level;
    }
    const auto contacts = message.instantiate<sweep_guard::Contacts>();
    if (!contacts || session.contact) continue;
    for (const auto& object : contacts->objects) {
      if (sweep_guard_recording::isInContact(object)) session.contact = contacts->header.stamp.toSec();
    }
  }
  return session;
}

class BlackBoxReplayTest : public testing::Test {
 protected:
  ~BlackBoxReplayTest() override { fs::remove_all(folder()); }

  // The guard and the black box listen; nodelets of one manager are one subscriber.
  void SetUp() override {
    const auto subscribers = static_cast<std::uint32_t>(ros::param::param("~subscribers", 2));
    const auto deadline = ros::WallTime::now() + ros::WallDuration(20.0);
    while (poses_.getNumSubscribers() < subscribers || mesh_.getNumSubscribers() < subscribers) {
      ASSERT_LT(ros::WallTime::now(), deadline) << "the guard or the black box does not listen";
      ros::WallDuration(0.01).sleep();
    }
    mesh_.publish(plate());
  }

  // Ends when a recording with this cause is there, but moves at least for some time [s].
  void moveUntilRecorded(const std::string& cause, double duration) {
    ros::WallRate rate(kRate);
    double time = 0.0;
    for (; time < duration || !recordedBag(cause); time += 1.0 / kRate, rate.sleep()) {
      ASSERT_LT(time, 60.0) << "nothing was recorded";
      poses_.publish(poseAt(time));
    }
  }

  ros::NodeHandle node_;
  const ros::Publisher poses_ = node_.advertise<geometry_msgs::PoseStamped>("arm/measured_cp", 100);
  const ros::Publisher mesh_ = node_.advertise<sweep_guard::DeformableMesh>("liver/mesh", 1, /*latch=*/true);
};

TEST_F(BlackBoxReplayTest, AContactLeavesABagWhoseReplayHasTheSameContactAndLevels) {
  moveUntilRecorded("contact", kDuration);
  const fs::path bag = recordedBag("contact").value();
  const Session session = sessionIn(bag);
  ASSERT_TRUE(session.contact);
  const std::string printed = replayBag(bag, folder(), "");

  const auto contacts = readCsv(folder() / "report/contacts.csv");
  ASSERT_EQ(contacts.size(), 2U) << printed;
  EXPECT_EQ(contacts[1][4], "liver");
  const double replayed = std::stod(contacts[1][3]);
  EXPECT_LE(replayed, *session.contact + 1e-6);
  EXPECT_GE(replayed, *session.contact - 1.5 / kRate);

  const auto levels = readCsv(folder() / "report/levels.csv");
  std::map<std::string, double> begins;  // of each level, first in the replay
  for (size_t i = 1; i < levels.size(); ++i) begins.emplace(levels[i][2], std::stod(levels[i][0]));
  size_t compared = 0;
  std::map<int, double> recorded;
  for (const auto& [time, level] : session.levels) recorded.emplace(level, time);
  for (const auto& [level, time] : recorded) {
    if (level < sweep_guard::Warning::CONSIDERED) continue;
    const std::string name = sweep_guard_core::styleOf(static_cast<sweep_guard_core::WarningLevel>(level)).name;
    ASSERT_EQ(begins.count(name), 1U) << name << '\n' << printed;
    EXPECT_NEAR(begins[name], time, 0.1) << name;
    ++compared;
  }
  EXPECT_EQ(compared, 3U) << printed;
}

TEST_F(BlackBoxReplayTest, SaveWritesWithoutAContactWhatTheGuardHeardAndPublished) {
  std_srvs::Trigger save;
  ASSERT_TRUE(ros::service::waitForService("black_box/save", ros::Duration(20.0)));
  ASSERT_TRUE(ros::service::call("black_box/save", save));
  EXPECT_TRUE(save.response.success) << save.response.message;
  moveUntilRecorded("save", 0.0);
  std::map<std::string, std::size_t> messages = messagesIn(recordedBag("save").value());
  for (const char* const topic :
       {"/mesh", "/tool_pose", "/sweep_guard/warning", "/sweep_guard/contacts", "/sweep_guard/tool"}) {
    EXPECT_GT(messages[topic], 0U) << topic;
  }
}

}  // namespace
}  // namespace sweep_guard_session

int main(int argc, char** argv) {
  ros::init(argc, argv, "black_box_replay_test");
  testing::InitGoogleTest(&argc, argv);
  const ros::NodeHandle alive;
  return RUN_ALL_TESTS();
}
