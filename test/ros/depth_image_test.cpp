// Depths are those of the image, what was not seen is NaN, and an image that is not as announced is refused in words.
#include "ros/camera/depth_image.h"

#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "allocations.h"
#include "data_path.h"
#include "refusal.h"
#include "sweep_guard/geometry/grid.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Allocations;
using sweep_guard_core::Grid;
using Bytes = std::vector<std::uint8_t>;
using Values = std::vector<std::uint16_t>;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr size_t kDepthHeader = 12;

template <typename Number>
void append(const std::vector<Number>& numbers, Bytes& bytes) {
  const auto* const begin = reinterpret_cast<const std::uint8_t*>(numbers.data());
  bytes.insert(bytes.end(), begin, begin + numbers.size() * sizeof(Number));
}

template <typename Number>
sensor_msgs::Image depthImage(const std::string& encoding, std::uint32_t width, const std::vector<Number>& values) {
  sensor_msgs::Image image;
  image.encoding = encoding;
  image.width = width;
  image.height = static_cast<std::uint32_t>(values.size()) / width;
  image.step = width * static_cast<std::uint32_t>(sizeof(Number));
  append(values, image.data);
  return image;
}

template <typename Number>
sensor_msgs::Image bigEndian(sensor_msgs::Image image) {
  image.is_bigendian = 1;
  for (auto at = image.data.begin(); at != image.data.end(); at += sizeof(Number))
    std::reverse(at, at + sizeof(Number));
  return image;
}

// Puts `padding` bytes behind each row.
sensor_msgs::Image padded(sensor_msgs::Image image, std::uint32_t padding) {
  Bytes data;
  for (auto row = image.data.begin(); row != image.data.end(); row += image.step) {
    data.insert(data.end(), row, row + image.step);
    data.insert(data.end(), padding, 0xAB);
  }
  image.step += padding;
  image.data = data;
  return image;
}

template <typename Message>
std::vector<float> depthsOf(const Message& image) {
  std::vector<float> depths;
  const ImageSize size = readDepths(image, depths);
  EXPECT_EQ(depths.size(), size_t{size.width} * size.height);
  return depths;
}

template <typename Message>
std::string refusedDepths(const Message& image) {
  std::vector<float> depths;
  return refusal([&] { readDepths(image, depths); });
}

testing::AssertionResult same(const std::vector<float>& depths, const std::vector<float>& expected) {
  if (depths.size() != expected.size()) return testing::AssertionFailure() << depths.size() << " depths";
  for (size_t i = 0; i < depths.size(); ++i) {
    const bool equal =
        std::isnan(expected[i]) ? std::isnan(depths[i]) : std::abs(depths[i] - expected[i]) < 1e-6F * expected[i];
    if (!equal) return testing::AssertionFailure() << depths[i] << " in place of " << expected[i] << " at " << i;
  }
  return testing::AssertionSuccess();
}

const Values kMillimeters = {1, 1500, 0, 65535, 65534, 800};
const std::vector<float> kMeters = {0.001F, 1.5F, kNaN, kNaN, 65.534F, 0.8F};

TEST(DepthImageTest, ReadsMillimetersOfWhich0And65535AreNothing) {
  EXPECT_TRUE(same(depthsOf(depthImage("16UC1", 3, kMillimeters)), kMeters));
}

TEST(DepthImageTest, ReadsMono16AsMillimeters) {
  EXPECT_TRUE(same(depthsOf(depthImage("mono16", 2, kMillimeters)), kMeters));
}

TEST(DepthImageTest, ReadsMetersOfWhichOnlyWhatIsFiniteAndAbove0IsSeen) {
  const std::vector<float> meters = {0.25F, kNaN, kInf, -kInf, 0.0F, -0.0F, -1.0F, 4.0F};
  EXPECT_TRUE(same(depthsOf(depthImage("32FC1", 4, meters)), {0.25F, kNaN, kNaN, kNaN, kNaN, kNaN, kNaN, 4.0F}));
}

TEST(DepthImageTest, AnImageOfNothingHasNoDepths) {
  const std::vector<float> nothing(12, kNaN);
  EXPECT_TRUE(same(depthsOf(depthImage("32FC1", 4, nothing)), nothing));
  EXPECT_TRUE(same(depthsOf(depthImage("32FC1", 4, std::vector<float>(12, 0.0F))), nothing));
  EXPECT_TRUE(same(depthsOf(depthImage("16UC1", 4, Values(12, 0))), nothing));
  EXPECT_TRUE(same(depthsOf(depthImage("16UC1", 4, Values(12, 65535))), nothing));
}

