#include "ros/output/points_publisher.h"

#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>

#include "ros/output/marker_shapes.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

constexpr size_t kMaxPixels = 80000;

// In the order of the fields.
struct ColoredPoint {
  std::array<float, 3> p;
  std::uint32_t rgb;
};

std::uint32_t packed(const std_msgs::ColorRGBA& color) {
  std::uint32_t rgb = 0;
  for (const float component : {color.r, color.g, color.b})
    rgb = rgb << 8U | static_cast<std::uint32_t>(std::lround(255.0F * component));
  return rgb;
}

sensor_msgs::PointCloud2 cloudOf(const std::vector<sweep_guard_core::PicturePoint>& points) {
  const std::array<std::uint32_t, 3> colors = {packed(workpieceColor(1.0)), packed(rememberedColor(1.0)),
                                               packed(toolColor(1.0))};
  sensor_msgs::PointCloud2 cloud;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  const int type = sensor_msgs::PointField::FLOAT32;
  modifier.setPointCloud2Fields(4, "x", 1, type, "y", 1, type, "z", 1, type, "rgb", 1, type);
  modifier.resize(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f& p = points[i].p_F;
    const ColoredPoint point{{p.x(), p.y(), p.z()}, colors.at(static_cast<size_t>(points[i].kind))};
    std::memcpy(&cloud.data[i * sizeof(point)], &point, sizeof(point));
  }
  return cloud;
}

}  // namespace

PointsPublisher::PointsPublisher(ros::NodeHandle private_node, const std::string& camera,
                                 const LiveParameters& parameters)
    : parameters_(parameters), publisher_(private_node.advertise<sensor_msgs::PointCloud2>("cameras/" + camera, 1)) {}

void PointsPublisher::publish(const sweep_guard_core::DepthSurface& surface, const std::vector<float>& depths,
                              sweep_guard_core::Time stamp) {
  if (publisher_.getNumSubscribers() == 0) return;
  const auto parameters = parameters_.get();
  const auto period = sweep_guard_core::fromSeconds(1.0 / parameters->marker_rate);
  const sweep_guard_core::SteadyTime now = std::chrono::steady_clock::now();
  if (now < due_) return;
  due_ = std::max(due_ + period, now);
  sensor_msgs::PointCloud2 cloud = cloudOf(surface.points(depths, kMaxPixels));
  cloud.header.frame_id = parameters->fixed_frame;
  cloud.header.stamp = toMsg(stamp);
  publisher_.publish(cloud);
}

}  // namespace sweep_guard_ros
