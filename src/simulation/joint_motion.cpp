#include "simulation/joint_motion.h"

#include <algorithm>
#include <cassert>

#include "recording/bag.h"
#include "ros/input/joint_names.h"
#include "simulation/tip.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/kinematics/robot_motion.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_simulation {
namespace {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::JointTimeline;
using sweep_guard_core::KinematicTree;

std::string missingJoints(const JointTimeline& timeline, const KinematicTree& tree) {
  std::string missing;
  for (size_t i = 0; i < tree.variables().size(); ++i) {
    if (!timeline.expects(i) || timeline.newestOf(i)) continue;
    missing += (missing.empty() ? "'" : ", '") + tree.variables()[i].name + "'";
  }
  return missing;
}

void requireAll(const JointTimeline& timeline, const KinematicTree& tree, const std::string& path) {
  const std::string missing = missingJoints(timeline, tree);
  if (missing.empty()) return;
  throw InvalidInput(
      path + ": it has no position of " + missing +
      ", which the tool needs; record them, say where they are (tool_joints:='{NAME: rad or m}'), or leave "
      "links that they move out of tool_links");
}

using Eigen::Vector3d;
using sweep_guard_core::TreeLink;

constexpr double kRest = 1e-3;  // [m]; a shorter path has no direction

int jointsBelow(const sweep_guard_core::KinematicTree& tree, size_t link) {
  int joints = 0;
  for (; link != TreeLink::kRoot; link = tree.links()[link].parent) joints += tree.links()[link].moves() ? 1 : 0;
  return joints;
}

size_t lastBody(const sweep_guard_core::Robot& robot) {
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

std::vector<StampedPositions> readJointMotion(const std::string& path, const std::string& topic,
                                              const KinematicTree& tree,
                                              const std::map<std::string, double>& fixed_joints,
                                              const std::map<std::string, std::string>& joint_names) {
  const auto fixed = sweep_guard_ros::fixedPositions(tree, fixed_joints);
  const sweep_guard_ros::JointNames names(tree, fixed, joint_names);
  JointTimeline timeline(tree, fixed, /*root_moves=*/false);
  std::vector<JointTimeline::Position> named;
  std::vector<StampedPositions> motion;
  sweep_guard_core::RobotState state;
  sweep_guard_recording::readJointBag(path, topic,
                                      [&](const std::string& publisher, const sensor_msgs::JointState& message) {
                                        names.find(message, named);
                                        timeline.add(publisher, sweep_guard_ros::fromMsg(message.header.stamp), named);
                                        while (const auto stamp = timeline.next(state))
                                          motion.push_back({*stamp, state.positions});
                                      });
  requireAll(timeline, tree, path);
  if (motion.empty())
    throw InvalidInput(path + ": its joints were never recorded at the same time; give a bag of one run");
  return motion;
}

Meeting halfway(const sweep_guard_ros::RobotModel& model, const std::vector<StampedPositions>& motion) {
  assert(!model.robot.bodies.empty() && !motion.empty());
  const size_t body = lastBody(model.robot);
  const sweep_guard_core::Tool& tool = model.robot.tools[body];
  const std::vector<Eigen::Isometry3d> X_TB = posesOf(body, model, motion);
  std::vector<Vector3d> path;
  path.reserve(X_TB.size());
  for (const Eigen::Isometry3d& pose : X_TB) path.push_back(pose * tool.bounds_T().center());
  const size_t middle = middleOf(path);
  const Vector3d moved = path[middle] - path.front();
  const Vector3d direction_T = moved.norm() > kRest ? Vector3d(moved.normalized()) : Vector3d(-Vector3d::UnitZ());
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
