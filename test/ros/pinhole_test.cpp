// The camera is that of P; a camera_info that cannot be that of the image is refused.
#include "ros/camera/pinhole.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "refusal.h"

namespace sweep_guard_ros {
namespace {

using Info = sensor_msgs::CameraInfo;

constexpr ImageSize kSize = {640, 480};

Info cameraInfo() {
  Info info;
  info.width = kSize.width;
  info.height = kSize.height;
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K = {600.0, 0.0, 300.0, 0.0, 601.0, 200.0, 0.0, 0.0, 1.0};
  info.P = {500.0, 0.0, 310.0, 0.0, 0.0, 501.0, 210.0, 0.0, 0.0, 0.0, 1.0, 0.0};
  return info;
}

std::string refusedInfo(const std::function<void(Info&)>& change, bool rectified = false) {
  Info info = cameraInfo();
  change(info);
  return refusal([&] { pinholeOf(info, kSize, rectified); });
}

TEST(PinholeTest, IsThatOfP) {
  const auto pinhole = pinholeOf(cameraInfo(), kSize, false);
  EXPECT_EQ(pinhole.fx, 500.0);
  EXPECT_EQ(pinhole.fy, 501.0);
  EXPECT_EQ(pinhole.cx, 310.0);
  EXPECT_EQ(pinhole.cy, 210.0);
}

TEST(PinholeTest, IsNotThatOfACameraThatIsNotCalibrated) {
  EXPECT_TRUE(has(refusedInfo([](Info& info) { info.P.fill(0.0); }), "no focal length in P: calibrate the camera"));
  EXPECT_TRUE(has(refusedInfo([](Info& info) { info.P[0] = 0.0; }), "no focal length"));
  EXPECT_TRUE(has(refusedInfo([](Info& info) { info.P[5] = -501.0; }), "no focal length"));
}

TEST(PinholeTest, IsFinite) {
  for (const size_t i : {0U, 2U, 3U, 5U, 6U}) {
    for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
      EXPECT_TRUE(has(refusedInfo([&](Info& info) { info.P[i] = value; }), "not finite")) << i;
  }
}

TEST(PinholeTest, HasNoDistortion) {
  EXPECT_EQ(refusedInfo([](Info& info) { info.D.clear(); }), "");
  EXPECT_TRUE(has(refusedInfo([](Info& info) { info.D[4] = -0.1; }), "publish the one that image_proc/rectify makes"));
  EXPECT_TRUE(has(refusedInfo([](Info& info) { info.D[0] = std::numeric_limits<double>::quiet_NaN(); }), "distorted"));
}

TEST(PinholeTest, IsNoFisheyeEvenWithoutCoefficients) {
  EXPECT_TRUE(has(refusedInfo([](Info& info) { info.distortion_model = "equidistant"; }), "distorted"));
}

// image_proc publishes no camera_info: beside what it has rectified is that of the raw image.
TEST(PinholeTest, OfARectifiedImageMayComeWithTheDistortionOfTheRawImage) {
  EXPECT_EQ(refusedInfo([](Info& info) { info.D[0] = -0.1; }, true), "");
  EXPECT_TRUE(has(refusedInfo([](Info& info) { info.P.fill(0.0); }, true), "no focal length"));
}

TEST(PinholeTest, IsOfTheSizeOfTheImageOrOfNone) {
  EXPECT_EQ(refusedInfo([](Info& info) { info.width = info.height = 0; }), "");
  EXPECT_TRUE(has(refusedInfo([](Info& info) { info.width = 1280; }), "of another size than the image"));
  EXPECT_TRUE(has(refusedInfo([](Info& info) { info.height = 479; }), "of another size than the image"));
}

TEST(PinholeTest, IsOfTheFullImageWithoutBinning) {
  const std::vector<std::function<void(Info&)>> parts = {
      [](Info& info) { info.binning_x = 2; },    [](Info& info) { info.binning_y = 2; },
      [](Info& info) { info.roi.x_offset = 1; }, [](Info& info) { info.roi.y_offset = 1; },
      [](Info& info) { info.roi.width = 320; },  [](Info& info) { info.roi.height = 240; }};
  for (const auto& part : parts) EXPECT_TRUE(has(refusedInfo(part), "publish the full image"));
  EXPECT_EQ(refusedInfo([](Info& info) {
              info.binning_x = info.binning_y = 1;
              info.roi.width = kSize.width;
              info.roi.height = kSize.height;
            }),
            "");
}

TEST(PinholeTest, IsNotThatOfTheSecondCameraOfAPair) {
  EXPECT_TRUE(has(refusedInfo([](Info& info) { info.P[3] = -60.0; }), "second camera of a pair"));
  EXPECT_TRUE(has(refusedInfo([](Info& info) { info.P[7] = 1.0; }), "second camera of a pair"));
}

TEST(RectifiedNameTest, IsThatOfImageProc) {
  for (const char* const topic :
       {"/camera/depth/image_rect", "image_rect", "/camera/depth_registered/image_rect/compressedDepth", "/depth_rect"})
    EXPECT_TRUE(isNamedRectified(topic)) << topic;
}

// realsense2_camera calls images image_rect_raw whether they are rectified or not.
TEST(RectifiedNameTest, IsNotThatOfADriverOrOfANamespace) {
  for (const char* const topic :
       {"/camera/depth/image_rect_raw", "/camera/depth/image_rect_raw/compressedDepth", "/camera/depth/image_raw",
        "/camera/depth", "/image_rect/depth", "/direct/image", "/compressedDepth", ""})
    EXPECT_FALSE(isNamedRectified(topic)) << topic;
}

}  // namespace
}  // namespace sweep_guard_ros
