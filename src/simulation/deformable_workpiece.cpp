#include <geometry_msgs/TransformStamped.h>
#include <ros/ros.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <visualization_msgs/Marker.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "recording/run_node.h"
#include "simulation/workpiece.h"
#include "simulation/workpiece_messages.h"
#include "simulation/workpiece_parameters.h"
#include "sweep_guard/DeformableMesh.h"
#include "sweep_guard/MeshVertices.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_simulation {

namespace {

constexpr double kMarkerPeriod = 1.0 / 15.0;  // [s]

std_msgs::ColorRGBA shade(const Eigen::Vector3d& normal) {
  const auto light = static_cast<float>(0.5 + 0.5 * normal.dot(Eigen::Vector3d(0.48, 0.14, 0.866)));
  std_msgs::ColorRGBA color;
  color.r = 0.15F + 0.75F * light;
  color.g = 0.15F + 0.72F * light;
  color.b = 0.15F + 0.62F * light;
  color.a = 1.0F;
  return color;
}

/// Publishes a workpiece: its triangles once, its vertices at a rate, and a marker for rviz if there are subscribers.
class WorkpieceNode {
 public:
  explicit WorkpieceNode(sweep_guard_ros::ParameterReader& parameters)
      : workpiece_(makeWorkpiece(parameters)),
        id_(parameters.name("id", "workpiece")),
        frame_(parameters.name("frame", "workpiece")),
        rate_(parameters.number("rate", 60.0, {0.1, 1000.0})) {
    ros::Time::waitForValid();
    broadcastFrame(parameters.name("parent_frame", "world"), parameters.position("position", {0.0, 0.0, 0.3}));
    mesh_publisher_ = node_.advertise<sweep_guard::DeformableMesh>("mesh", 1, /*latch=*/true);
    vertices_publisher_ = node_.advertise<sweep_guard::MeshVertices>("mesh_vertices", 10);
    marker_publisher_ = private_node_.advertise<visualization_msgs::Marker>("marker", 1);
  }

  void run() {
    start_ = ros::Time::now();
    publishMesh();
    for (ros::Rate rate(rate_); ros::ok(); rate.sleep()) {
      ros::spinOnce();
      publishVertices();
    }
  }

 private:
  void broadcastFrame(const std::string& parent, const Eigen::Vector3d& position) {
    geometry_msgs::TransformStamped transform =
        tf2::eigenToTransform(Eigen::Isometry3d(Eigen::Translation3d(position)));
    transform.header.stamp = ros::Time::now();
    transform.header.frame_id = parent;
    transform.child_frame_id = frame_;
    broadcaster_.sendTransform(transform);
  }

  void publishMesh() {
    sweep_guard::DeformableMesh message = meshMessage(workpiece_, 0.0);
    message.header.stamp = start_;
    message.header.frame_id = frame_;
    message.id = id_;
    mesh_publisher_.publish(message);
    ROS_INFO("workpiece '%s': %zu triangles, %zu vertices, %.0f Hz", id_.c_str(), workpiece_.triangles().size(),
             workpiece_.vertexCount(), rate_);
  }

  void publishVertices() {
    const ros::Time now = ros::Time::now();
    sweep_guard::MeshVertices message = verticesMessage(workpiece_, (now - start_).toSec());
    message.header.stamp = now;
    message.header.frame_id = frame_;
    message.id = id_;
    vertices_publisher_.publish(message);
    if (marker_publisher_.getNumSubscribers() > 0 && (message.header.stamp - marker_stamp_).toSec() >= kMarkerPeriod) {
      marker_stamp_ = message.header.stamp;
      publishMarker(message);
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
  double rate_;
  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  ros::Publisher mesh_publisher_;
  ros::Publisher vertices_publisher_;
  ros::Publisher marker_publisher_;
  tf2_ros::StaticTransformBroadcaster broadcaster_;
  ros::Time start_;
  ros::Time marker_stamp_;
};

}  // namespace

}  // namespace sweep_guard_simulation

int main(int argc, char** argv) {
  return sweep_guard_recording::runNode<sweep_guard_simulation::WorkpieceNode>(argc, argv, "deformable_workpiece");
}
