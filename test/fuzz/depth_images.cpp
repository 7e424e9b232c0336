// Depth images and cameras. An input is the kind of message in its first byte, then the numbers of the message, its
// words, each up to a byte 0, and its data. Kind 2 is kind 1 with the checksums of its PNG made right: what is behind
// them is reached.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "require.h"
#include "ros/camera/depth_image.h"
#include "ros/camera/pinhole.h"
#include "sweep_guard/common/error.h"
#include "target.h"

namespace sweep_guard_fuzz {
namespace {

using sweep_guard_core::InvalidInput;
using sweep_guard_ros::ImageSize;
using sweep_guard_ros::readDepths;
using Bytes = std::vector<std::uint8_t>;

constexpr size_t kChunksAt = 20;    // behind the signature
constexpr size_t kMaxDepths = 516;  // per byte: two bits of a PNG make 258 bytes

std::uint32_t checksumOf(const std::uint8_t* bytes, size_t count) {
  std::uint32_t sum = 0xFFFFFFFFU;
  for (; count > 0; --count) {
    sum ^= *bytes++;
    for (int bit = 0; bit < 8; ++bit) sum = sum >> 1U ^ (sum & 1U) * 0xEDB88320U;
  }
  return ~sum;
}

void repairChecksums(Bytes& data) {
  const auto numberAt = [&](size_t at) {
    return size_t{data[at]} << 24U | size_t{data[at + 1]} << 16U | size_t{data[at + 2]} << 8U | data[at + 3];
  };
  for (size_t at = kChunksAt; at + 12 <= data.size();) {
    const size_t end = at + 8 + numberAt(at);
    if (end + 4 > data.size()) return;
    const std::uint32_t sum = checksumOf(&data[at + 4], end - at - 4);
    for (size_t i = 0; i < 4; ++i) data[end + i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i));
    at = end + 4;
  }
}

Bytes dataIn(Input& input) {
  const std::string rest = input.rest();
  return {rest.begin(), rest.end()};
}

// Reads twice: what is in the buffer, and how much, must not matter.
template <typename Message>
void readImage(const Message& image) {
  std::vector<float> depths;
  std::vector<float> again(3, 1.0F);
  try {
    const ImageSize size = readDepths(image, depths);
    readDepths(image, again);
    require(depths.size() == size_t{size.width} * size.height && !depths.empty(), "each pixel has a depth");
    require(std::all_of(depths.begin(), depths.end(),
                        [](float z) { return std::isnan(z) || (z > 0.0F && std::isfinite(z)); }),
            "a depth is above 0 and finite, or NaN");
    require(std::equal(depths.begin(), depths.end(), again.begin(), again.end(),
                       [](float z, float other) { return z == other || (std::isnan(z) && std::isnan(other)); }),
            "the same image has the same depths");
  } catch (const InvalidInput& error) {
    require(error.what()[0] != 0, "a refusal has words");
  }
  require(depths.capacity() <= kMaxDepths * image.data.size(), "what is allocated is bounded by what has come");
}

void readPlain(Input input) {
  sensor_msgs::Image image;
  image.width = input.raw<std::uint16_t>();
  image.height = input.raw<std::uint16_t>();
  image.step = input.raw<std::uint32_t>();
  image.is_bigendian = input.raw<std::uint8_t>();
  image.encoding = input.word();
  image.data = dataIn(input);
  readImage(image);
}

void readPacked(Input input, bool repairs) {
  sensor_msgs::CompressedImage image;
  image.format = input.word();
  image.data = dataIn(input);
  if (repairs) repairChecksums(image.data);
  readImage(image);
}

void readCamera(Input input) {
  sensor_msgs::CameraInfo info;
  const ImageSize image{input.raw<std::uint32_t>(), input.raw<std::uint32_t>()};
  const bool rectified = input.flag();
  for (std::uint32_t* const number : {&info.width, &info.height, &info.binning_x, &info.binning_y, &info.roi.x_offset,
                                      &info.roi.y_offset, &info.roi.width, &info.roi.height})
    *number = input.raw<std::uint32_t>();
  for (double& number : info.P) number = input.raw<double>();
  info.distortion_model = input.word();
  while (!input.atEnd()) info.D.push_back(input.raw<double>());
  try {
    const auto camera = sweep_guard_ros::pinholeOf(info, image, rectified);
    require(camera.fx > 0.0 && camera.fy > 0.0, "a camera has a focal length");
    require(
        std::isfinite(camera.fx) && std::isfinite(camera.fy) && std::isfinite(camera.cx) && std::isfinite(camera.cy),
        "a camera is finite");
  } catch (const InvalidInput& error) {
    require(error.what()[0] != 0, "a refusal has words");
  }
}

void run(Input input) {
  const int kind = input.below(4);
  if (kind == 0) return readPlain(input);
  if (kind == 3) return readCamera(input);
  readPacked(input, /*repairs=*/kind == 2);
}

const Target kDepthImages("depth_images", run);

}  // namespace
}  // namespace sweep_guard_fuzz
