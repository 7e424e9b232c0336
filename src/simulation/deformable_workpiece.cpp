#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <ros/ros.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <visualization_msgs/Marker.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "recording/run_node.h"
#include "simulation/workpiece.h"
#include "simulation/workpiece_messages.h"
#include "sweep_guard/DeformableMesh.h"
#include "sweep_guard/MeshVertices.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_simulation {

namespace {

constexpr double kMarkerPeriod = 1.0 / 15.0;  // [s]
constexpr double kReminderPeriod = 10.0;      // [s]
constexpr double kLeastShare = 0.95;          // of the rate

std_msgs::ColorRGBA shade(const Eigen::Vector3d& normal) {
  const auto light = static_cast<float>(0.5 + 0.5 * normal.dot(Eigen::Vector3d(0.48, 0.14, 0.866)));
  std_msgs::ColorRGBA color;
  color.r = 0.15F + 0.75F * light;
  color.g = 0.15F + 0.72F * light;
  color.b = 0.15F + 0.62F * light;
  color.a = 1.0F;
  return color;
}

/// Publishes a workpiece: its triangles once, its vertices at a rate, and markers for rviz if there are subscribers. An
/// elastic one gives way to the tool of a guard.
class WorkpieceNode {
 public:
  explicit WorkpieceNode(sweep_guard_ros::ParameterReader& parameters)
      : workpiece_(makeWorkpiece(parameters)),
        id_(parameters.name("id", "workpiece")),
        frame_(parameters.name("frame", "workpiece")),
        parent_frame_(parameters.name("parent_frame", "world")),
        X_WM_(placeOf(parameters)),
        rate_(parameters.number("rate", 60.0, {0.1, 1000.0})),
        elastic_(makeElasticWorkpiece(parameters, workpiece_, 1.0 / rate_,
                                      X_WM_.linear().transpose() * Eigen::Vector3d::UnitZ())) {
    const std::string guard = parameters.text("guard", "sweep_guard");
    if (elastic_) setToolOf(guard, id_, *elastic_);
    ros::Time::waitForValid();
    broadcastFrame();
    mesh_publisher_ = node_.advertise<sweep_guard::DeformableMesh>("mesh", 1, /*latch=*/true);
    vertices_publisher_ = node_.advertise<sweep_guard::MeshVertices>("mesh_vertices", 10);
    marker_publisher_ = private_node_.advertise<visualization_msgs::Marker>("marker", 1);
    if (!elastic_) return;
    force_publisher_ = private_node_.advertise<visualization_msgs::MarkerArray>("force", 1);
    tool_subscriber_ =
        node_.subscribe("tool_pose", 1, &WorkpieceNode::onToolPose, this, ros::TransportHints().tcpNoDelay());
  }

  void run() {
    start_ = counted_since_ = ros::Time::now();
    publishMesh();
    for (ros::Rate rate(rate_); ros::ok(); rate.sleep()) {
      ros::spinOnce();
      if (elastic_) advance();
      publishVertices();
    }
  }

 private:
  void broadcastFrame() {
    geometry_msgs::TransformStamped transform = tf2::eigenToTransform(X_WM_);
    transform.header.stamp = ros::Time::now();
    transform.header.frame_id = parent_frame_;
    transform.child_frame_id = frame_;
    broadcaster_.sendTransform(transform);
  }

  void onToolPose(const geometry_msgs::PoseStamped::ConstPtr& pose) {
    if (pose->header.frame_id != parent_frame_) {
      ROS_WARN_THROTTLE(kReminderPeriod, "the elastic workpiece needs tool poses in the frame '%s', not '%s'",
                        parent_frame_.c_str(), pose->header.frame_id.c_str());
      return;
    }
    Eigen::Isometry3d X_WT;
    tf2::fromMsg(pose->pose, X_WT);
    if (!X_WT.matrix().allFinite()) return;
    X_MT_ = X_WM_.inverse() * X_WT;
  }

