#include "latency/scene.h"

#include <tf2_eigen/tf2_eigen.h>

#include <boost/make_shared.hpp>
#include <cmath>

#include "scenes.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_benchmark {
namespace {

constexpr double kTurn = 2.0 * 3.14159265358979323846;
constexpr int kFrames = 12;
constexpr double kPhase = 0.3;  // of the waves [rad]

sweep_guard_core::TriangleMesh hull(int triangles, int frame) {
  int sectors = static_cast<int>(std::sqrt(triangles));
  while (triangles / 2 % sectors != 0) --sectors;
  return sweep_guard_core::wavyHull(triangles / 2 / sectors + 1, sectors, kPhase * std::sin(kTurn * frame / kFrames));
}

template <typename Message>
Message withId() {
  Message message;
  message.header.frame_id = "world";
  message.id = "hull";
  message.revision = 1;
  return message;
}

sweep_guard::DeformableMesh wholeMesh(const sweep_guard_core::TriangleMesh& mesh_M) {
  auto message = withId<sweep_guard::DeformableMesh>();
  for (size_t i = 0; i < mesh_M.vertexCount(); ++i) {
    message.mesh.vertices.push_back(tf2::toMsg(Eigen::Vector3d(mesh_M.vertex(i))));
  }
  for (const auto& [a, b, c] : mesh_M.triangles()) {
    message.mesh.triangles.emplace_back().vertex_indices = {a, b, c};
  }
  return message;
}

sweep_guard::MeshVertices::Ptr verticesOf(const sweep_guard_core::TriangleMesh& mesh_M) {
  auto message = boost::make_shared<sweep_guard::MeshVertices>(withId<sweep_guard::MeshVertices>());
  message->positions = sweep_guard_core::streamedPositions(mesh_M);
  return message;
}

}  // namespace

LatencyScene::LatencyScene(int triangles) : mesh_(wholeMesh(hull(triangles, 0))) {
  for (int frame = 0; frame < kFrames; ++frame) frames_.push_back(verticesOf(hull(triangles, frame)));
}

// Moves every 3 s from 22 mm to -2 mm above the hull's mean surface, with a small swing; the waves reach 10 mm.
geometry_msgs::Pose LatencyScene::tool(double t) {
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();
  X_WT.translation() << 0.110 + 0.012 * std::cos(kTurn * t / 3.0), 0.004 * std::sin(0.7 * kTurn * t),
      0.004 * std::sin(0.45 * kTurn * t);
  X_WT.rotate(Eigen::AngleAxisd(-0.25 * kTurn + 0.1 * std::sin(0.5 * kTurn * t), Eigen::Vector3d::UnitY()));
  return sweep_guard_ros::toMsg(X_WT);
}

sweep_guard::MeshVertices::Ptr LatencyScene::frame(const ros::Time& stamp) {
  sweep_guard::MeshVertices::Ptr& frame = frames_[next_++ % frames_.size()];
  if (!frame.unique()) frame = boost::make_shared<sweep_guard::MeshVertices>(*frame);
  frame->header.stamp = stamp;
  return frame;
}

}  // namespace sweep_guard_benchmark
