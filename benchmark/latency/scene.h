#pragma once

#include <geometry_msgs/Pose.h>
#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/MeshVertices.h>

#include <vector>

namespace sweep_guard_benchmark {

/// A drill that hovers above a wavy hull and enters it, and the hull, whose waves run to and fro. The deformations are
/// computed in advance, so that the sender takes little time from the processors on which the guard is measured.
class LatencyScene {
 public:
  /// @param triangles  even, >= 6
  explicit LatencyScene(int triangles);

  /// Returns the pose of the drill after `t` [s].
  static geometry_msgs::Pose tool(double t);

  const sweep_guard::DeformableMesh& mesh() const { return mesh_; }

  /// Returns the next of twelve deformations with this stamp. Copies it only if the previous receiver still holds it.
  sweep_guard::MeshVertices::Ptr frame(const ros::Time& stamp);

 private:
  sweep_guard::DeformableMesh mesh_;
  std::vector<sweep_guard::MeshVertices::Ptr> frames_;
  std::size_t next_ = 0;
};

}  // namespace sweep_guard_benchmark
