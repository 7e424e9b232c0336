#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <cstdint>
#include <vector>

namespace sweep_guard_ros {

/// The size of an image [pixels].
struct ImageSize {
  std::uint32_t width;
  std::uint32_t height;
};

/// Reads a depth image as REP 118 has it: 16UC1, which some call mono16, in mm, with 0 or 65535 where nothing was
/// seen; or 32FC1 in m, where only what is above 0 and finite was seen.
/// @param[out] depths  z of each pixel [m], row by row, NaN where nothing was seen. What the buffer held is lost, even
///     if the image is refused; nothing is allocated unless the image is larger than those before
/// @throws sweep_guard_core::InvalidInput, saying what to publish, if the encoding is another one, if the image is
///     empty or has more pixels than a Grid may have, or if a row is longer than its step or missing in the data
ImageSize readDepths(const sensor_msgs::Image& image, std::vector<float>& depths);

/// Reads a depth image that compressed_depth_image_transport has packed as PNG. The values of a packed 32FC1 image are
/// inverse depths: by default that package rounds them by up to depth^2 / 10100, and writes larger depths in place of those
/// below 0.154 m. libpng allocates some 60 kB for the time of the call.
/// @param[out] depths  as above
/// @throws sweep_guard_core::InvalidInput, saying what to publish, if the image is packed otherwise (RVL, the topic
///     `compressed`), if the PNG is not as sizeOfGrayPng() and readGrayPng() want it, or if the numbers that scale
///     inverse depths are unusable
ImageSize readDepths(const sensor_msgs::CompressedImage& image, std::vector<float>& depths);

}  // namespace sweep_guard_ros
