#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <string_view>

#include "camera/depth_surface.h"
#include "ros/camera/depth_image.h"

namespace sweep_guard_ros {

/// Returns whether an image has no distortion according to the name of its topic: as of image_proc and depth_image_proc it ends in
/// image_rect or ..._rect_..., and not in ..._raw (realsense2_camera calls all depth image_rect_raw, also where it is not).
bool isNamedRectified(std::string_view topic);

/// Returns the camera of a depth image: from P, as depth_image_proc takes it.
///
/// Nodes that rectify publish no camera_info: that beside their image is the one of the raw image, with its distortion D and with
/// the P that they rectify to. Drivers that rectify nothing give the same D. So camera_info cannot tell the two apart.
/// @param rectified  the image has no distortion, so D does not count
/// @throws sweep_guard_core::InvalidInput, saying what to publish, if the camera is not calibrated, P is not finite, the image
///     is distorted, of another size, binned or a part of it, or if P is that of the second camera of a pair
sweep_guard_core::Pinhole pinholeOf(const sensor_msgs::CameraInfo& info, ImageSize image, bool rectified);

}  // namespace sweep_guard_ros
