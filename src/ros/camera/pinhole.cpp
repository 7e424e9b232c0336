#include "ros/camera/pinhole.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

using Info = sensor_msgs::CameraInfo;

void refuseIf(bool wrong, const std::string& problem) {
  if (wrong) throw sweep_guard_core::InvalidInput("camera_info " + problem);
}

bool differs(std::uint32_t said, std::uint32_t is) { return said != 0 && said != is; }

bool isPart(const sensor_msgs::RegionOfInterest& roi, ImageSize image) {
  return roi.x_offset != 0 || roi.y_offset != 0 || differs(roi.width, image.width) || differs(roi.height, image.height);
}

// A fisheye (equidistant) without coefficients is no pinhole.
bool isDistorted(const Info& info) {
  return info.distortion_model == "equidistant" ||
         std::any_of(info.D.begin(), info.D.end(), [](double coefficient) { return coefficient != 0.0; });
}

}  // namespace

bool isNamedRectified(std::string_view topic) {
  constexpr std::string_view kTransport = "/compressedDepth";
  const size_t end = topic.rfind(kTransport);
  if (end != topic.npos && end + kTransport.size() == topic.size()) topic = topic.substr(0, end);
  topic = topic.substr(topic.rfind('/') + 1);
  return topic.find("_rect") != topic.npos && topic.find("_raw") == topic.npos;
}

sweep_guard_core::Pinhole pinholeOf(const Info& info, ImageSize image, bool rectified) {
  const auto& P = info.P;
  refuseIf(!std::all_of(P.begin(), P.end(), [](double value) { return std::isfinite(value); }),
           "has a P that is not finite: calibrate the camera");
  refuseIf(!(P[0] > 0.0 && P[5] > 0.0), "has no focal length in P: calibrate the camera");
  refuseIf(P[3] != 0.0 || P[7] != 0.0,
           "is that of the second camera of a pair (P[3], P[7]): publish depths of the first");
  refuseIf(differs(info.width, image.width) || differs(info.height, image.height),
           "is of another size than the image: publish the one of the depth image");
  refuseIf(info.binning_x > 1 || info.binning_y > 1 || isPart(info.roi, image),
           "is of a part of the image (roi), or of one with binning: publish the full image");
  refuseIf(!rectified && isDistorted(info),
           "says that the image is distorted (D): publish the one that image_proc/rectify makes, as image_rect");
  return {P[0], P[5], P[2], P[6]};
}

}  // namespace sweep_guard_ros
