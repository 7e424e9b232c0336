// Publishes a workpiece that never changes: the triangles of a file as they stand there.
#include <ros/ros.h>

#include <string>

#include "sweep_guard/DeformableMesh.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"
#include "sweep_guard/ros/tool/mesh_file.h"

namespace sweep_guard_session {
namespace {

geometry_msgs::Point toPoint(const Eigen::Vector3d& p) {
  geometry_msgs::Point point;
  point.x = p.x();
  point.y = p.y();
  point.z = p.z();
  return point;
}

// Without a stamp: it was always so, whatever the clock says.
sweep_guard::DeformableMesh readWorkpiece(sweep_guard_ros::ParameterReader& parameters) {
  const sweep_guard_ros::MeshSurface surface =
      sweep_guard_ros::readMesh(parameters.name("file", ""), sweep_guard_ros::Links::kFollow);
  const double scale = parameters.number("scale", 1.0, {1e-6, 1e6});
  const Eigen::Vector3d position = parameters.position("position", {0.0, 0.0, 0.0});
  sweep_guard::DeformableMesh message;
  message.header.frame_id = parameters.name("frame", "world");
  message.id = parameters.name("id", "workpiece");
  message.revision = 1;
  for (const Eigen::Vector3d& vertex : surface.vertices) {
    message.mesh.vertices.push_back(toPoint(position + scale * vertex));
  }
  for (const auto& [a, b, c] : surface.triangles) {
    shape_msgs::MeshTriangle triangle;
    triangle.vertex_indices = {a, b, c};
    message.mesh.triangles.push_back(triangle);
  }
  return message;
}

void run() {
  sweep_guard_ros::ParameterReader parameters{ros::NodeHandle("~")};
  ros::Publisher publisher = ros::NodeHandle().advertise<sweep_guard::DeformableMesh>("mesh", 1, /*latch=*/true);
  const sweep_guard::DeformableMesh mesh = readWorkpiece(parameters);
  parameters.warnOfUnread();
  publisher.publish(mesh);
  ROS_INFO("workpiece '%s': %zu triangles in '%s', static", mesh.id.c_str(), mesh.mesh.triangles.size(),
           mesh.header.frame_id.c_str());
  ros::spin();
}

}  // namespace
}  // namespace sweep_guard_session

int main(int argc, char** argv) {
  ros::init(argc, argv, "static_mesh");
  const ros::NodeHandle alive;  // without any handle the console is silent
  try {
    sweep_guard_session::run();
  } catch (const sweep_guard_core::Error& error) {
    ROS_FATAL("%s", error.what());
    return 2;
  }
  return 0;
}
