// Replays a bag whose only workpiece is what a depth camera above the tool has seen.
#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <tf2_msgs/TFMessage.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "refusal.h"
#include "replay_process.h"

namespace sweep_guard_session {
namespace {

namespace fs = std::filesystem;

constexpr double kCameraDuration = 4.0;  // [s]
constexpr double kTipHeight = 0.15;      // [m] of the tip above the table, at first
constexpr double kTipSpeed = 0.16;       // [m/s]; down for a second, and up again
constexpr double kMargin = 0.002;        // [m]
constexpr std::uint32_t kColumns = 64;
constexpr std::uint32_t kRows = 48;

std_msgs::Header headerAt(double t, const std::string& frame) {
  std_msgs::Header header;
  header.stamp = ros::Time(1000.0 + t);
  header.frame_id = frame;
  return header;
}

geometry_msgs::PoseStamped cameraToolAt(double t) {
  const double phase = std::fmod(t, 2.0);
  geometry_msgs::PoseStamped pose;
  pose.header = headerAt(t, "world");
  pose.pose.position.z = kTipHeight - kTipSpeed * std::min(phase, 2.0 - phase);
  pose.pose.orientation.x = 1.0;
  return pose;
}

// A table a meter below the camera.
sensor_msgs::Image imageAt(double t) {
  sensor_msgs::Image image;
  image.header = headerAt(t, "front_optical");
  image.encoding = "16UC1";
  image.width = kColumns;
  image.height = kRows;
  image.step = 2 * kColumns;
  const std::vector<std::uint16_t> depths(size_t{kColumns} * kRows, 1000);
  image.data.resize(2 * depths.size());
  std::memcpy(image.data.data(), depths.data(), image.data.size());
  return image;
}

sensor_msgs::CameraInfo infoAt(double t) {
  sensor_msgs::CameraInfo info;
  info.header = headerAt(t, "front_optical");
  info.width = kColumns;
  info.height = kRows;
  info.P = {60.0, 0.0, 31.5, 0.0, 0.0, 60.0, 23.5, 0.0, 0.0, 0.0, 1.0, 0.0};
  return info;
}

tf2_msgs::TFMessage mount() {
  tf2_msgs::TFMessage mount;
  mount.transforms.resize(1);
  mount.transforms[0].header = headerAt(0.0, "world");
  mount.transforms[0].child_frame_id = "front_optical";
  mount.transforms[0].transform.translation.z = 1.0;
  mount.transforms[0].transform.rotation.x = 1.0;
  return mount;
}

class ReplayCameraTest : public testing::Test {
 protected:
  ReplayCameraTest() : folder_(fs::path(testing::TempDir()) / ("replay_camera_test_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    std::ofstream(folder_ / "camera.yaml") << "cameras:\n  - {id: front, depth: front/depth/image_rect, margin: ["
                                           << kMargin << ", 0.0], timeout: 0.5, self_padding: 0.02}\n";
    rosbag::Bag bag((folder_ / "session.bag").string(), rosbag::bagmode::Write);
    bag.write("/tf_static", headerAt(0.0, "").stamp, mount());
    for (int i = 0; i < static_cast<int>(100 * kCameraDuration); ++i) {
      const double t = 0.01 * i;
      bag.write("/tool_pose", headerAt(t, "").stamp, cameraToolAt(t));
      if (i % 5 != 0) continue;
      bag.write("/front/depth/image_rect", headerAt(t, "").stamp, imageAt(t));
      bag.write("/front/depth/camera_info", headerAt(t, "").stamp, infoAt(t));
    }
  }
  ~ReplayCameraTest() override { fs::remove_all(folder_); }

  std::string replay() const {
    return replayBag(folder_ / "session.bag", folder_, "config:=" + (folder_ / "camera.yaml").string());
  }

  fs::path folder_;
};

TEST_F(ReplayCameraTest, TheCamerasOfTheConfigurationArePlayedAndTheirContactsReported) {
  const std::string printed = replay();
  EXPECT_TRUE(has(printed, "camera     front: 80 images on /front/depth/image_rect")) << printed;
  EXPECT_FALSE(has(printed, "missing    ")) << printed;
  const auto contacts = readCsv(folder_ / "report/contacts.csv");
  ASSERT_EQ(contacts.size(), 3U) << printed;
  for (size_t i = 1; i < contacts.size(); ++i) {
    EXPECT_EQ(contacts[i][4], "front");
    const double touch = 2.0 * static_cast<double>(i - 1) + (kTipHeight - kMargin) / kTipSpeed;
    EXPECT_NEAR(std::stod(contacts[i][1]), touch, 0.01) << printed;
  }
  const std::string levels = readText(folder_ / "report/levels.csv");
  EXPECT_TRUE(has(levels, "CLEAR") && has(levels, "REFLEX") && has(levels, "CONTACT")) << levels;
}

TEST_F(ReplayCameraTest, ACameraThatTheBagDoesNotHaveEndsItWithALineThatNamesIt) {
  std::ofstream(folder_ / "camera.yaml") << "cameras:\n  - {id: front, depth: /rear/depth/image_rect}\n";
  const std::string printed = replay();
  EXPECT_TRUE(has(printed, "no topic /rear/depth/image_rect, depth of camera 'front' must be sensor_msgs/Image"))
      << printed;
  EXPECT_TRUE(has(printed, "/front/depth/image_rect (sensor_msgs/Image)")) << printed;
  EXPECT_FALSE(fs::exists(folder_ / "report/contacts.csv"));
}

}  // namespace
}  // namespace sweep_guard_session
