#include "simulation/meeting.h"

#include <algorithm>
#include <cassert>

#include "simulation/tip.h"
#include "sweep_guard/kinematics/robot_motion.h"

namespace sweep_guard_simulation {
namespace {

using Eigen::Vector3d;
using sweep_guard_core::Robot;
using sweep_guard_core::TreeLink;

constexpr double kRest = 1e-3;  // [m]; a shorter way has no direction

int jointsBelow(const sweep_guard_core::KinematicTree& tree, size_t link) {
  int joints = 0;
  for (; link != TreeLink::kRoot; link = tree.links()[link].parent) joints += tree.links()[link].moves() ? 1 : 0;
  return joints;
}

size_t lastBody(const Robot& robot) {
  const auto fewer = [&robot](const auto& a, const auto& b) {
    return jointsBelow(robot.tree, a.link) < jointsBelow(robot.tree, b.link);
  };
  return static_cast<size_t>(std::max_element(robot.bodies.begin(), robot.bodies.end(), fewer) - robot.bodies.begin());
}

std::vector<Eigen::Isometry3d> posesOf(size_t body, const sweep_guard_ros::RobotModel& model,
                                       const std::vector<StampedPositions>& motion) {
  std::vector<Eigen::Isometry3d> X_TB;
  std::vector<Eigen::Isometry3d> poses;
  for (const StampedPositions& sample : motion) {
    bodyPoses(model.robot.tree, model.robot.bodies, {model.X_TR, sample.positions}, X_TB);
    poses.push_back(X_TB[body]);
  }
  return poses;
}

size_t middleOf(const std::vector<Vector3d>& path) {
  std::vector<double> lengths = {0.0};
  for (size_t i = 1; i < path.size(); ++i) lengths.push_back(lengths.back() + (path[i] - path[i - 1]).norm());
  const auto middle = std::lower_bound(lengths.begin(), lengths.end(), 0.5 * lengths.back());
  return static_cast<size_t>(middle - lengths.begin());
}

}  // namespace

Meeting halfway(const sweep_guard_ros::RobotModel& model, const std::vector<StampedPositions>& motion) {
  assert(!model.robot.bodies.empty() && !motion.empty());
  const size_t body = lastBody(model.robot);
  const sweep_guard_core::Tool& tool = model.robot.tools[body];
  const std::vector<Eigen::Isometry3d> X_TB = posesOf(body, model, motion);
  std::vector<Vector3d> path;
  for (const Eigen::Isometry3d& pose : X_TB) path.push_back(pose * tool.bounds_T().center());
  const size_t middle = middleOf(path);
  const Vector3d way = path[middle] - path.front();
  const Vector3d direction_T = way.norm() > kRest ? Vector3d(way.normalized()) : Vector3d(-Vector3d::UnitZ());
  return {X_TB[middle] * frontOf(tool, X_TB[middle].linear().transpose() * direction_T), direction_T};
}

Vector3d placeToMeet(const Meeting& meeting, const sweep_guard_core::TriangleMesh& mesh_W, double depth) {
  Vector3d nearest_W = mesh_W.vertex(mesh_W.triangles().front().front());
  for (const sweep_guard_core::Triangle& triangle : mesh_W.triangles()) {
    for (const std::uint32_t index : triangle) {
      const Vector3d p_W = mesh_W.vertex(index);
      if (meeting.direction_T.dot(p_W - nearest_W) < 0.0) nearest_W = p_W;
    }
  }
  return nearest_W + depth * meeting.direction_T - meeting.p_T;
}

}  // namespace sweep_guard_simulation
