#include "recording/bag.h"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <rosbag/message_instance.h>
#include <rosbag/view.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <set>
#include <string_view>

#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_recording {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::StampedPose;
using sweep_guard_ros::fromMsg;

namespace {

std::string joinNames(const std::set<std::string>& topics) {
  std::string list;
  for (const std::string& topic : topics) list += (list.empty() ? "" : ", ") + topic;
  return list;
}

std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

constexpr std::string_view kMagic = "#ROSBAG V";
const TopicChoice kPoses = {{"geometry_msgs/PoseStamped", "geometry_msgs/TransformStamped"},
                            "PoseStamped or TransformStamped",
                            "motion_topic:=TOPIC, or --topic of evaluate_prediction"};

StampedPose read(const rosbag::MessageInstance& message, std::string& frames) {
  if (const auto pose = message.instantiate<geometry_msgs::PoseStamped>()) {
    frames = "'" + pose->header.frame_id + "'";
    return {fromMsg(pose->header.stamp), fromMsg(pose->pose)};
  }
  const auto transform = message.instantiate<geometry_msgs::TransformStamped>();
  if (!transform) throw InvalidInput("message cannot be read; record it again");
  frames = "'" + transform->child_frame_id + "' in '" + transform->header.frame_id + "'";
  return {fromMsg(transform->header.stamp), fromMsg(transform->transform)};
}

void append(const rosbag::MessageInstance& message, std::vector<StampedPose>& poses, std::string& frames) {
  const std::string before = frames;
  const StampedPose next = read(message, frames);
  if (!poses.empty() && frames != before) {
    throw InvalidInput("frame is " + frames + ", was " + before + " before; record one frame per topic");
  }
  if (!poses.empty() && next.stamp < poses.back().stamp) {
    throw InvalidInput("stamp is earlier than the previous one; give a bag of one run");
  }
  poses.push_back(next);
}

const TopicChoice kJoints = {{"sensor_msgs/JointState"}, "sensor_msgs/JointState", "joints_topic:=TOPIC"};

}  // namespace

std::string chooseTopic(const rosbag::Bag& bag, const std::string& requested, const TopicChoice& choice) {
  std::set<std::string> topics;
  for (const rosbag::ConnectionInfo* connection : rosbag::View(bag, rosbag::TypeQuery(choice.types)).getConnections()) {
    if (!choice.fits || choice.fits(connection->topic)) topics.insert(connection->topic);
  }
  if (topics.empty()) throw InvalidInput("no " + choice.what + " in the bag; record one of them");
  if (!requested.empty() && topics.count(requested) == 0) {
    throw InvalidInput("no " + choice.what + " on " + requested + "; there are: " + joinNames(topics));
  }
  if (requested.empty() && topics.size() != 1) {
    throw InvalidInput("choose one topic (" + choice.how + "); there are: " + joinNames(topics));
  }
  return requested.empty() ? *topics.begin() : requested;
}

void openBag(const std::string& path, const std::function<void(const rosbag::Bag&)>& read) {
  try {
    read(rosbag::Bag(path));
  } catch (const InvalidInput& error) {
    throw InvalidInput(path + ": " + error.what());
  } catch (const rosbag::BagUnindexedException&) {
    throw InvalidInput(path + ": the bag has no index; run rosbag reindex on it");
  } catch (const std::exception& error) {  // of rosbag or ROS, or no memory for the size in a broken header
    throw InvalidInput(path + ": the bag is broken: " + firstLine(error.what()));
  }
}

void forEachMessage(const rosbag::Bag& bag, const std::string& topic,
                    const std::function<void(const rosbag::MessageInstance&)>& read) {
  std::size_t count = 0;
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery(topic))) {
    ++count;
    try {
      read(message);
    } catch (const InvalidInput& error) {
      throw InvalidInput(topic + ", message " + std::to_string(count) + ": " + error.what());
    }
  }
  if (count == 0) throw InvalidInput("no message on " + topic);
}

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
                   [&](const rosbag::MessageInstance& message) { append(message, poses, frames); });
  });
  return poses;
}

void readJointBag(const std::string& path, const std::string& topic,
                  const std::function<void(const std::string& publisher, const sensor_msgs::JointState&)>& read) {
  openBag(path, [&](const rosbag::Bag& bag) {
    forEachMessage(bag, chooseTopic(bag, topic, kJoints), [&](const rosbag::MessageInstance& message) {
      const auto joints = message.instantiate<sensor_msgs::JointState>();
      if (!joints) throw sweep_guard_core::InvalidInput("message cannot be read; record it again");
      read(message.getCallerId(), *joints);
    });
  });
}

}  // namespace sweep_guard_recording
