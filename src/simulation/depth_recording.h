#pragma once

#include <rosbag/bag.h>
#include <rosbag/message_instance.h>
#include <sensor_msgs/CameraInfo.h>

#include <string>
#include <vector>

#include "camera/pinhole.h"
#include "ros/camera/depth_image.h"
#include "simulation/depth_renderer.h"

namespace sweep_guard_simulation {

/// Depth images in a rosbag.
struct DepthRecording {
  std::string topic;                 ///< of the images
  std::string info_topic;            ///< of the camera_info beside them
  std::string frame;                 ///< of the first image
  std::string root;                  ///< the frame that tf in the bag places `frame` in at last; empty: it does not
  sweep_guard_ros::ImageSize size;   ///< of the first image
  sensor_msgs::CameraInfo info;      ///< the first, without its stamp
  sweep_guard_core::Pinhole camera;  ///< the same
  std::vector<float> depths;         ///< of the first image [m], row by row; NaN: nothing seen
};

/// Reads the first depth image of a bag, and what there is to place it.
/// @param requested  topic of the images; empty: the only one with depths
/// @throws sweep_guard_core::InvalidInput that says what is missing: no depth images, several topics of them (the message lists
///     them), no camera_info, or one that pinholeOf() refuses
DepthRecording inspectDepthBag(const rosbag::Bag& bag, const std::string& requested);

/// Reads an image of a recording.
/// @param[out] depths  [m], as readDepths() has them
/// @return its header
/// @throws sweep_guard_core::InvalidInput if it is none, or readDepths() refuses it
std_msgs::Header readImage(const rosbag::MessageInstance& message, sweep_guard_ros::ImageSize& size,
                           std::vector<float>& depths);

/// Returns a coarse surface of the first image, in the camera's optical frame: without the steps from one thing to what is behind it.
/// @throws sweep_guard_core::InvalidInput if it shows none
VisibleSurface surfaceOf(const DepthRecording& recording);

}  // namespace sweep_guard_simulation
