#include "recording/bag.h"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <rosbag/message_instance.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "recording/bag_topic.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_recording {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::StampedPose;
using sweep_guard_ros::fromMsg;

namespace {

constexpr std::string_view kMagic = "#ROSBAG V";
const TopicChoice kPoses = {{"geometry_msgs/PoseStamped", "geometry_msgs/TransformStamped"},
                            "PoseStamped or TransformStamped",
                            "motion_topic:=TOPIC, or --topic of evaluate_prediction"};

struct FramedPose {
  std::string frames;
  StampedPose pose;
};

FramedPose read(const rosbag::MessageInstance& message) {
  if (const auto pose = message.instantiate<geometry_msgs::PoseStamped>()) {
    return {"'" + pose->header.frame_id + "'", {fromMsg(pose->header.stamp), fromMsg(pose->pose)}};
  }
  const auto transform = message.instantiate<geometry_msgs::TransformStamped>();
  if (!transform) throw InvalidInput("message cannot be read; record it again");
  return {"'" + transform->child_frame_id + "' in '" + transform->header.frame_id + "'",
          {fromMsg(transform->header.stamp), fromMsg(transform->transform)}};
}

void append(std::vector<StampedPose>* poses, std::string* frames, const FramedPose& next) {
  if (poses->empty()) *frames = next.frames;
  if (next.frames != *frames) {
    throw InvalidInput("frame is " + next.frames + ", was " + *frames + " before; record one frame per topic");
  }
  if (!poses->empty() && next.pose.stamp < poses->back().stamp) {
    throw InvalidInput("stamp is earlier than the previous one; give a bag of one run");
  }
  poses->push_back(next.pose);
}

}  // namespace

bool isBag(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;  // opening a pipe would wait
  std::array<char, kMagic.size()> begin{};
  std::ifstream(path, std::ios::binary).read(begin.data(), begin.size());
  return std::string_view(begin.data(), begin.size()) == kMagic;
}

std::vector<StampedPose> readBag(const std::string& path, const std::string& topic) {
  std::vector<StampedPose> poses;
  std::string frames;
  openBag(path, [&](const rosbag::Bag& bag) {
    forEachMessage(bag, chooseTopic(bag, topic, kPoses),
                   [&](const rosbag::MessageInstance& message) { append(&poses, &frames, read(message)); });
  });
  return poses;
}

}  // namespace sweep_guard_recording
