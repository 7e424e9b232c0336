#include "simulation/depth_recording.h"

#include <rosbag/view.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/frame_name.h"
#include "recording/bag.h"
#include "ros/camera/depth_topic.h"
#include "ros/camera/pinhole.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_simulation {

using sweep_guard_core::InvalidInput;

namespace {

constexpr std::uint32_t kStride = 6;  // pixels
constexpr float kStep = 0.05F;        // difference of depths, in parts of them

bool hasDepths(const rosbag::Bag& bag, const std::string& topic) {
  try {
    sweep_guard_ros::ImageSize size{};
    std::vector<float> depths;
    rosbag::View view(bag, rosbag::TopicQuery(topic));
    readImage(*view.begin(), size, depths);
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

// Up to the frame without a parent, or one met before.
std::string rootOf(const rosbag::Bag& bag, const std::string& frame) {
  const std::vector<std::string> topics = {"/tf", "/tf_static", "tf", "tf_static"};
  std::map<std::string, std::string> parents;
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery(topics))) {
    const auto transforms = message.instantiate<tf2_msgs::TFMessage>();
    if (!transforms) continue;
    for (const geometry_msgs::TransformStamped& transform : transforms->transforms)
      parents[sweep_guard_core::withoutSlash(transform.child_frame_id)] =
          sweep_guard_core::withoutSlash(transform.header.frame_id);
  }
  std::string root;
  for (auto next = parents.find(frame); next != parents.end(); next = parents.find(root)) {
    root = next->second;
    parents.erase(next);
  }
  return root;
}

}  // namespace

std_msgs::Header readImage(const rosbag::MessageInstance& message, sweep_guard_ros::ImageSize& size,
                           std::vector<float>& depths) {
  if (const auto image = message.instantiate<sensor_msgs::Image>()) {
    size = sweep_guard_ros::readDepths(*image, depths);
    return image->header;
  }
  const auto image = message.instantiate<sensor_msgs::CompressedImage>();
  if (!image) throw InvalidInput("message cannot be read; record it again");
  size = sweep_guard_ros::readDepths(*image, depths);
  return image->header;
}

DepthRecording inspectDepthBag(const rosbag::Bag& bag, const std::string& requested) {
  const sweep_guard_recording::TopicChoice depths = {
      {"sensor_msgs/Image", "sensor_msgs/CompressedImage"},
      "depth images (16UC1, 32FC1 or compressedDepth)",
      "depth_topic:=TOPIC",
      [&bag](const std::string& topic) { return hasDepths(bag, topic); }};
  DepthRecording recording;
  recording.topic = sweep_guard_recording::chooseTopic(bag, requested, depths);
  recording.info_topic = sweep_guard_ros::infoTopicOf(recording.topic);
  rosbag::View infos(bag, rosbag::TopicQuery(recording.info_topic));
  const auto info = infos.size() > 0 ? infos.begin()->instantiate<sensor_msgs::CameraInfo>() : nullptr;
  if (!info) throw InvalidInput("no camera_info on " + recording.info_topic + ": record it beside the images");
  rosbag::View view(bag, rosbag::TopicQuery(recording.topic));
  recording.frame = sweep_guard_core::withoutSlash(readImage(*view.begin(), recording.size, recording.depths).frame_id);
  recording.camera = pinholeOf(*info, recording.size, sweep_guard_ros::isNamedRectified(recording.topic));
  recording.info = *info;
  recording.info.header.stamp = {};
  recording.root = rootOf(bag, recording.frame);
  return recording;
}

VisibleSurface surfaceOf(const DepthRecording& recording) {
  const auto& [fx, fy, cx, cy] = recording.camera;
  const std::uint32_t columns = (recording.size.width - 1) / kStride + 1;
  const std::uint32_t rows = (recording.size.height - 1) / kStride + 1;
  VisibleSurface surface;
  const auto depth = [&](std::uint32_t i) {
    return recording.depths[size_t{i / columns} * kStride * recording.size.width + size_t{i % columns} * kStride];
  };
  for (std::uint32_t i = 0; i < columns * rows; ++i) {
    const double z = std::isnan(depth(i)) ? 0.0 : depth(i);
    const double u = i % columns * kStride;
    const std::uint32_t v = i / columns * kStride;
    for (const double coordinate : {(u - cx) / fx * z, (v - cy) / fy * z, z})
      surface.positions_S.push_back(static_cast<float>(coordinate));
  }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto [nearest, farthest] = std::minmax({depth(a), depth(b), depth(c)});
    const bool seen = !std::isnan(depth(a) + depth(b) + depth(c));
    if (seen && farthest - nearest < kStep * nearest) surface.triangles.push_back({a, b, c});
  };
  for (std::uint32_t i = 0; i + columns + 1 < columns * rows; ++i) {
    if (i % columns + 1 == columns) continue;
    add(i, i + 1, i + columns);
    add(i + 1, i + columns + 1, i + columns);
  }
  if (surface.triangles.empty())
    throw InvalidInput("the first image shows no surface; give a bag that begins with one");
  return surface;
}

}  // namespace sweep_guard_simulation
