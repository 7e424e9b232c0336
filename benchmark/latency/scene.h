#pragma once

#include <geometry_msgs/Pose.h>
#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/MeshVertices.h>

#include <vector>

namespace sweep_guard_benchmark {

/// A drill that hovers near a wavy hull and goes into it, and the hull, whose waves run to and fro. All of it is
/// computed before it is needed: who sends it takes next to nothing of the processors that the guard is measured on.
class LatencyScene {
 public:
  /// @param triangles  even, >= 6
  explicit LatencyScene(int triangles);

  /// Of the drill's tip, after `t` [s].
  static geometry_msgs::Pose tool(double t);

  const sweep_guard::DeformableMesh& mesh() const { return mesh_; }

  /// The next of a dozen deformations, with that stamp. It is copied only if who was given it before is not done yet.
  sweep_guard::MeshVertices::Ptr frame(const ros::Time& stamp);

 private:
  sweep_guard::DeformableMesh mesh_;
  std::vector<sweep_guard::MeshVertices::Ptr> frames_;
  std::size_t next_ = 0;
};

}  // namespace sweep_guard_benchmark
