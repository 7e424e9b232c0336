#include <geometry_msgs/PoseStamped.h>
#include <ros/ros.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "recording/bag.h"
#include "recording/run_node.h"
#include "simulation/camera_pose.h"
#include "simulation/depth_recording.h"
#include "simulation/motion_start.h"
#include "simulation/workpiece_messages.h"
#include "sweep_guard/DeformableMesh.h"
#include "sweep_guard/common/quantile.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_simulation {
namespace {

constexpr const char* kFrame = "world";
// Of a camera that tf does not place: what it looks at [m], and from where.
const Eigen::Vector3d kTarget_W(0.0, 0.0, 0.5);
const Eigen::Vector3d kTowards_W(0.35, 0.4, 0.55);
const ros::Duration kPause(0.033);  // between the end and the begin
const ros::Duration kLead(0.2);     // of the tool: it has a pose before the stamp of the first image

/// Plays the depth images of a bag again and again, as if they came now: images, camera_info and transforms, from the first pose
/// of the tool on. Where tf does not place the camera, it looks down at the middle of what it sees first. Publishes that surface as a mesh,
/// which a motion can be made for.
class DepthPlayer {
 public:
  explicit DepthPlayer(sweep_guard_ros::ParameterReader& parameters)
      : path_(parameters.text("bag", "")), requested_(parameters.text("topic", "")) {
    images_ = node_.advertise<sensor_msgs::Image>("camera/depth/image_rect", 10);
    infos_ = node_.advertise<sensor_msgs::CameraInfo>("camera/depth/camera_info", 10, /*latch=*/true);
    transforms_ = node_.advertise<tf2_msgs::TFMessage>("/tf", 100);
    static_transforms_ = node_.advertise<tf2_msgs::TFMessage>("/tf_static", 1, /*latch=*/true);
    mesh_ = node_.advertise<sweep_guard::DeformableMesh>("mesh", 1, /*latch=*/true);
    pose_ = node_.subscribe<geometry_msgs::PoseStamped>("tool_pose", 1, [this](const auto&) { moves_ = true; });
  }

  void run() {
    ros::Time::waitForValid();
    sweep_guard_recording::openBag(path_, [this](const rosbag::Bag& bag) {
      recording_ = inspectDepthBag(bag, requested_);
      infos_.publish(recording_.info);
      place(bag);
      publishMesh();
      if (!waitUntil([this] { return moves_; }, "the tool to move")) return;
      ROS_INFO("playing %s of %s", recording_.topic.c_str(), path_.c_str());
      kLead.sleep();
      while (ros::ok()) play(bag);
    });
  }

 private:
  std::vector<std::string> topics() const { return {recording_.topic, recording_.info_topic, "/tf", "tf"}; }

  // The transforms before the first image come at once: the motion may need them.
  void place(const rosbag::Bag& bag) {
    tf2_msgs::TFMessage placed;
    const std::vector<std::string> tf_static = {"/tf_static", "tf_static"};
    for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery(tf_static))) {
      if (const auto transforms = message.instantiate<tf2_msgs::TFMessage>())
        placed.transforms.insert(placed.transforms.end(), transforms->transforms.begin(), transforms->transforms.end());
    }
    if (recording_.root != kFrame) placed.transforms.push_back(rootTransform());
    for (geometry_msgs::TransformStamped& transform : placed.transforms) transform.header.stamp = ros::Time::now();
    static_transforms_.publish(placed);
    for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery(topics()))) {
      if (message.getTopic() == recording_.topic) return;
      if (message.getTopic() != recording_.info_topic) publish(message, ros::Time::now() - message.getTime());
    }
  }

  geometry_msgs::TransformStamped rootTransform() const {
    const bool placed = !recording_.root.empty();
    auto transform = tf2::eigenToTransform(placed ? Eigen::Isometry3d::Identity() : assumedPose());
    transform.header.frame_id = kFrame;
    transform.child_frame_id = placed ? recording_.root : recording_.frame;
    if (!placed)
      ROS_WARN("tf in the bag does not place '%s': it looks down at the workplace", recording_.frame.c_str());
    return transform;
  }

  Eigen::Isometry3d assumedPose() const {
    std::vector<double> seen;
    std::copy_if(recording_.depths.begin(), recording_.depths.end(), std::back_inserter(seen),
                 [](float depth) { return !std::isnan(depth); });
    if (seen.empty()) throw sweep_guard_core::InvalidInput("the first image has no depth in any pixel");
    return lookingAt(kTarget_W, kTarget_W + sweep_guard_core::quantile(seen, 0.5) * kTowards_W.normalized());
  }

  void publishMesh() {
    const VisibleSurface surface = surfaceOf(recording_);
    sweep_guard::DeformableMesh message = meshMessage(surface.positions_S, surface.triangles);
    message.header.stamp = ros::Time::now();
    message.header.frame_id = recording_.frame;
    message.id = "first image";
    message.open = 1;
    mesh_.publish(message);
  }

  void play(const rosbag::Bag& bag) {
    rosbag::View view(bag, rosbag::TopicQuery(topics()));
    const ros::Duration later = ros::Time::now() - view.getBeginTime();
    for (const rosbag::MessageInstance& message : view) {
      while (ros::ok() && ros::Time::now() < message.getTime() + later) ros::Duration(0.001).sleep();
      if (!ros::ok()) return;
      publish(message, later);
      ros::spinOnce();
    }
    kPause.sleep();
  }

  void publish(const rosbag::MessageInstance& message, const ros::Duration& later) {
    if (const auto transforms = message.instantiate<tf2_msgs::TFMessage>()) {
      for (geometry_msgs::TransformStamped& transform : transforms->transforms) transform.header.stamp += later;
      transforms_.publish(transforms);
    } else if (const auto info = message.instantiate<sensor_msgs::CameraInfo>()) {
      info->header.stamp += later;
      infos_.publish(info);
    } else {
      publishImage(message, later);
    }
  }

  void publishImage(const rosbag::MessageInstance& message, const ros::Duration& later) {
    sensor_msgs::Image image;
    sweep_guard_ros::ImageSize size{};
    image.header = readImage(message, size, depths_);
    image.header.stamp += later;
    image.encoding = "32FC1";
    image.width = size.width;
    image.height = size.height;
    image.step = size.width * sizeof(float);
    image.data.resize(depths_.size() * sizeof(float));
    std::memcpy(image.data.data(), depths_.data(), image.data.size());
    images_.publish(image);
  }

  const std::string path_;
  const std::string requested_;
  DepthRecording recording_;
  std::vector<float> depths_;
  bool moves_ = false;  // the tool
  ros::NodeHandle node_;
  ros::Publisher images_;
  ros::Publisher infos_;
  ros::Publisher transforms_;
  ros::Publisher static_transforms_;
  ros::Publisher mesh_;
  ros::Subscriber pose_;
};

}  // namespace
}  // namespace sweep_guard_simulation

int main(int argc, char** argv) {
  return sweep_guard_recording::runNode<sweep_guard_simulation::DepthPlayer>(argc, argv, "depth_player");
}
