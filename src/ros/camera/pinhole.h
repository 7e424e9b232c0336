#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <string_view>

#include "camera/depth_surface.h"
#include "ros/camera/depth_image.h"

namespace sweep_guard_ros {

/// Returns whether the name of a topic says that its images have no distortion: `image_rect` or another with `_rect`,
/// as image_proc and depth_image_proc call them. Not `image_rect_raw`: realsense2_camera calls its depth so whatever
/// it is.
bool isNamedRectified(std::string_view topic);

/// Returns the camera of a depth image: that of P, as depth_image_proc takes it.
///
/// image_proc publishes no camera_info for what it rectifies, and depth_image_proc that of the other camera as it is:
/// both have the distortion D of a raw image, and the P of the rectified one. Drivers that rectify nothing publish the
/// same D (aligned depth of a D405 or D455, Azure Kinect). So D says what the image is only where `rectified` does
/// not.
/// @param rectified  the image has no distortion whatever D says: isNamedRectified(), or the user knows
/// @throws sweep_guard_core::InvalidInput, saying what to publish, if the camera is not calibrated, P is not finite,
///     the image is distorted, of another size, binned or a part of it, or if P is that of the second camera of a pair
sweep_guard_core::Pinhole pinholeOf(const sensor_msgs::CameraInfo& info, ImageSize image, bool rectified);

}  // namespace sweep_guard_ros