  void advance() {
    elastic_->advance(X_MT_);
    ++steps_;
    const double seconds = (ros::Time::now() - counted_since_).toSec();
    if (seconds < kReminderPeriod) return;
    const double reached = steps_ / seconds;
    if (reached < kLeastShare * rate_) {
      ROS_WARN("the elastic workpiece moves too slowly: %.0f of %.0f steps per second", reached, rate_);
    }
    counted_since_ = ros::Time::now();
    steps_ = 0;
  }

  std::vector<float> positionsAt(const ros::Time& time) const {
    return elastic_ ? elastic_->positions() : workpiece_.positions((time - start_).toSec());
  }

  void publishMesh() {
    sweep_guard::DeformableMesh message = meshMessage(positionsAt(start_), workpiece_.triangles());
    message.header.stamp = start_;
    message.header.frame_id = frame_;
    message.id = id_;
    mesh_publisher_.publish(message);
    ROS_INFO("workpiece '%s': %zu triangles, %zu vertices, %.0f Hz", id_.c_str(), workpiece_.triangles().size(),
             workpiece_.vertexCount(), rate_);
  }

  void publishVertices() {
    const ros::Time now = ros::Time::now();
    sweep_guard::MeshVertices message = verticesMessage(positionsAt(now));
    message.header.stamp = now;
    message.header.frame_id = frame_;
    message.id = id_;
    vertices_publisher_.publish(message);
    if ((message.header.stamp - marker_stamp_).toSec() < kMarkerPeriod) return;
    marker_stamp_ = message.header.stamp;
    if (marker_publisher_.getNumSubscribers() > 0) publishMarker(message);
    if (elastic_ && force_publisher_.getNumSubscribers() > 0) {
      force_publisher_.publish(
          forceMarkers(message.header, elastic_->pressed_M(), elastic_->force_M(), elastic_->dent()));
    }
  }

  void publishMarker(const sweep_guard::MeshVertices& vertices) {
    visualization_msgs::Marker marker;
    marker.header = vertices.header;
    marker.ns = id_;
    marker.type = visualization_msgs::Marker::TRIANGLE_LIST;
    marker.pose.orientation.w = 1.0;
    marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
    marker.color.a = 1.0F;
    marker.lifetime = ros::Duration(0.5);
    const auto vertex = [&vertices](std::size_t i) {
      return Eigen::Map<const Eigen::Vector3f>(&vertices.positions[3 * i]).cast<double>().eval();
    };
    for (const auto& triangle : workpiece_.triangles()) {
      const Eigen::Vector3d a = vertex(triangle[0]);
      const Eigen::Vector3d b = vertex(triangle[1]);
      const Eigen::Vector3d c = vertex(triangle[2]);
      for (const Eigen::Vector3d& corner : {a, b, c}) marker.points.push_back(tf2::toMsg(corner));
      marker.colors.insert(marker.colors.end(), 3, shade((b - a).cross(c - a).stableNormalized()));
    }
    marker_publisher_.publish(marker);
  }

  Workpiece workpiece_;
  std::string id_;
  std::string frame_;
  std::string parent_frame_;
  Eigen::Isometry3d X_WM_;
  double rate_;
  std::optional<ElasticWorkpiece> elastic_;
  std::optional<Eigen::Isometry3d> X_MT_;  // newest pose of the tool
  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  ros::Publisher mesh_publisher_;
  ros::Publisher vertices_publisher_;
  ros::Publisher marker_publisher_;
  ros::Publisher force_publisher_;
  ros::Subscriber tool_subscriber_;
  tf2_ros::StaticTransformBroadcaster broadcaster_;
  ros::Time start_;
  ros::Time counted_since_;
  int steps_ = 0;  // since then
  ros::Time marker_stamp_;
};

}  // namespace

}  // namespace sweep_guard_simulation

int main(int argc, char** argv) {
  return sweep_guard_recording::runNode<sweep_guard_simulation::WorkpieceNode>(argc, argv, "deformable_workpiece");
}
