#include "simulation/depth_recording.h"

#include <gtest/gtest.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>

#include "refusal.h"
#include "test_file.h"

namespace sweep_guard_simulation {
namespace {

constexpr std::uint32_t kWidth = 60;
constexpr std::uint32_t kHeight = 36;

class DepthRecordingTest : public testing::Test {
 protected:
  DepthRecordingTest() : path_(sweep_guard_core::testFile(".bag")), bag_(path_, rosbag::bagmode::Write) {}
  ~DepthRecordingTest() override { std::filesystem::remove(path_); }

  // The left half at 1 m, the right half at 2 m.
  void writeImage(const std::string& topic, const std::string& encoding = "16UC1") {
    sensor_msgs::Image image;
    image.header.frame_id = "camera";
    image.encoding = encoding;
    image.width = kWidth;
    image.height = kHeight;
    image.step = 2 * kWidth;
    for (std::uint32_t i = 0; i < kWidth * kHeight; ++i) {
      const std::uint16_t depth = i % kWidth < kWidth / 2 ? 1000 : 2000;
      image.data.push_back(static_cast<std::uint8_t>(depth & 0xFFU));
      image.data.push_back(static_cast<std::uint8_t>(depth >> 8U));
    }
    bag_.write(topic, ros::Time(100.0), image);
  }
  void writeInfo(const std::string& topic, std::uint32_t width = kWidth) {
    sensor_msgs::CameraInfo info;
    info.width = width;
    info.height = kHeight;
    info.P = {50.0, 0.0, 29.5, 0.0, 0.0, 50.0, 17.5, 0.0, 0.0, 0.0, 1.0, 0.0};
    bag_.write(topic, ros::Time(100.0), info);
  }
  void writeTransform(const std::string& parent, const std::string& child) {
    tf2_msgs::TFMessage message;
    message.transforms.resize(1);
    message.transforms[0].header.frame_id = parent;
    message.transforms[0].child_frame_id = child;
    bag_.write("/tf_static", ros::Time(100.0), message);
  }

  DepthRecording inspect(const std::string& topic = "") {
    bag_.close();
    return inspectDepthBag(rosbag::Bag(path_), topic);
  }
  std::string refusalOf(const std::string& topic = "") {
    return refusal([&] { inspect(topic); });
  }

  std::string path_;
  rosbag::Bag bag_;
};

TEST_F(DepthRecordingTest, TheOnlyTopicWithDepthsIsTakenAndItsCameraPlacedByTf) {
  writeImage("/color/image_raw", "rgb8");
  writeImage("/depth/image_rect");
  writeInfo("/depth/camera_info");
  writeTransform("mount", "/camera");
  writeTransform("base", "mount");
  const DepthRecording recording = inspect();
  EXPECT_EQ(recording.topic, "/depth/image_rect");
  EXPECT_EQ(recording.frame, "camera");
  EXPECT_EQ(recording.root, "base");
  EXPECT_EQ(recording.size.width, kWidth);
  EXPECT_FLOAT_EQ(recording.depths.front(), 1.0F);
}

TEST_F(DepthRecordingTest, ACameraThatTfDoesNotPlaceHasNoRoot) {
  writeImage("/depth/image_rect");
  writeInfo("/depth/camera_info");
  EXPECT_EQ(inspect().root, "");
}

TEST_F(DepthRecordingTest, ItsSurfaceHasNoTrianglesAcrossAStep) {
  writeImage("/depth/image_rect");
  writeInfo("/depth/camera_info");
  const VisibleSurface surface = surfaceOf(inspect());
  ASSERT_FALSE(surface.triangles.empty());
  for (const auto& triangle : surface.triangles) {
    for (const std::uint32_t corner : triangle)
      EXPECT_EQ(surface.positions_S[3 * corner + 2], surface.positions_S[3 * triangle[0] + 2]);
  }
}

TEST_F(DepthRecordingTest, SaysThatNoTopicHasDepths) {
  writeImage("/color/image_raw", "rgb8");
  EXPECT_TRUE(has(refusalOf(), "no depth images (16UC1, 32FC1 or compressedDepth) in the bag"));
}

TEST_F(DepthRecordingTest, ListsSeveralTopicsWithDepths) {
  for (const std::string camera : {"/front", "/rear"}) writeImage(camera + "/image_rect");
  const std::string text = refusalOf();
  EXPECT_TRUE(has(text, "choose one topic (depth_topic:=TOPIC); there are: /front/image_rect, /rear/image_rect"))
      << text;
}

TEST_F(DepthRecordingTest, ListsTheTopicsWithDepthsIfAnotherWasAskedFor) {
  writeImage("/color/image_raw", "rgb8");
  writeImage("/depth/image_rect");
  EXPECT_TRUE(has(refusalOf("/color/image_raw"), " on /color/image_raw; there are: /depth/image_rect"));
}

TEST_F(DepthRecordingTest, NamesTheTopicOfTheCameraInfoThatIsMissing) {
  writeImage("/depth/image_rect");
  EXPECT_TRUE(has(refusalOf(), "no camera_info on /depth/camera_info"));
}

TEST_F(DepthRecordingTest, ACameraInfoOfAnotherSizeIsRefused) {
  writeImage("/depth/image_rect");
  writeInfo("/depth/camera_info", 2 * kWidth);
  EXPECT_TRUE(has(refusalOf(), "of another size"));
}

}  // namespace
}  // namespace sweep_guard_simulation
