#include <geometry_msgs/PoseStamped.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "recording/run_node.h"
#include "ros/parameters/parameters.h"
#include "simulation/camera_pose.h"
#include "simulation/depth_noise.h"
#include "simulation/depth_renderer.h"
#include "sweep_guard/DeformableMesh.h"
#include "sweep_guard/MeshVertices.h"
#include "sweep_guard/geometry/link_surface.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_simulation {
namespace {

using sweep_guard_core::StampedPose;
using sweep_guard_core::Time;

constexpr std::uint32_t kWidth = 640;
constexpr std::uint32_t kHeight = 480;
constexpr sweep_guard_core::Pinhole kPinhole{585.0, 585.0, 320.0, 240.0};  // a Kinect, as 7-Scenes has it
constexpr double kTable = 2.0;                                             // half of its width [m]
constexpr sweep_guard_core::Duration kKept = std::chrono::seconds(1);      // of the poses
constexpr std::uint32_t kQueue = 1000;
constexpr const char* kFrame = "world";
constexpr const char* kCameraFrame = "camera_depth_optical_frame";
const ros::Duration kPeriod(1.0 / 30.0);
const ros::Duration kDelay(0.065);  // 60 to 70 ms: a RealSense, as its makers say (librealsense, issue 1242)

VisibleSurface table(const Eigen::Isometry3d& X_CW) {
  constexpr auto kEdge = static_cast<float>(kTable);
  return {X_CW,
          {-kEdge, -kEdge, 0.0F, kEdge, -kEdge, 0.0F, kEdge, kEdge, 0.0F, -kEdge, kEdge, 0.0F},
          {{0, 1, 2}, {0, 2, 3}}};
}

/// Publishes what a depth camera sees of the demo: a table at z = 0, the workpiece, and the tool of a guard from its first pose on.
/// Each image is that of one update of the vertices; it comes after the time that a camera takes for it.
class DepthCamera {
 public:
  explicit DepthCamera(sweep_guard_ros::ParameterReader& parameters)
      : X_CW_(lookingAt(parameters.position("look_at", {0.0, 0.0, 0.5}),
                        parameters.position("position", {0.35, 0.4, 1.05}))
                  .inverse()),
        renderer_(kWidth, kHeight, kPinhole),
        listener_(buffer_),
        surfaces_{table(X_CW_), {}} {
    addTool(*sweep_guard_ros::loadParameters(ros::NodeHandle(parameters.text("guard", "sweep_guard"))).tool);
    makeMessages();
    images_ = node_.advertise<sensor_msgs::Image>("camera/depth/image_rect", 10);
    infos_ = node_.advertise<sensor_msgs::CameraInfo>("camera/depth/camera_info", 10, /*latch=*/true);
    infos_.publish(info_);  // without a stamp: before the first image, which is of no use without it
    const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
    mesh_subscriber_ = node_.subscribe("mesh", 1, &DepthCamera::onMesh, this);
    vertices_subscriber_ = node_.subscribe("mesh_vertices", kQueue, &DepthCamera::onVertices, this, hints);
    pose_subscriber_ = node_.subscribe("tool_pose", kQueue, &DepthCamera::onToolPose, this, hints);
  }

  void run() {
    ros::Time::waitForValid();
    broadcastFrame();
    for (ros::Rate rate(250.0); ros::ok(); rate.sleep()) {
      ros::spinOnce();
      while (isDue(1)) waiting_.pop_front();  // no image is late, as of a machine that is too slow for all of them
      if (!isDue(0)) continue;
      publish(*waiting_.front());
      waiting_.pop_front();
    }
  }

 private:
  void addTool(const sweep_guard_core::Tool& tool) {
    for (sweep_guard_core::LinkSurface& link : sweep_guard_core::linkSurfaces(tool)) {
      VisibleSurface& surface = surfaces_.emplace_back();
      for (const Eigen::Vector3d& p_T : link.vertices_B) {
        for (const double coordinate : p_T) surface.positions_S.push_back(static_cast<float>(coordinate));
      }
      surface.triangles = std::move(link.triangles);
    }
  }

  void makeMessages() {
    info_.header.frame_id = image_.header.frame_id = kCameraFrame;
    info_.width = image_.width = kWidth;
    info_.height = image_.height = kHeight;
    info_.K = {kPinhole.fx, 0.0, kPinhole.cx, 0.0, kPinhole.fy, kPinhole.cy, 0.0, 0.0, 1.0};
    info_.P = {kPinhole.fx, 0.0, kPinhole.cx, 0.0, 0.0, kPinhole.fy, kPinhole.cy, 0.0, 0.0, 0.0, 1.0, 0.0};
    image_.encoding = "16UC1";
    image_.step = 2 * kWidth;
    image_.data.resize(size_t{image_.step} * kHeight);
  }

