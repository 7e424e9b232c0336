#pragma once

#include <ros/names.h>

#include <string>

namespace sweep_guard_ros {

/// Returns whether a topic is of sensor_msgs/CompressedImage, as compressed_depth_image_transport publishes depth images.
inline bool isCompressedDepth(const std::string& topic) {
  const std::string suffix = "/compressedDepth";
  return topic.size() > suffix.size() && topic.compare(topic.size() - suffix.size(), suffix.size(), suffix) == 0;
}

/// Returns the topic of the camera_info beside depth images, as image_transport has it.
inline std::string infoTopicOf(const std::string& topic) {
  const std::string images = isCompressedDepth(topic) ? ros::names::parentNamespace(topic) : topic;
  return ros::names::append(ros::names::parentNamespace(images), "camera_info");
}

}  // namespace sweep_guard_ros
