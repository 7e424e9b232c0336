#include "simulation/joint_motion.h"

#include <optional>

#include "recording/bag.h"
#include "ros/input/joint_names.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/kinematics/joint_timeline.h"
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

}  // namespace

std::vector<StampedPositions> readJointMotion(const std::string& path, const std::string& topic,
                                              const KinematicTree& tree,
                                              const std::map<std::string, double>& fixed_joints) {
  const sweep_guard_ros::JointNames names(tree);
  JointTimeline timeline(tree, sweep_guard_ros::fixedPositions(tree, fixed_joints), /*root_moves=*/false);
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

}  // namespace sweep_guard_simulation