  void broadcastFrame() {
    geometry_msgs::TransformStamped transform = tf2::eigenToTransform(X_CW_.inverse());
    transform.header.stamp = ros::Time::now();
    transform.header.frame_id = kFrame;
    transform.child_frame_id = kCameraFrame;
    broadcaster_.sendTransform(transform);
  }

  bool isDue(size_t i) const { return i < waiting_.size() && ros::Time::now() >= waiting_[i]->header.stamp + kDelay; }

  VisibleSurface& workpiece() { return surfaces_[1]; }

  void onMesh(const sweep_guard::DeformableMesh::ConstPtr& mesh) {
    workpiece().triangles.clear();
    waiting_.clear();
    for (const shape_msgs::MeshTriangle& triangle : mesh->mesh.triangles) {
      const auto& corners = triangle.vertex_indices;
      workpiece().triangles.push_back({corners[0], corners[1], corners[2]});
    }
    vertex_count_ = mesh->mesh.vertices.size();
  }

  bool locate(const std::string& frame) {
    if (!buffer_.canTransform(kFrame, frame, ros::Time(0))) return false;
    workpiece().X_CS = X_CW_ * tf2::transformToEigen(buffer_.lookupTransform(kFrame, frame, ros::Time(0)));
    return true;
  }

  // Updates come a little unevenly.
  void onVertices(const sweep_guard::MeshVertices::ConstPtr& vertices) {
    if (poses_.empty() || vertices->positions.size() != 3 * vertex_count_) return;
    if (vertices->header.stamp < next_image_ || !locate(vertices->header.frame_id)) return;
    next_image_ = vertices->header.stamp + kPeriod * 0.8;
    waiting_.push_back(vertices);
  }

  void onToolPose(const geometry_msgs::PoseStamped::ConstPtr& pose) {
    const StampedPose next{sweep_guard_ros::fromMsg(pose->header.stamp), sweep_guard_ros::fromMsg(pose->pose)};
    if (!poses_.empty() && next.stamp < poses_.back().stamp) poses_.clear();
    while (!poses_.empty() && poses_.front().stamp + kKept < next.stamp) poses_.pop_front();
    poses_.push_back(next);
  }

  // At the first pose not before the stamp: the guard takes all of the way to it for the tool.
  Eigen::Isometry3d toolAt(Time stamp) const {
    const auto is_before = [](const StampedPose& pose, Time time) { return pose.stamp < time; };
    const auto next = std::lower_bound(poses_.begin(), poses_.end(), stamp, is_before);
    return (next == poses_.end() ? poses_.back() : *next).X_WT;
  }

  void publish(const sweep_guard::MeshVertices& vertices) {
    workpiece().positions_S = vertices.positions;
    const Eigen::Isometry3d X_CT = X_CW_ * toolAt(sweep_guard_ros::fromMsg(vertices.header.stamp));
    for (size_t i = 2; i < surfaces_.size(); ++i) surfaces_[i].X_CS = X_CT;
    const std::vector<std::uint16_t>& seen = noise_.seen(renderer_.render(surfaces_));
    std::memcpy(image_.data.data(), seen.data(), image_.data.size());
    info_.header.stamp = image_.header.stamp = vertices.header.stamp;
    infos_.publish(info_);
    images_.publish(image_);
  }

  const Eigen::Isometry3d X_CW_;
  DepthNoise noise_;
  DepthRenderer renderer_;
  ros::NodeHandle node_;
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
  tf2_ros::StaticTransformBroadcaster broadcaster_;
  std::vector<VisibleSurface> surfaces_;  // the table, the workpiece, the links of the tool
  size_t vertex_count_ = 0;
  std::deque<StampedPose> poses_;
  std::deque<sweep_guard::MeshVertices::ConstPtr> waiting_;  // to be seen, the oldest first
  ros::Time next_image_;
  sensor_msgs::Image image_;
  sensor_msgs::CameraInfo info_;
  ros::Publisher images_;
  ros::Publisher infos_;
  ros::Subscriber mesh_subscriber_;
  ros::Subscriber vertices_subscriber_;
  ros::Subscriber pose_subscriber_;
};

}  // namespace
}  // namespace sweep_guard_simulation

int main(int argc, char** argv) {
  return sweep_guard_recording::runNode<sweep_guard_simulation::DepthCamera>(argc, argv, "depth_camera");
}