TEST(DepthImageTest, ReadsBothByteOrders) {
  const std::vector<float> meters = {0.25F, 4.0F};
  EXPECT_TRUE(same(depthsOf(bigEndian<std::uint16_t>(depthImage("16UC1", 3, kMillimeters))), kMeters));
  EXPECT_TRUE(same(depthsOf(bigEndian<float>(depthImage("32FC1", 1, meters))), meters));
}

TEST(DepthImageTest, PassesOverWhatFollowsARow) {
  const std::vector<float> meters = {0.25F, 4.0F, 0.5F, 2.0F};
  for (const std::uint32_t padding : {1U, 2U, 7U, 64U}) {
    EXPECT_TRUE(same(depthsOf(padded(depthImage("16UC1", 3, kMillimeters), padding)), kMeters)) << padding;
    EXPECT_TRUE(same(depthsOf(padded(depthImage("32FC1", 2, meters), padding)), meters)) << padding;
  }
}

TEST(DepthImageTest, RefusesOtherEncodingsByNameAndSaysWhatToPublish) {
  for (const char* const encoding : {"rgb8", "mono8", "8UC1", "16SC1", "32FC3", "64FC1", "16uc1", ""}) {
    const std::string refused = refusedDepths(depthImage(encoding, 3, kMillimeters));
    EXPECT_TRUE(has(refused, "encoded as '" + std::string(encoding) + "': publish 16UC1 [mm] or 32FC1 [m]"));
  }
}

TEST(DepthImageTest, RefusesAStepThatIsShorterThanARow) {
  auto image = depthImage("16UC1", 3, kMillimeters);
  image.step = 5;
  EXPECT_EQ(refusedDepths(image), "depth image has a step of 5 bytes, but a row takes 6");
  image.step = 0;
  EXPECT_EQ(refusedDepths(image), "depth image has a step of 0 bytes, but a row takes 6");
  EXPECT_TRUE(has(refusedDepths(depthImage("32FC1", 3, kMillimeters)), "a row takes 12"));
}

TEST(DepthImageTest, RefusesLessDataThanStepTimesHeight) {
  auto image = padded(depthImage("16UC1", 3, kMillimeters), 2);
  image.data.pop_back();
  EXPECT_EQ(refusedDepths(image), "depth image is cut off: 2 rows of 8 bytes are announced, 15 bytes are there");
  image.data.clear();
  EXPECT_TRUE(has(refusedDepths(image), "0 bytes are there"));
}

TEST(DepthImageTest, RefusesAnImageWithoutPixels) {
  auto image = depthImage("16UC1", 3, kMillimeters);
  image.width = 0;
  EXPECT_TRUE(has(refusedDepths(image), "has 0 x 2 pixels"));
  image.step = 0;
  image.height = 0;
  EXPECT_TRUE(has(refusedDepths(image), "has 0 x 0 pixels"));
  image.width = 3;
  EXPECT_TRUE(has(refusedDepths(image), "has 3 x 0 pixels"));
}

TEST(DepthImageTest, RefusesMorePixelsThanAGridMayHave) {
  auto image = depthImage("16UC1", 3, kMillimeters);
  for (const std::uint32_t size : {2897U, 65536U, 0xFFFFFFFFU}) {
    image.width = image.height = size;
    EXPECT_TRUE(has(refusedDepths(image), "at most 8388608 are read"));
  }
}

TEST(DepthImageTest, AllocatesNothingForTheNextImage) {
  std::vector<float> depths;
  const auto millimeters = depthImage("16UC1", 640, Values(size_t{640} * 480, 700));
  const auto meters = depthImage("32FC1", 640, std::vector<float>(size_t{640} * 480, 0.7F));
  readDepths(millimeters, depths);
  const Allocations allocations;
  readDepths(meters, depths);
  readDepths(millimeters, depths);
  EXPECT_EQ(allocations.count(), 0U) << allocations.stacks();
}

// How a PNG is written.
struct PngKind {
  int bits = 16;
  int color = PNG_COLOR_TYPE_GRAY;
  int interlace = PNG_INTERLACE_NONE;
  bool says_how_to_show_it = false;
};

void appendPng(png_structp writer, png_bytep bytes, size_t count) {
  auto& png = *static_cast<Bytes*>(png_get_io_ptr(writer));
  png.insert(png.end(), bytes, bytes + count);
}

