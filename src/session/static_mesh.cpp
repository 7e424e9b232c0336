// Publishes the mesh of a file as a workpiece that never changes.
#include <tf2_eigen/tf2_eigen.h>

#include "recording/run_node.h"
#include "sweep_guard/DeformableMesh.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"
#include "sweep_guard/ros/tool/mesh_file.h"

namespace sweep_guard_session {
namespace {

// Without a stamp: the workpiece is valid at any time.
sweep_guard::DeformableMesh readWorkpiece(sweep_guard_ros::ParameterReader& parameters) {
  const sweep_guard_ros::MeshSurface surface =
      sweep_guard_ros::readMesh(parameters.name("file", ""), /*follow_link=*/true);
  const double scale = parameters.number("scale", 1.0, {1e-6, 1e6});
  const Eigen::Vector3d position = parameters.position("position", {0.0, 0.0, 0.0});
  sweep_guard::DeformableMesh message;
  message.header.frame_id = parameters.name("frame", "world");
  message.id = parameters.name("id", "workpiece");
  message.revision = 1;
  message.open = parameters.flag("open", false);
  for (const Eigen::Vector3d& vertex : surface.vertices) {
    message.mesh.vertices.push_back(tf2::toMsg(Eigen::Vector3d(position + scale * vertex)));
  }
  for (const auto& [a, b, c] : surface.triangles) {
    message.mesh.triangles.emplace_back().vertex_indices = {a, b, c};
  }
  return message;
}

class StaticMesh {
 public:
  explicit StaticMesh(sweep_guard_ros::ParameterReader& parameters) : mesh_(readWorkpiece(parameters)) {}

  void run() const {
    const ros::Publisher publisher =
        ros::NodeHandle().advertise<sweep_guard::DeformableMesh>("mesh", 1, /*latch=*/true);
    publisher.publish(mesh_);
    ROS_INFO("workpiece '%s': %zu triangles in '%s', static", mesh_.id.c_str(), mesh_.mesh.triangles.size(),
             mesh_.header.frame_id.c_str());
    ros::spin();
  }

 private:
  sweep_guard::DeformableMesh mesh_;
};

}  // namespace
}  // namespace sweep_guard_session

int main(int argc, char** argv) {
  return sweep_guard_recording::runNode<sweep_guard_session::StaticMesh>(argc, argv, "static_mesh");
}
