#include "ros/camera/depth_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "ros/camera/gray_png.h"
#include "ros/connection/wire.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/geometry/grid.h"

namespace sweep_guard_ros {
namespace {

using std::to_string;
using sweep_guard_core::Grid;
using sweep_guard_core::printable;

constexpr float kNotSeen = std::numeric_limits<float>::quiet_NaN();
constexpr size_t kPackedAt = 12;  // [byte]; before it: a number that says nothing, a and b of inverse depths

[[noreturn]] void refuseImage(const std::string& problem) {
  throw sweep_guard_core::InvalidInput("depth image " + problem);
}

bool isMillimeters(const std::string& encoding) { return encoding == "16UC1" || encoding == "mono16"; }
bool isMeters(const std::string& encoding) { return encoding == "32FC1"; }

// Objects are inlined where functions are not. Without a branch around the multiplication it is vectorized.
constexpr auto kFromMillimeters = [](std::int32_t value) {
  return static_cast<float>(value) * (value != 0 && value != 65535 ? 0.001F : kNotSeen);
};
constexpr auto kFromMeters = [](float z) { return z > 0.0F && z <= std::numeric_limits<float>::max() ? z : kNotSeen; };

size_t pixelsOf(ImageSize size) {
  const std::uint64_t count = std::uint64_t{size.width} * size.height;
  if (count > 0 && count <= Grid::kMaxPixels) return count;
  refuseImage("has " + to_string(size.width) + " x " + to_string(size.height) + " pixels: at least one, and at most " +
              to_string(Grid::kMaxPixels) + " are read");
}

template <typename Number>
Number swappedAt(const std::uint8_t* bytes) {
  std::array<std::uint8_t, sizeof(Number)> swapped;
  std::reverse_copy(bytes, bytes + sizeof(Number), swapped.begin());
  return numberAt<Number>(swapped.data());
}

// What is read may be the end of what is written: nothing is overwritten before it is read.
template <typename Number, Number (*kNumberAt)(const std::uint8_t*), typename Convert>
void convertRow(const std::uint8_t* bytes, size_t count, Convert convert, float* depths) {
  for (size_t i = 0; i < count; ++i) depths[i] = convert(kNumberAt(bytes + i * sizeof(Number)));
}

void requireRows(const sensor_msgs::Image& image, size_t row_size) {
  if (image.step < row_size)
    refuseImage("has a step of " + to_string(image.step) + " bytes, but a row takes " + to_string(row_size));
  if (image.data.size() / image.step >= image.height) return;
  refuseImage("is cut off: " + to_string(image.height) + " rows of " + to_string(image.step) +
              " bytes are announced, " + to_string(image.data.size()) + " bytes are there");
}

template <typename Number, typename Convert>
ImageSize convertRows(const sensor_msgs::Image& image, Convert convert, std::vector<float>& depths) {
  const size_t count = pixelsOf({image.width, image.height});
  requireRows(image, image.width * sizeof(Number));
  depths.resize(count);
  const auto convert_row = image.is_bigendian != 0 ? convertRow<Number, swappedAt<Number>, Convert>
                                                   : convertRow<Number, numberAt<Number>, Convert>;
  for (size_t v = 0; v < image.height; ++v)
    convert_row(&image.data[v * image.step], image.width, convert, &depths[v * image.width]);
  return {image.width, image.height};
}

// A pixel of the PNG takes half of the bytes of a depth.
template <typename Convert>
ImageSize unpack(Wire png, Convert convert, std::vector<float>& depths) {
  const ImageSize size = sizeOfGrayPng(png);
  depths.resize(pixelsOf(size));
  std::uint8_t* const pixels = reinterpret_cast<std::uint8_t*>(depths.data()) + 2 * depths.size();
  readGrayPng(png, pixels);
  convertRow<std::uint16_t, numberAt<std::uint16_t>>(pixels, depths.size(), convert, depths.data());
  return size;
}

void requirePacking(const std::string& format, const std::string& encoding) {
  const std::string packing = format.substr(encoding.size());
  const bool known = packing.empty() || packing == "; compressedDepth" || packing == "; compressedDepth png";
  if (known && (isMillimeters(encoding) || isMeters(encoding))) return;
  refuseImage("is packed as '" + printable(format) + "': " +
              (packing == "; compressedDepth rvl"
                   ? "set .../compressedDepth/format of its publisher to png"
                   : "take the topic .../compressedDepth of an image that is 16UC1 [mm] or 32FC1 [m]"));
}

}  // namespace

ImageSize readDepths(const sensor_msgs::Image& image, std::vector<float>& depths) {
  if (isMillimeters(image.encoding)) return convertRows<std::uint16_t>(image, kFromMillimeters, depths);
  if (isMeters(image.encoding)) return convertRows<float>(image, kFromMeters, depths);
  refuseImage("is encoded as '" + printable(image.encoding) + "': publish 16UC1 [mm] or 32FC1 [m], as REP 118 says");
}

ImageSize readDepths(const sensor_msgs::CompressedImage& image, std::vector<float>& depths) {
  const std::string encoding = image.format.substr(0, image.format.find(';'));
  requirePacking(image.format, encoding);
  if (image.data.size() < kPackedAt) refuseImage("is cut off: it has " + to_string(image.data.size()) + " bytes");
  const std::uint8_t* const bytes = image.data.data();
  const Wire png{bytes + kPackedAt, image.data.size() - kPackedAt};
  if (isMillimeters(encoding)) return unpack(png, kFromMillimeters, depths);
  const auto a = numberAt<float>(bytes + 4);
  const auto b = numberAt<float>(bytes + 8);
  if (!(a > 0.0F) || !std::isfinite(a) || !std::isfinite(b))
    refuseImage("has inverse depths that are scaled by " + to_string(a) + " and " + to_string(b));
  return unpack(
      png,
      [=](std::uint16_t value) { return value == 0 ? kNotSeen : kFromMeters(a / (static_cast<float>(value) - b)); },
      depths);
}

}  // namespace sweep_guard_ros
