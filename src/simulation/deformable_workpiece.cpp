#include <geometry_msgs/TransformStamped.h>
#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <visualization_msgs/Marker.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "simulation/run_node.h"
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

geometry_msgs::Point toPoint(const float* p) {
  geometry_msgs::Point point;
  point.x = static_cast<double>(p[0]);
  point.y = static_cast<double>(p[1]);
  point.z = static_cast<double>(p[2]);
  return point;
}

std_msgs::ColorRGBA shade(const float* a, const float* b, const float* c) {
  const auto vertex = [](const float* p) { return Eigen::Map<const Eigen::Vector3f>(p); };
  const Eigen::Vector3f normal = (vertex(b) - vertex(a)).cross(vertex(c) - vertex(a)).stableNormalized();
  const float light = 0.5F + 0.5F * normal.dot(Eigen::Vector3f(0.48F, 0.14F, 0.866F));
  std_msgs::ColorRGBA color;
  color.r = 0.15F + 0.75F * light;
  color.g = 0.15F + 0.72F * light;
  color.b = 0.15F + 0.62F * light;
  color.a = 1.0F;
  return color;
}

/// Publishes a workpiece: its triangles once, its vertices at a rate, a marker for rviz while somebody looks.
class WorkpieceNode {
 public:
  explicit WorkpieceNode(sweep_guard_ros::ParameterReader& parameters)
      : workpiece_(makeWorkpiece(parameters)),
        id_(parameters.name("id", "workpiece")),
        frame_(parameters.name("frame", "workpiece")),
        rate_(parameters.number("rate", 60.0, {0.1, 1000.0})) {
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
    geometry_msgs::TransformStamped transform;
    transform.header.stamp = ros::Time::now();
    transform.header.frame_id = parent;
    transform.child_frame_id = frame_;
    transform.transform.translation.x = position.x();
    transform.transform.translation.y = position.y();
    transform.transform.translation.z = position.z();
    transform.transform.rotation.w = 1.0;
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
    const auto cornerOf = [&vertices](std::size_t i) { return &vertices.positions[3 * i]; };
    for (const auto& [a, b, c] : workpiece_.triangles()) {
      const float* const corners[] = {cornerOf(a), cornerOf(b), cornerOf(c)};
      for (const float* corner : corners) marker.points.push_back(toPoint(corner));
      marker.colors.insert(marker.colors.end(), 3, shade(corners[0], corners[1], corners[2]));
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
  return sweep_guard_simulation::runNode<sweep_guard_simulation::WorkpieceNode>(argc, argv, "deformable_workpiece");
}