// Kinds other than 16-bit gray are black.
Bytes pngOf(std::uint32_t width, const Values& values, const PngKind& kind = {}) {
  Bytes png;
  png_structp writer = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(writer);
  png_set_write_fn(writer, &png, appendPng, nullptr);
  png_set_IHDR(writer, info, width, static_cast<png_uint_32>(values.size()) / width, kind.bits, kind.color,
               kind.interlace, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  const png_color black{};
  if (kind.color == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(writer, info, &black, 1);
  if (kind.says_how_to_show_it) png_set_gAMA(writer, info, 0.45);
  png_write_info(writer, info);
  if (kind.bits == 16) png_set_swap(writer);
  for (int pass = png_set_interlace_handling(writer); pass > 0; --pass) {
    for (auto row = values.begin(); row != values.end(); row += width) {
      Bytes bytes;
      append(Values(row, row + width), bytes);
      bytes.resize(size_t{8} * width);
      if (kind.bits != 16 || kind.color != PNG_COLOR_TYPE_GRAY) std::fill(bytes.begin(), bytes.end(), 0);
      png_write_row(writer, bytes.data());
    }
  }
  png_write_end(writer, info);
  png_destroy_write_struct(&writer, &info);
  return png;
}

sensor_msgs::CompressedImage packed(const std::string& format, const Bytes& png, float a = 0.0F, float b = 0.0F) {
  sensor_msgs::CompressedImage image;
  image.format = format;
  image.data.resize(4);  // a number of the format
  append(std::vector<float>{a, b}, image.data);
  append(png, image.data);
  return image;
}

sensor_msgs::CompressedImage packedMillimeters(const Bytes& png) { return packed("16UC1; compressedDepth png", png); }

Bytes withSize(Bytes png, std::uint32_t width, std::uint32_t height) {
  png_save_uint_32(&png[16], width);
  png_save_uint_32(&png[20], height);
  return png;
}

TEST(PackedDepthImageTest, HasTheDepthsOfTheImage) {
  const Bytes png = pngOf(3, kMillimeters);
  for (const char* const format :
       {"16UC1; compressedDepth png", "16UC1; compressedDepth", "16UC1", "mono16; compressedDepth png"}) {
    EXPECT_TRUE(same(depthsOf(packed(format, png)), kMeters)) << format;
  }
}

TEST(PackedDepthImageTest, HasEachValueAsItIsWhateverIsSaidAboutShowingIt) {
  Values all(65536);
  std::vector<float> expected(all.size());
  for (size_t i = 0; i < all.size(); ++i) {
    all[i] = static_cast<std::uint16_t>(i);
    expected[i] = i == 0 || i == 65535 ? kNaN : static_cast<float>(i) / 1000.0F;
  }
  PngKind kind;
  kind.says_how_to_show_it = true;
  EXPECT_TRUE(same(depthsOf(packedMillimeters(pngOf(256, all, kind))), expected));
}

// With the defaults of the publisher, which counts up to 10 m in steps of depth^2 / 10100.
TEST(PackedDepthImageTest, HasInverseDepths) {
  const float a = 100.0F * 101.0F;
  const float b = 1.0F - a / 10.0F;
  const Bytes png = pngOf(2, {9091, 0, 1, 65535});
  EXPECT_TRUE(
      same(depthsOf(packed("32FC1; compressedDepth png", png, a, b)), {1.0F, kNaN, 10.0F, 10100.0F / 66544.0F}));
}

TEST(PackedDepthImageTest, AnInverseDepthThatIsNotAbove0IsNothing) {
  const Bytes png = pngOf(3, {3, 5, 7});
  EXPECT_TRUE(same(depthsOf(packed("32FC1; compressedDepth png", png, 10.0F, 5.0F)), {kNaN, kNaN, 5.0F}));
}

TEST(PackedDepthImageTest, RefusesInverseDepthsWithoutAScale) {
  const Bytes png = pngOf(3, kMillimeters);
  for (const auto& [a, b] :
       {std::pair{0.0F, 0.0F}, {-1.0F, 0.0F}, {kNaN, 0.0F}, {kInf, 0.0F}, {1.0F, kNaN}, {1.0F, -kInf}})
    EXPECT_TRUE(has(refusedDepths(packed("32FC1; compressedDepth png", png, a, b)), "scaled by")) << a << ' ' << b;
}

TEST(PackedDepthImageTest, RefusesRvlAndSaysWhatToSet) {
  EXPECT_EQ(
      refusedDepths(packed("16UC1; compressedDepth rvl", pngOf(3, kMillimeters))),
      "depth image is packed as '16UC1; compressedDepth rvl': set .../compressedDepth/format of its publisher to png");
}

TEST(PackedDepthImageTest, RefusesOtherPackingsAndSaysWhichTopicToTake) {
  for (const char* const format :
       {"jpeg", "png", "", "rgb8; jpeg compressed bgr8", "16UC1; png compressed ", "16UC1; jpeg",
        "8UC1; compressedDepth png", "rgb8; compressedDepth png", "16UC1; compressedDepth png2"}) {
    const std::string refused = refusedDepths(packed(format, pngOf(3, kMillimeters)));
    EXPECT_TRUE(has(refused, "is packed as '" + std::string(format) + "': take the topic .../compressedDepth"))
        << format;
  }
}

TEST(PackedDepthImageTest, RefusesPngsOfAnotherKind) {
  const std::vector<PngKind> kinds = {{8, PNG_COLOR_TYPE_GRAY},       {1, PNG_COLOR_TYPE_GRAY},
                                      {16, PNG_COLOR_TYPE_RGB},       {8, PNG_COLOR_TYPE_RGB},
                                      {8, PNG_COLOR_TYPE_PALETTE},    {16, PNG_COLOR_TYPE_GRAY_ALPHA},
                                      {16, PNG_COLOR_TYPE_RGB_ALPHA}, {16, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_ADAM7}};
  for (const auto& kind : kinds) {
    EXPECT_TRUE(
        has(refusedDepths(packedMillimeters(pngOf(3, kMillimeters, kind))), "not 16-bit gray without interlacing"))
        << kind.bits << ' ' << kind.color;
  }
}

TEST(PackedDepthImageTest, RefusesAPngThatIsCutOffAnywhere) {
  const auto whole = packedMillimeters(pngOf(3, kMillimeters));
  for (size_t size = 0; size < whole.data.size(); ++size) {
    auto cut = whole;
    cut.data.resize(size);
    EXPECT_NE(refusedDepths(cut), "") << size;
  }
}

TEST(PackedDepthImageTest, RefusesAPngInWhichAnyByteIsWrong) {
  const auto whole = packedMillimeters(pngOf(3, kMillimeters));
  for (size_t at = kDepthHeader; at < whole.data.size(); ++at) {
    auto damaged = whole;
    damaged.data[at] ^= 0x10U;
    EXPECT_NE(refusedDepths(damaged), "") << at;
  }
}

TEST(PackedDepthImageTest, RefusesBytesThatAreNoPng) {
  const Bytes jpeg = {0xFF, 0xD8, 0xFF, 0xE0};
  EXPECT_TRUE(has(refusedDepths(packedMillimeters(jpeg)), "it does not begin as a PNG"));
  EXPECT_TRUE(has(refusedDepths(packedMillimeters(Bytes(1000, 0))), "it does not begin as a PNG"));
}

TEST(PackedDepthImageTest, AllocatesNothingForPixelsThatAreTooManyOrCannotBeThere) {
  const Bytes png = pngOf(3, kMillimeters);
  std::vector<float> depths;
  for (const auto& [width, height] :
       {std::pair{0U, 2U}, {3U, 0U}, {4096U, 2049U}, {0x7FFFFFFFU, 0x7FFFFFFFU}, {2000U, 2000U}}) {
    const auto image = packedMillimeters(withSize(png, width, height));
    const Allocations allocations;
    EXPECT_NE(refusal([&] { readDepths(image, depths); }), "");
    EXPECT_LT(allocations.largest(), 1000U);
  }
  EXPECT_TRUE(depths.empty());
}

TEST(PackedDepthImageTest, ReadsARealFrame) {
  const auto file = dataPath("depth/xarm7_realsense/depth/000000.png");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << missing(file);
  std::ifstream stream(file, std::ios::binary);
  const Bytes png{std::istreambuf_iterator<char>(stream), {}};
  std::vector<float> depths;
  const ImageSize size = readDepths(packedMillimeters(png), depths);
  EXPECT_EQ(size.width, 1280U);
  EXPECT_EQ(size.height, 720U);
  depths.erase(std::remove_if(depths.begin(), depths.end(), [](float z) { return std::isnan(z); }), depths.end());
  EXPECT_GT(depths.size(), size_t{1280} * 720 * 92 / 100);
  const auto [nearest, farthest] = std::minmax_element(depths.begin(), depths.end());
  EXPECT_GT(*nearest, 0.69F);
  EXPECT_LT(*farthest, 25.6F);
}

}  // namespace
}  // namespace sweep_guard_ros
